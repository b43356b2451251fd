// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A loop whose turns run on all cores, in any order: the only place that knows how the work is shared out.

#ifdef __SANITIZE_THREAD__
#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace fit {

/// Calls turn(i) for each i in [0, count). `grain`: as many turns as are worth handing to another thread.
/// An exception of a turn ends the loop and is passed on.
#ifdef __SANITIZE_THREAD__
// The thread sanitizer cannot look into libtbb, where threads hand work to each other, but it knows plain threads.
template <class Index, class Turn>
void parallel_for(Index count, const Turn& turn, Index grain = 1)
{
    std::atomic<Index> next = 0;
    std::exception_ptr thrown;
    std::mutex one_throws;
    const auto work = [&] {
        for (Index first; (first = next.fetch_add(grain)) < count;)
            try {
                for (Index i = first; i < std::min<Index>(first + grain, count); ++i)
                    turn(i);
            } catch (...) {
                const std::lock_guard lock(one_throws);
                thrown = std::current_exception();
                next = count;
            }
    };
    std::array<std::thread, 2> others;
    if (count > grain)
        for (std::thread& other : others)
            other = std::thread(work);
    work();
    for (std::thread& other : others)
        if (other.joinable())
            other.join();
    if (thrown)
        std::rethrow_exception(thrown);
}
#else
template <class Index, class Turn>
void parallel_for(Index count, const Turn& turn, Index grain = 1)
{
    tbb::parallel_for(tbb::blocked_range<Index>(0, count, grain), [&](const tbb::blocked_range<Index>& range) {
        for (Index i = range.begin(); i < range.end(); ++i)
            turn(i);
    });
}
#endif

}  // namespace fit
