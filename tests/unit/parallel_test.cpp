// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/parallel.h>

#include <stdexcept>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/patch_schedule.h>

#include "support/meshes.h"

namespace parallel_test {
namespace {

using namespace vcg::ccdm;

TEST(Workers, DoEveryTaskOnce)
{
    for (const int threads : {1, 2, 4}) {
        Workers workers(threads);
        for (const int count : {0, 1, 7, 1000}) {
            std::vector<std::atomic<int>> done(count);
            workers.For(count, [&](int i, int worker) {
                EXPECT_LT(worker, workers.Count());
                ++done[i];
            });
            for (const auto &d : done)
                EXPECT_EQ(d, 1);
        }
    }
}

TEST(Workers, HandOnAnException)
{
    Workers workers(3);
    EXPECT_THROW(workers.For(100,
                             [](int i, int) {
                                 if (i == 50)
                                     throw std::runtime_error("one fails");
                             }),
                 std::runtime_error);
    int sum = 0;
    workers.For(1, [&](int, int) { ++sum; });
    EXPECT_EQ(sum, 1) << "and work on afterwards";
}

TEST(PatchSchedule, VisitsEveryVertexOnceAndNeverTwoNeighboursAtATime)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(5), 10242, 180);
    const Remesh r = meshes::AsRemesh(model);
    Workers workers(4);
    PatchSchedule schedule(r, workers);
    std::vector<std::atomic<int>> busy(r.VertexCount());
    std::vector<int> visits(r.VertexCount(), 0);
    std::atomic<int> clashes{0};
    schedule.ForVertices([&](int v, int) {
        busy[v] = 1;
        ++visits[v];
        r.mesh.VisitSpokes(v, [&](int o, Side) {
            clashes += busy[o];
            return true;
        });
        busy[v] = 0;
    });
    EXPECT_EQ(clashes, 0);
    for (const int n : visits)
        EXPECT_EQ(n, 1);
}

} // namespace
} // namespace parallel_test
