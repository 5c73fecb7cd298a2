// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that get no memory, from some allocation on or just once. A program of its own, as it replaces operator new.
#include <vcg/complex/algorithms/ccdm_remeshing.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <memory>
#include <new>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "support/mesh_state.h"
#include "support/meshes.h"

namespace {

std::atomic<long long> made{0}, live{0};
// Allocations from `firstRefused` to `lastRefused` are refused.
std::atomic<long long> firstRefused{0}, lastRefused{-1};

} // namespace

void *operator new(std::size_t size)
{
    const long long k = ++made;
    void *p = k >= firstRefused && k <= lastRefused ? nullptr : std::malloc(size > 0 ? size : 1);
    if (p == nullptr)
        throw std::bad_alloc();
    ++live;
    return p;
}
void *operator new[](std::size_t size)
{
    return operator new(size);
}
void operator delete(void *p) noexcept
{
    live -= p != nullptr;
    std::free(p);
}
void operator delete[](void *p) noexcept
{
    operator delete(p);
}
void operator delete(void *p, std::size_t /*size*/) noexcept
{
    operator delete(p);
}
void operator delete[](void *p, std::size_t /*size*/) noexcept
{
    operator delete(p);
}

namespace {

using mesh_state::Bytes;
using mesh_state::GeometryOf;
using meshes::MeshD;
using meshes::MeshF;
using vcg::ccdm::Params;
using vcg::ccdm::Report;
using vcg::ccdm::Status;

enum class Outcome { Done, OutOfMemory };

// Refuses the k-th allocation from now on, and all after it unless it is to be just one.
template <class Run>
Outcome Starved(const Run &run, long long k, bool once)
{
    firstRefused = made + k;
    lastRefused = once ? firstRefused.load() : std::numeric_limits<long long>::max();
    Outcome outcome = Outcome::Done;
    try {
        run();
    } catch (const std::bad_alloc &) {
        outcome = Outcome::OutOfMemory;
    }
    lastRefused = -1;
    return outcome;
}

// `count` numbers in [1, total] all over, and the `ends` first and last ones.
std::vector<long long> Places(long long total, int count, int ends)
{
    std::vector<long long> places;
    std::mt19937 random(1);
    std::uniform_int_distribution<long long> anywhere(1, total);
    for (int k = 0; k < count; ++k)
        places.push_back(anywhere(random));
    for (long long k = 0; k < ends; ++k) {
        places.push_back(1 + k);
        places.push_back(total - k);
    }
    return places;
}

// A mesh to run on, one to write to, and all that must stay where that fails.
struct Scene {
    MeshD in, out;
    vcg::ccdm::Provenance provenance;
    std::string inBefore, outBefore;

    explicit Scene(const shapes::Shape &shape)
    {
        meshes::Fill(in, shape);
        for (auto &f : in.face)
            if (f.cP(0)[2] + f.cP(1)[2] + f.cP(2)[2] > 0)
                f.SetS();
        meshes::Fill(out, shapes::Tetrahedron());
        inBefore = Bytes(in);
        outBefore = Bytes(out);
    }

    void Run(const Params &params, bool inPlace)
    {
        MeshD &to = inPlace ? in : out;
        const Report r = vcg::tri::CCDMRemeshing<MeshD>::Do(in, to, params, nullptr, &provenance);
        if (r.status != Status::Done)
            throw std::runtime_error(r.message);
    }

