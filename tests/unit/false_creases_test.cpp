// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/false_creases.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace false_creases_test {
namespace {

using namespace vcg::ccdm;

struct Kept {
    int before, after, dropped, droppedEdges;
};

Kept Creases(const shapes::Shape &s, double angle, double spacing, const SideMarks &marked = {})
{
    const MeshTables t = meshes::Tables(s);
    ReferenceSurface surface(t.position, t.face);
    MarkFeatures(surface, angle, marked);
    const auto count = [&] {
        int n = 0;
        for (int f = 0; f < surface.FaceCount(); ++f)
            for (int e = 0; e < 3; ++e)
                n += surface.mesh.Constrained(MakeSide(f, e)) && surface.mesh.Mate(MakeSide(f, e)) < MakeSide(f, e);
        return n;
    };
    Kept k{count(), 0, 0, 0};
    const std::vector<double> h(t.position.size(), spacing);
    FalseCreases creases(surface, h, marked, angle);
    k.dropped = creases.Drop();
    k.droppedEdges = creases.DroppedEdges();
    k.after = count();
    return k;
}

TEST(FalseCreases, TrueCreasesStay)
{
    for (const shapes::Shape &s : {shapes::Box(1, 2, 3), shapes::CadPart(), shapes::TwistedBar(80, 3)}) {
        const Kept k = Creases(s, 40, 0.05);
        EXPECT_GT(k.before, 0);
        EXPECT_EQ(k.after, k.before);
        EXPECT_EQ(k.dropped, 0);
        EXPECT_EQ(k.droppedEdges, 0);
    }
}

TEST(FalseCreases, CreasesOfThinPlatesStay)
{
    // The neighbourhood of a crease holds both faces of the plate, whose normals cancel.
    for (const double thickness : {0.03, 0.05, 0.1, 0.2})
        for (const int rounds : {0, 1, 3}) {
            shapes::Shape box = shapes::Box(1, 1, thickness), disc = shapes::CadPart();
            for (int k = 0; k < rounds; ++k)
                box = shapes::Subdivide(box);
            for (auto &p : disc.points)
                p[2] *= thickness;
            for (const double spacing : {0.4, 0.15, 0.09, 0.05, 0.025})
                for (const shapes::Shape &s : {box, disc}) {
                    const Kept k = Creases(s, 40, spacing);
                    EXPECT_GT(k.before, 0);
                    EXPECT_EQ(k.after, k.before) << thickness << ' ' << rounds << ' ' << spacing;
                }
        }
}

TEST(FalseCreases, RimsOfSmallHolesStay)
{
    // A square hole through a plate, narrower than the spacing.
    const shapes::Shape frame = shapes::Extrude(shapes::Grid(
                                                    3, 3, [](int i, int j) { return i != 1 || j != 1; },
                                                    [](double u, double v) {
                                                        return shapes::P{u, v, 0};
                                                    }),
                                                0.4);
    for (const double spacing : {0.4, 0.5, 0.8}) {
        const Kept k = Creases(frame, 40, spacing);
        EXPECT_EQ(k.before, 40);
        EXPECT_EQ(k.after, k.before) << spacing;
    }
}

TEST(FalseCreases, SaysHowManyEdgesWereDropped)
{
    EXPECT_EQ(DroppedCreasesWarning(0, 40), "");
    EXPECT_EQ(DroppedCreasesWarning(1, 40), "1 edge that turns by more than 40 degrees was taken for roughness, a "
                                            "stray fragment or too small a detail and not for a crease");
    EXPECT_EQ(DroppedCreasesWarning(3, 32.5), "3 edges that turn by more than 32.5 degrees were taken for roughness, "
                                              "a stray fragment or too small a detail and not for a crease");
}

TEST(FalseCreases, NoiseOnASphereHasNone)
{
    shapes::Shape s = shapes::Sphere(5); // edges of about 0.04
    shapes::AddNoise(s, 0.012);
    const Kept k = Creases(s, 40, 0.06);
    EXPECT_GT(k.before, 500);
    EXPECT_EQ(k.after, 0);
    EXPECT_EQ(k.droppedEdges, k.before);
}

// A crumpled ball: a fourth of its edges turn by more than 40 degrees, and none stands out.
TEST(FalseCreases, SharpEdgesLongerThanTheSpacingStay)
{
    shapes::Shape s = shapes::Sphere(3); // edges of about 0.15
    shapes::AddNoise(s, 0.06);
    const Kept coarser = Creases(s, 40, 0.3), finer = Creases(s, 40, 0.0375);
    EXPECT_GT(coarser.before, 500);
    EXPECT_EQ(coarser.after, 0);
    // Of the turns between 40 and 60 degrees most are of the surface and no creases.
    EXPECT_GT(finer.after, 0.2 * finer.before);
    EXPECT_LT(finer.after, 0.6 * finer.before);
}

TEST(FalseCreases, FacetsOfSmoothSurfacesAreNone)
{
    shapes::Shape s = shapes::Sphere(2); // its edges turn by 8 to 11 degrees and are longer than the spacing
    shapes::AddNoise(s, 0.01);
    const Kept k = Creases(s, 8, 0.085);
    EXPECT_GT(k.before, 300);
    EXPECT_EQ(k.after, 0);
}

TEST(FalseCreases, CreasesUnderNoiseStay)
{
    // A finely meshed box with noise a twentieth of its edges: the twelve creases of twenty edges or so.
    shapes::Shape s = shapes::Subdivide(shapes::Subdivide(shapes::Subdivide(shapes::Box(1, 1, 1))));
    const Kept plain = Creases(s, 40, 0.1);
    shapes::AddNoise(s, 0.006);
    const Kept noisy = Creases(s, 40, 0.1);
    EXPECT_EQ(plain.after, plain.before);
    EXPECT_GE(noisy.after, plain.after * 0.97);
    EXPECT_LE(noisy.after, plain.after * 1.03);
}

TEST(FalseCreases, AShortFragmentIsDroppedUnlessItIsMarked)
{
    // One vertex of a plane, lifted: a spike with a crease around and up its sides.
    shapes::Shape s = shapes::FlatGrid(20);
    for (auto &p : s.points)
        if (std::hypot(p[0] - 0.5, p[1] - 0.5) < 1e-9)
            p[2] = 0.05;
    const MeshTables t = meshes::Tables(s);
    const int boundary = 80;
    const Kept large = Creases(s, 40, 0.2);
    EXPECT_GT(large.before, boundary);
    EXPECT_EQ(large.after, boundary);
    SideMarks all(t.face.size(), 7);
    EXPECT_EQ(Creases(s, 40, 0.2, all).after, Creases(s, 40, 0.2, all).before);
}

} // namespace
} // namespace false_creases_test
