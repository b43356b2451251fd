// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// A loop whose turns run on all cores, in any order: the only place that knows how oneTBB shares out work.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace fit {

/// The thread sanitizer cannot look into libtbb, where threads hand work to each other. This tells it what the library promises:
/// what precedes a loop happens before each turn, and each turn before what follows the loop. It hides nothing that turns do to
/// each other.
class LoopOrder {
public:
#ifdef __SANITIZE_THREAD__
    LoopOrder() { __tsan_release(&begin_); }
    ~LoopOrder() { __tsan_acquire(&end_); }
    void turn_begins() { __tsan_acquire(&begin_); }
    void turn_ends() { __tsan_release(&end_); }

private:
    char begin_ = 0, end_ = 0;
#else
    void turn_begins() { }
    void turn_ends() { }
#endif
};

/// Calls turn(i) for each i in [0, count). `grain`: as many turns as are worth handing to another thread.
/// An exception of a turn ends the loop and is passed on.
template <class Index, class Turn>
void parallel_for(Index count, const Turn& turn, Index grain = 1)
{
    LoopOrder order;
    tbb::parallel_for(tbb::blocked_range<Index>(0, count, grain), [&](const tbb::blocked_range<Index>& range) {
        order.turn_begins();
        for (Index i = range.begin(); i < range.end(); ++i)
            turn(i);
        order.turn_ends();
    });
}

}  // namespace fit