    bool Untouched() const { return Bytes(in) == inBefore && Bytes(out) == outBefore && provenance.face.empty(); }
};

void ExpectNothingLost(const shapes::Shape &shape, Params params, int places, int ends)
{
    for (const int threads : {1, 2}) {
        params.threads = threads;
        Scene measured(shape);
        measured.Run(params, false); // makes what is made just once, too
        const mesh_state::Geometry undisturbed = GeometryOf(measured.out);
        const long long start = made;
        measured.Run(params, false);
        const long long total = made - start;
        auto scene = std::make_unique<Scene>(shape);
        int turn = 0;
        for (const long long k : Places(total, places, ends)) {
            const bool once = turn % 2 == 0, inPlace = turn / 2 % 2 == 0;
            ++turn;
            const long long before = live;
            const Outcome outcome = Starved([&] { scene->Run(params, inPlace); }, k, once);
            const long long after = live;
            if (outcome == Outcome::OutOfMemory) {
                ASSERT_EQ(after, before) << "allocation " << k << " of " << total << " on " << threads << " threads";
                ASSERT_TRUE(scene->Untouched()) << "allocation " << k << " of " << total;
            } else {
                // A thread that could not be had is done without.
                EXPECT_TRUE(once) << "allocation " << k << " of " << total;
                EXPECT_TRUE(GeometryOf(inPlace ? scene->in : scene->out) == undisturbed);
                scene = std::make_unique<Scene>(shape);
            }
        }
        scene->Run(params, true);
        EXPECT_TRUE(GeometryOf(scene->in) == undisturbed);
    }
}

TEST(WithoutMemory, FewerThreadsWorkAsWell)
{
    for (long long k = 2; k < 10; ++k) { // the first is for the list of threads
        std::atomic<int> done{0};
        const auto run = [&] { vcg::ccdm::Workers(4).For(100, [&](int, int) { ++done; }); };
        EXPECT_EQ(Starved(run, 1, false), Outcome::OutOfMemory);
        EXPECT_EQ(Starved(run, k, false), Outcome::Done);
        EXPECT_EQ(done, 100);
    }
}

TEST(WithoutMemory, NothingIsLostOnASmoothSurface)
{
    ExpectNothingLost(shapes::Bumpy(2), meshes::Quick(300), 150, 10);
}

TEST(WithoutMemory, NothingIsLostWithFeatures)
{
    Params p = meshes::Quick(250);
    p.approximation = 1;
    p.density = vcg::ccdm::DensityKind::Curvature;
    ExpectNothingLost(shapes::TwistedBar(16, 2), p, 120, 10);
}

TEST(WithoutMemory, NothingIsLostOfASelection)
{
    Params p = meshes::Quick(200);
    p.featureAngle = 180;
    p.selectedFacesOnly = true;
    ExpectNothingLost(shapes::Bumpy(2), p, 50, 10);
}

TEST(WithoutMemory, NothingIsLostInASearch)
{
    Params p = meshes::Quick(0);
    p.maxError = 0.03;
    ExpectNothingLost(shapes::Bumpy(2), p, 6, 2);
}

// Optional components and attributes take memory of their own when the result is handed out.
TEST(WithoutMemory, OptionalComponentsAreLeftAlone)
{
    const Params params = meshes::Quick(400);
    MeshF m;
    meshes::Fill(m, shapes::Bumpy(2));
    m.vert.EnableQuality();
    m.face.EnableFFAdjacency();
    auto onVertex = vcg::tri::Allocator<MeshF>::AddPerVertexAttribute<int>(m, "number");
    auto onFace = vcg::tri::Allocator<MeshF>::AddPerFaceAttribute<double>(m, "weight");
    for (int v = 0; v < m.VN(); ++v) {
        m.vert[v].Q() = static_cast<float>(v);
        onVertex[v] = v;
    }
    for (int f = 0; f < m.FN(); ++f) {
        m.face[f].FFi(0) = static_cast<char>(f % 3);
        onFace[f] = f;
    }
    const auto untouched = [&] {
        bool same = m.VN() == 162 && m.FN() == 320 && m.vert.QV.size() == 162;
        for (int v = 0; v < m.VN() && same; ++v)
            same = m.vert[v].Q() == static_cast<float>(v) && onVertex[v] == v;
        for (int f = 0; f < m.FN() && same; ++f)
            same = m.face[f].FFi(0) == static_cast<char>(f % 3) && onFace[f] == f;
        return same;
    };
    ASSERT_TRUE(untouched());
    const auto run = [&] { vcg::tri::CCDMRemeshing<MeshF>::Do(m, params); };
    // The last allocations, without knowing how many there are: from the first on that changes something, back.
    MeshF other;
    meshes::Fill(other, shapes::Bumpy(2));
    vcg::tri::CCDMRemeshing<MeshF>::Do(other, params);
    meshes::Fill(other, shapes::Bumpy(2));
    const long long start = made;
    vcg::tri::CCDMRemeshing<MeshF>::Do(other, params);
    const long long total = made - start;
    for (long long k = total - 20;; ++k) {
        if (Starved(run, k, false) == Outcome::Done)
            break;
        ASSERT_TRUE(untouched()) << "allocation " << k - total << " after the last of a mesh without components";
    }
    ASSERT_EQ(m.VN(), 400);
    ASSERT_EQ(m.vert.QV.size(), 400U);
    EXPECT_TRUE(m.vert.IsQualityEnabled() && m.face.IsFFAdjacencyEnabled());
    for (int v = 0; v < m.VN(); ++v) {
        EXPECT_EQ(&m.vert[v].Base(), &m.vert);
        onVertex[v] = v;
        m.vert[v].Q() = 1;
    }
    for (int f = 0; f < m.FN(); ++f) {
        EXPECT_EQ(&m.face[f].Base(), &m.face);
        onFace[f] = f;
    }
    EXPECT_TRUE(vcg::tri::Allocator<MeshF>::IsValidHandle(m, onVertex));
}

} // namespace
