// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/even_chords.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/initial_mesh.h>

#include "support/meshes.h"

namespace even_chords_test {
namespace {

using vcg::ccdm::Pi;
using vcg::ccdm::Point;

constexpr int Around = 96, Rings = 6;

// A flat disc of radius 1 with a smooth outline.
shapes::Shape Disc()
{
    shapes::Shape s;
    s.points.push_back({0, 0, 0});
    for (int r = 1; r <= Rings; ++r)
        for (int i = 0; i < Around; ++i) {
            const double a = 2 * Pi * i / Around, q = static_cast<double>(r) / Rings;
            s.points.push_back({q * std::cos(a), q * std::sin(a), 0});
        }
    const auto at = [](int r, int i) { return 1 + (r - 1) * Around + i % Around; };
    for (int i = 0; i < Around; ++i) {
        s.faces.push_back({0, at(1, i), at(1, i + 1)});
        for (int r = 1; r < Rings; ++r) {
            s.faces.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
            s.faces.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
        }
    }
    return s;
}

struct Fixture {
    vcg::ccdm::Model model = meshes::MakeModel(Disc(), 40, 180);
    vcg::ccdm::Remesh remesh;

    // The outline has 16 vertices, every second gap half as long again as the others.
    Fixture()
    {
        vcg::ccdm::SampleSet samples;
        const double length = model.features.curve.front().Length();
        for (int i = 0; i < 16; ++i)
            samples.onCurves.push_back({0, length * (i + (i % 2 == 0 ? 0 : 0.2)) / 16});
        vcg::ccdm::Random random(1);
        samples.onFaces = vcg::ccdm::SampleFaces(model.surface, model.density, 30, random);
        vcg::ccdm::InitialMeshBuilder(model, samples).Build(remesh, [](double) { return true; });
    }

    double LongestOutlineEdge() const
    {
        double longest = 0;
        const auto &m = remesh.mesh;
        for (int t = 0; t < m.TriangleCount(); ++t)
            for (int e = 0; e < 3; ++e) {
                const vcg::ccdm::Side s = vcg::ccdm::MakeSide(t, e);
                if (m.Mate(s) == vcg::ccdm::NoSide)
                    longest =
                        std::max(longest, vcg::ccdm::Norm(remesh.position[m.Head(s)] - remesh.position[m.Tail(s)]));
            }
        return longest;
    }
};

TEST(EvenChords, ShortensTheLongestChords)
{
    Fixture f;
    const double even = 2 * std::sin(Pi / 16), before = f.LongestOutlineEdge();
    ASSERT_GT(before, 1.15 * even);
    vcg::ccdm::EvenChords(f.model, f.remesh).Run(0, 20, 0);
    EXPECT_LT(f.LongestOutlineEdge(), 1.12 * even);
    for (const Point &p : f.remesh.position)
        EXPECT_LE(vcg::ccdm::Norm(p), 1 + 1e-12);
}

TEST(EvenChords, LeavesAloneWhatDoesNotStandOut)
{
    Fixture f;
    const std::vector<Point> before = f.remesh.position;
    vcg::ccdm::EvenChords(f.model, f.remesh).Run(0, 20, 0.1); // the largest gap is about 0.03
    EXPECT_EQ(f.remesh.position, before);
}

} // namespace
} // namespace even_chords_test
