// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/thin_parts.h>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include "support/meshes.h"

namespace thin_parts_test {
namespace {

using namespace vcg::ccdm;

std::vector<NarrowPlace> Find(const shapes::Shape &s, int n, double angle, NarrowKind kind)
{
    const Model model = meshes::MakeModel(s, n, angle);
    std::vector<NarrowPlace> places = ThinParts(model).Find();
    places.erase(std::remove_if(places.begin(), places.end(), [&](const auto &p) { return p.kind != kind; }),
                 places.end());
    return places;
}

shapes::Shape Slab(double height)
{
    return shapes::Extrude(shapes::FlatGrid(20), height);
}

shapes::Shape InsideOut(shapes::Shape s)
{
    for (shapes::F &f : s.faces)
        std::swap(f[1], f[2]);
    return s;
}

TEST(ThinParts, ASlabIsThinUntilTheSpacingIsSmallEnough)
{
    for (const shapes::Shape &s : {Slab(0.02), InsideOut(Slab(0.02))}) {
        const auto places = Find(s, 500, 40, NarrowKind::ThinPart);
        ASSERT_EQ(places.size(), 1U) << "one connected part";
        EXPECT_NEAR(places[0].width, 0.02, 1e-12);
        EXPECT_NEAR(places[0].spacing, std::sqrt(2 * 2.08 / (std::sqrt(3.0) * 500)), 1e-9);
        EXPECT_TRUE(Find(s, 20000, 40, NarrowKind::ThinPart).empty());
    }
}

TEST(ThinParts, TheRimsOfASlabAreCloseFeatures)
{
    const auto places = Find(Slab(0.02), 500, 40, NarrowKind::CloseFeatures);
    ASSERT_EQ(places.size(), 1U) << "all the way around";
    EXPECT_NEAR(places[0].width, 0.02, 1e-12);
    EXPECT_TRUE(Find(Slab(0.02), 20000, 40, NarrowKind::CloseFeatures).empty());
    EXPECT_TRUE(Find(Slab(0.02), 500, 180, NarrowKind::CloseFeatures).empty()) << "no features, none close";
}

TEST(ThinParts, ARodIsThinWhereTheSpacingIsWiderThanIt)
{
    const shapes::Shape rod = shapes::RoundTorus(200, 24, 0.05);
    EXPECT_FALSE(Find(rod, 100, 180, NarrowKind::ThinPart).empty());
    EXPECT_TRUE(Find(rod, 3000, 180, NarrowKind::ThinPart).empty());
}

TEST(ThinParts, AGapOutsideIsNotThin)
{
    const shapes::Shape two = shapes::Together(shapes::Sphere(4), shapes::Sphere(4), 2.02);
    EXPECT_TRUE(Find(two, 600, 180, NarrowKind::ThinPart).empty());
    // One inside the other: the shell between them, seen from the two sides of what is no solid by itself.
    shapes::Shape inner = InsideOut(shapes::Sphere(4));
    for (shapes::P &p : inner.points)
        for (double &x : p)
            x *= 0.98;
    EXPECT_TRUE(Find(inner, 600, 180, NarrowKind::ThinPart).empty());
}

TEST(ThinParts, NoFalseAlarmOnOrdinaryModels)
{
    struct Case {
        const char *name;
        shapes::Shape shape;
        double angle;
        int vertices;
    };
    for (const Case &c :
         {Case{"sphere", shapes::Sphere(4), 180, 500}, Case{"sphere", shapes::Sphere(4), 180, 60},
          Case{"bumpy", shapes::Bumpy(4), 180, 500}, Case{"torus", shapes::RoundTorus(60, 30), 180, 400},
          Case{"cad_part", shapes::CadPart(), 40, 1000}, Case{"box", shapes::Box(1, 2, 3), 40, 200},
          Case{"klein_bottle", shapes::KleinBottle(80, 48), 180, 2500},
          Case{"moebius", shapes::MoebiusStrip(80, 10), 180, 400},
          Case{"twisted_bar", shapes::TwistedBar(80, 3), 60, 1000}}) {
        const Model model = meshes::MakeModel(c.shape, c.vertices, c.angle);
        EXPECT_TRUE(ThinParts(model).Find().empty()) << c.name << " " << c.vertices;
    }
    shapes::Shape rough = shapes::Sphere(5);
    shapes::AddNoise(rough, 0.01);
    EXPECT_TRUE(Find(rough, 1000, 180, NarrowKind::ThinPart).empty());
}

TEST(ThinParts, TheReportTellsPlaceWidthSpacingAndCount)
{
    Params p;
    p.vertexCount = 500;
    p.globalIterations = 2;
    shapes::Shape s = Slab(0.02);
    for (shapes::P &x : s.points)
        for (int k = 0; k < 3; ++k)
            x[k] = 100 * x[k] + 1000;
    MeshTables out;
    Report r = Remesher(p, nullptr).Run(meshes::Tables(s), out);
    ASSERT_EQ(r.status, Status::Done) << r.message;
    ASSERT_EQ(r.narrow.size(), 2U);
    for (const NarrowPlace &n : r.narrow) {
        EXPECT_NEAR(n.width, 2, 1e-9);
        EXPECT_NEAR(n.spacing, 6.93, 0.1);
        EXPECT_GT(n.position[0], 999);
        EXPECT_LT(n.position[0], 1101);
        EXPECT_NEAR(n.vertices, 500 * std::pow(0.7 * n.spacing / 2, 2), 1);
    }
    int thin = 0, close = 0;
    for (const std::string &w : r.warnings) {
        thin += w.find("the surface is thinner than the spacing allows at 1 place") != std::string::npos;
        close += w.find("features are closer together than the spacing allows at 1 place") != std::string::npos;
    }
    EXPECT_EQ(thin, 1);
    EXPECT_EQ(close, 1);
    // With the count that it names there is nothing left to warn of.
    p.vertexCount = static_cast<int>(1.02 * std::max(r.narrow[0].vertices, r.narrow[1].vertices));
    p.globalIterations = 0;
    r = Remesher(p, nullptr).Run(meshes::Tables(s), out);
    EXPECT_TRUE(r.narrow.empty());
}

} // namespace
} // namespace thin_parts_test
