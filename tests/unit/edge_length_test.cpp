// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/edge_length.h>

#include <gtest/gtest.h>

#include "support/meshes.h"

namespace edge_length_test {
namespace {

using namespace vcg::ccdm;

double Vertices(const Model &model, int euler, double length)
{
    return VerticesForEdgeLength(model.surface, model.density.phi, euler, length);
}

TEST(EdgeLength, CountsTheVerticesOfAFlatHexagonalGrid)
{
    // A rhombus of k x k cells of two equilateral triangles each, side 1: (k + 1)^2 vertices.
    const int k = 20;
    const Model model = meshes::MakeModel(shapes::Grid(
                                              k, k, [](int, int) { return true; },
                                              [](double x, double y) {
                                                  return shapes::P{20 * x + 10 * y, 20 * y * std::sqrt(0.75), 0};
                                              }),
                                          441, 180);
    EXPECT_NEAR(Vertices(model, 1, 1), (k + 1) * (k + 1), 1e-6);
}

TEST(EdgeLength, CountsTheVerticesOfASphere)
{
    const Model model = meshes::MakeModel(shapes::Sphere(5), 1000, 180);
    const double length = 0.12, n = Vertices(model, 2, length);
    EXPECT_NEAR(n, 2 * 4 * shapes::Pi / (std::sqrt(3.0) * length * length) + 2, 0.002 * n);
    EXPECT_NEAR(Vertices(model, 2, 0.5 * length), 4 * n, 0.01 * n);
}

TEST(EdgeLength, IntegratesTheDensity)
{
    // Half of the square with four times the density: edges of one and of two units. The finer half has four
    // fifths of the edges.
    Model model = meshes::MakeModel(shapes::FlatGrid(200), 1000, 180);
    for (std::size_t v = 0; v < model.density.phi.size(); ++v)
        model.density.phi[v] = model.surface.position[v][0] < 0.5 ? 4 : 1;
    const double mean = (0.8 * 1 + 0.2 * 2) * 0.01;
    const double inner = (1 + 0.25) * 0.5 * 2 / std::sqrt(3.0) / (0.01 * 0.01);
    // The boundary has 200 fine edges and 100 coarse ones.
    EXPECT_NEAR(Vertices(model, 1, mean), inner + 1 + 150, 0.003 * inner);
}

TEST(EdgeLength, MeanCountsEveryEdgeOnce)
{
    // A unit square of two triangles: four sides and the diagonal.
    const Model model = meshes::MakeModel(shapes::FlatGrid(1), 4, 180);
    EXPECT_NEAR(MeanEdgeLength(meshes::AsRemesh(model)), (4 + std::sqrt(2.0)) / 5, 1e-15);
}

} // namespace
} // namespace edge_length_test
