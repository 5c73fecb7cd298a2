// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_CCDM_PARALLEL_H
#define VCG_CCDM_PARALLEL_H

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <vector>

namespace vcg {
namespace ccdm {

/// A few threads that work off numbered tasks. What the tasks compute must not depend on which worker
/// runs which, nor on the order: then the result is the same for any number of threads.
class Workers
{
public:
    /// `threads` of them, this one included; 0: as many as the machine has cores. Fewer if the system
    /// or the memory refuses more.
    explicit Workers(int threads)
    {
        const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
        const int wanted = std::clamp(threads > 0 ? threads : cores, 1, MostThreads);
        _thread.reserve(static_cast<std::size_t>(wanted) - 1);
        try {
            for (int i = 1; i < wanted; ++i)
                _thread.emplace_back([this, i] { Serve(i); });
        } catch (const std::system_error &) { // NOLINT(bugprone-empty-catch): fewer threads do as well
        } catch (const std::bad_alloc &) {    // NOLINT(bugprone-empty-catch): those that run must not be left behind
        }
    }
    ~Workers()
    {
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _quit = true;
        }
        _wake.notify_all();
        for (std::thread &t : _thread)
            t.join();
    }
    Workers(const Workers &) = delete;
    Workers &operator=(const Workers &) = delete;

    int Count() const { return static_cast<int>(_thread.size()) + 1; }

    /// Calls task(index, worker) for every index in [0, count), worker being in [0, Count()). Returns when
    /// all are done; rethrows the first exception of a task.
    template <class Task>
    void For(int count, Task task)
    {
        if (_thread.empty() || count <= 1) {
            for (int i = 0; i < count; ++i)
                task(i, 0);
            return;
        }
        {
            const std::lock_guard<std::mutex> lock(_mutex);
            _task = std::ref(task);
            _count = count;
            _next = 0;
            _busy = static_cast<int>(_thread.size());
            _error = nullptr;
            ++_generation;
        }
        _wake.notify_all();
        Work(0);
        std::unique_lock<std::mutex> lock(_mutex);
        _idle.wait(lock, [this] { return _busy == 0; });
        if (_error)
            std::rethrow_exception(_error);
    }

private:
    static constexpr int MostThreads = 256;

    std::vector<std::thread> _thread;
    std::mutex _mutex;
    std::condition_variable _wake, _idle;
    std::function<void(int, int)> _task;
    std::atomic<int> _next{0};
    int _count = 0, _busy = 0;
    long long _generation = 0;
    bool _quit = false;
    std::exception_ptr _error;

    void Work(int worker)
    {
        try {
            for (int i = _next++; i < _count; i = _next++)
                _task(i, worker);
        } catch (...) {
            _next = _count;
            const std::lock_guard<std::mutex> lock(_mutex);
            if (!_error)
                _error = std::current_exception();
        }
    }

    void Serve(int worker)
    {
        long long seen = 0;
        for (;;) {
            {
                std::unique_lock<std::mutex> lock(_mutex);
                _wake.wait(lock, [&] { return _quit || _generation != seen; });
                if (_quit)
                    return;
                seen = _generation;
            }
            Work(worker);
            const std::lock_guard<std::mutex> lock(_mutex);
            if (--_busy == 0)
                _idle.notify_one();
        }
    }
};

/// A thing of their own for each of the workers, far enough apart that no two lie on one cache line: the writes of one
/// would slow down the others. Measured: at a million vertices that took a quarter of the processor time of two
/// threads.
template <class T>
class PerWorker
{
public:
    explicit PerWorker(const Workers &workers, const T &initial = T())
        : _slot(static_cast<std::size_t>(workers.Count()), Slot{initial})
    {
    }

    T &operator[](int worker) { return _slot[static_cast<std::size_t>(worker)].value; }

private:
    // Lines are fetched in pairs.
    struct alignas(128) Slot {
        T value;
    };
    std::vector<Slot> _slot;
};

/// Calls visit(first, last, chunk) for equal runs of [0, count), on several threads; `chunks(count)` of
/// them.
struct Chunks {
    static constexpr int Size = 4096;
    static int Count(int count) { return (count + Size - 1) / Size; }

    template <class Visit>
    static void For(Workers &workers, int count, Visit visit)
    {
        workers.For(Count(count), [&](int c, int) { visit(c * Size, std::min(count, (c + 1) * Size), c); });
    }

    /// What visit(first, last, part) makes of each of these runs, in order. Each thread fills a part of its own, so
    /// that none writes to the cache lines of another.
    template <class Part, class Visit>
    static std::vector<Part> Collect(Workers &workers, int count, const Visit &visit)
    {
        std::vector<Part> parts(static_cast<std::size_t>(Count(count)));
        For(workers, count, [&](int first, int last, int c) {
            Part own{};
            visit(first, last, own);
            parts[c] = std::move(own);
        });
        return parts;
    }

    /// The same, where the parts are lists, as one list.
    template <class Item, class Visit>
    static std::vector<Item> CollectList(Workers &workers, int count, const Visit &visit)
    {
        std::vector<std::vector<Item>> parts = Collect<std::vector<Item>>(workers, count, visit);
        std::size_t size = 0;
        for (const std::vector<Item> &part : parts)
            size += part.size();
        std::vector<Item> all;
        all.reserve(size);
        for (std::vector<Item> &part : parts) {
            all.insert(all.end(), part.begin(), part.end());
            part = std::vector<Item>(); // both at a time would be twice the memory
        }
        return all;
    }

    /// The numbers in [0, count) for which test(number) is true, in order.
    template <class Test>
    static std::vector<int> Where(Workers &workers, int count, const Test &test)
    {
        const auto look = [&](int first, int last, std::vector<int> &found) {
            for (int i = first; i < last; ++i)
                if (test(i))
                    found.push_back(i);
        };
        return CollectList<int>(workers, count, look);
    }
};

/// Sorts by an order in which no two items are equal, so that the result is the same for any number of threads.
template <class Item, class Less>
void SortInParts(Workers &workers, std::vector<Item> &items, const Less &less)
{
    const std::size_t parts = items.size() < Chunks::Size ? 1 : static_cast<std::size_t>(workers.Count());
    const auto begin = [&](std::size_t part) {
        return items.begin() + static_cast<std::ptrdiff_t>(items.size() * std::min(part, parts) / parts);
    };
    workers.For(static_cast<int>(parts), [&](int k, int) { std::sort(begin(k), begin(k + 1), less); });
    for (std::size_t width = 1; width < parts; width *= 2)
        workers.For(static_cast<int>((parts + 2 * width - 1) / (2 * width)), [&](int k, int) {
            const std::size_t first = 2 * width * k;
            std::inplace_merge(begin(first), begin(first + width), begin(first + 2 * width), less);
        });
}

} // namespace ccdm
} // namespace vcg

#endif
