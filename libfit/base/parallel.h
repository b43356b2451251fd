// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Loops that run on all cores, in any order. No other file knows how the work is divided.

#include <algorithm>
#include <optional>
#include <vector>

#ifdef __SANITIZE_THREAD__
#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#else
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace garmentfit {

/// Calls turn(i) for each i in [0, count). `grain`: so many calls are worth a switch to another thread.
/// An exception of a call ends the loop and is passed on.
#ifdef __SANITIZE_THREAD__
// The thread sanitizer cannot see synchronisation within libtbb, but it knows plain threads.
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

/// Collects what turn(i), a std::optional<T>, returns for i in [0, count), in order, without empty ones.
template <class T, class Turn>
std::vector<T> parallel_collect(std::size_t count, const Turn& turn)
{
    constexpr std::size_t k_chunk = 1024;  // unit: decides speed only
    std::vector<std::vector<T>> chunks((count + k_chunk - 1) / k_chunk);
    parallel_for(chunks.size(), [&](std::size_t c) {
        for (std::size_t i = c * k_chunk; i < std::min(count, (c + 1) * k_chunk); ++i)
            if (const std::optional<T> one = turn(i))
                chunks[c].push_back(*one);
    });
    std::vector<T> result;
    for (const std::vector<T>& chunk : chunks)
        result.insert(result.end(), chunk.begin(), chunk.end());
    return result;
}

}  // namespace garmentfit
