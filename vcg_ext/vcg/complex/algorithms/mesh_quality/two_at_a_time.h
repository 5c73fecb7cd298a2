// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef VCG_MESH_QUALITY_TWO_AT_A_TIME_H
#define VCG_MESH_QUALITY_TWO_AT_A_TIME_H

#include <future>

namespace vcg {
namespace tri {

/// Does two things that have nothing to do with each other; `parallel`: at the same time, if the system has a thread
/// to spare. Passes on what the first throws, or else the second; none is left running.
template <class First, class Second>
void TwoAtATime(bool parallel, const First &first, const Second &second)
{
    if (!parallel) {
        first();
        second();
        return;
    }
    // Where no thread can be had, it is done in get().
    std::future<void> other = std::async(std::launch::async | std::launch::deferred, second);
    first();
    other.get();
}

} // namespace tri
} // namespace vcg

#endif
