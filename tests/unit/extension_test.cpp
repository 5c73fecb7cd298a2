// SPDX-License-Identifier: GPL-3.0-or-later
// A relocation rule and a sampler that are not the project's go through its stages: what CONTRIBUTING.md tells of.
#include "examples/dart_sampler.h"
#include "examples/neighbour_mean.h"

#include <functional>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/initial_mesh.h>
#include <vcg/complex/algorithms/ccdm/optimizer.h>
#include <vcg/complex/algorithms/ccdm/result_check.h>

#include "support/meshes.h"

namespace extension_test {
namespace {

using namespace vcg::ccdm;

using Sampler =
    std::function<std::vector<SurfacePoint>(const Model &, const std::vector<CurveSample> &, int, Random &)>;

// From a shape to a mesh that is not optimised yet: the remesher's own stages around a sampler.
struct Started {
    Model model;
    Remesh remesh;

    Started(const shapes::Shape &s, int n, double featureAngle, const Sampler &sampler)
        : model(meshes::MakeModel(s, n, featureAngle))
    {
        Random random(1);
        SampleSet samples;
        samples.onCurves = SampleCurves(model.surface, model.features, model.density);
        const int onFeatures = static_cast<int>(samples.onCurves.size() + model.features.corner.size());
        samples.onFaces = sampler(model, samples.onCurves, n - onFeatures, random);
        EXPECT_TRUE(InitialMeshBuilder(model, samples).Build(remesh, [](double) { return true; }));
        remesh.mesh.KeepRings();
    }
};

std::vector<SurfacePoint> Darts(const Model &model, const std::vector<CurveSample> &onCurves, int count, Random &random)
{
    return examples::DartSampler(model).Run(onCurves, count, random);
}

std::vector<SurfacePoint> Drawn(const Model &model, const std::vector<CurveSample> &, int count, Random &random)
{
    return SampleFaces(model.surface, model.density, count, random);
}

double AverageSmallestAngle(const Remesh &r)
{
    double sum = 0;
    for (const Triangle &T : r.mesh.triangle)
        sum += SmallestAngle(r.position[T.v[0]], r.position[T.v[1]], r.position[T.v[2]]) * 180 / Pi;
    return sum / r.mesh.TriangleCount();
}

// Nothing is wrong with the result, and it is of the input's type.
void ExpectSound(const Started &s, int n)
{
    const ResultCheck check(s.model, s.remesh);
    EXPECT_EQ(check.fault, "");
    EXPECT_TRUE(check.topology.SameTypeAs(VerifyTriangulation(s.model.surface.mesh).counts));
    EXPECT_EQ(s.remesh.VertexCount(), n);
}

const struct {
    const char *name;
    shapes::Shape shape;
    double featureAngle;
} cases[] = {{"bumpy", shapes::Bumpy(4), 180},
             {"cad", shapes::CadPart(), 40},
             {"klein", shapes::KleinBottle(50, 30), 180},
             {"plate", shapes::Plate(30), 60}};

TEST(AddedRule, LeadsToTheMeanOfTheNeighbours)
{
    const Model model = meshes::MakeModel(shapes::FlatGrid(6), 49, 180);
    Remesh r = meshes::AsRemesh(model);
    for (int v = 0; v < r.VertexCount(); ++v)
        r.rho[v] = 1 + r.position[v][0];
    for (const bool uniform : {true, false})
        Relocator(model, r).Sweep([&](const LocalStar &star, int v) {
            Point sum(0, 0, 0);
            double mass = 0;
            r.mesh.VisitSpokes(v, [&](int w, Side) {
                const double m = uniform ? 1 : r.rho[v] + r.rho[w];
                sum += r.position[w] * m;
                mass += m;
                return true;
            });
            const examples::NeighbourMean rule{r, uniform};
            EXPECT_LT(Norm(r.position[v] + rule(star, v) - sum / mass), 1e-12);
            return Point(0, 0, 0);
        });
}

// As the optimiser runs its own rules: flips and sweeps, with momentum, then the paper's relocations and the closing.
TEST(AddedRule, GoesThroughTheOptimisersSteps)
{
    for (const auto &c : cases) {
        SCOPED_TRACE(c.name);
        const int n = 1500;
        Started s(c.shape, n, c.featureAngle, Drawn);
        const double before = AverageSmallestAngle(s.remesh);
        Workers &workers = meshes::Alone();
        Relocator relocator(s.model, s.remesh);
        DelaunayFlipper flipper(workers);
        std::vector<Point> last = s.remesh.position;
        const HeavyBall<examples::NeighbourMean> pull = {{s.remesh, true}, {{s.remesh, true}}, s.remesh.position, last};
        for (int i = 0; i < 40; ++i) {
            flipper.Run(s.remesh);
            relocator.Sweep(pull);
        }
        flipper.Run(s.remesh);
        Params params = meshes::Quick(n);
        params.globalIterations = 0;
        Report report;
        Optimizer optimizer(s.model, params, s.remesh, report, workers);
        EXPECT_TRUE(optimizer.Run(0, [](double) { return true; }));
        EXPECT_TRUE(optimizer.Close([](double) { return true; }));
        ExpectSound(s, n);
        EXPECT_GT(AverageSmallestAngle(s.remesh), before + 10);
        EXPECT_GT(AverageSmallestAngle(s.remesh), 47); // without noise it stalls there
    }
}

TEST(AddedSampler, KeepsItsPointsApart)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(4), 1000, 180);
    const auto closePairs = [&](const Sampler &sampler) {
        Random random(1);
        const std::vector<SurfacePoint> samples = sampler(model, {}, 1000, random);
        EXPECT_EQ(samples.size(), 1000U);
        int close = 0;
        for (std::size_t i = 0; i < samples.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                close +=
                    Norm(model.surface.At(samples[i]) - model.surface.At(samples[j])) < 0.5 * model.density.spacing[0];
        return close;
    };
    EXPECT_LT(closePairs(Darts), closePairs(Drawn) / 3);
}

TEST(AddedSampler, StartsARunOfTheOptimiser)
{
    for (const auto &c : cases) {
        SCOPED_TRACE(c.name);
        const int n = 1500;
        Started s(c.shape, n, c.featureAngle, Darts);
        const Params params = meshes::Quick(n);
        Report report;
        Optimizer optimizer(s.model, params, s.remesh, report, meshes::Alone());
        EXPECT_TRUE(optimizer.Run(0, [](double) { return true; }));
        EXPECT_TRUE(optimizer.Close([](double) { return true; }));
        ExpectSound(s, n);
        EXPECT_GT(AverageSmallestAngle(s.remesh), 53.9);
    }
}

} // namespace
} // namespace extension_test
