// SPDX-License-Identifier: GPL-3.0-or-later
#include <vcg/complex/algorithms/ccdm/parallel.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>

#include <gtest/gtest.h>

#include <vcg/complex/algorithms/ccdm/delaunay.h>
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

TEST(SortInParts, SortsOnAnyNumberOfThreads)
{
    Random random(1);
    for (const int count : {0, 1, 100, Chunks::Size, 50000}) {
        std::vector<std::uint64_t> items(count);
        for (std::uint64_t &x : items)
            x = random.Bits();
        std::vector<std::uint64_t> expected = items;
        std::sort(expected.begin(), expected.end());
        for (const int threads : {1, 2, 3, 5, 8}) {
            Workers workers(threads);
            std::vector<std::uint64_t> sorted = items;
            SortInParts(workers, sorted, std::less<>());
            EXPECT_EQ(sorted, expected) << count << " on " << threads;
        }
    }
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

TEST(PatchSchedule, FollowsFlipsAsIfItLookedAnew)
{
    const Model model = meshes::MakeModel(shapes::Bumpy(5), 10242, 180);
    Remesh r = meshes::AsRemesh(model);
    Workers alone(1);
    PatchSchedule schedule(r, alone);
    const auto order = [](PatchSchedule &s) {
        std::vector<int> visited;
        s.ForVertices([&](int v, int) { visited.push_back(v); });
        return visited;
    };
    const std::vector<int> before = order(schedule);
    Random random(3);
    for (int round = 0; round < 5; ++round) {
        std::vector<Flipped> flips;
        for (int i = 0; i < 2000; ++i) {
            const int t = static_cast<int>(random.Unit() * r.mesh.TriangleCount());
            const Side s = MakeSide(t, static_cast<int>(3 * random.Unit()));
            const Hinge h(r, s);
            if (!MayFlip(r, s, h))
                continue;
            if (PatchOfHinge(r, s) < 0)
                flips.push_back({r.mesh.Tail(s), r.mesh.Head(s), h.apexA, h.apexB});
            r.mesh.Flip(s);
        }
        EXPECT_GT(flips.size(), 50U);
        schedule.Changed(flips);
        PatchSchedule anew(r, alone);
        EXPECT_EQ(order(schedule), order(anew));
    }
    EXPECT_NE(order(schedule), before);
}

TEST(PerWorker, KeepsEachOnLinesOfItsOwn)
{
    const Workers workers(3);
    PerWorker<char> own(workers, 'a');
    for (int w = 0; w < workers.Count(); ++w) {
        EXPECT_EQ(own[w], 'a');
        own[w] = static_cast<char>('b' + w);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(&own[w]) % 128, 0U);
    }
    for (int w = 0; w < workers.Count(); ++w)
        EXPECT_EQ(own[w], 'b' + w);
}

} // namespace
} // namespace parallel_test
