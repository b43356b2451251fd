// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <mutex>
#include <utility>

#include "garmentfit/error.h"

namespace garmentfit::cli {
namespace {

constexpr double k_time_to_stop = 0.7;  // unit: s
constexpr double k_time_to_finish = 10;  // unit: s, at least

volatile std::sig_atomic_t g_signal = 0;  // that interrupted, 0 while none did
timer_t g_timer;  // rings on a thread of its own
std::mutex g_mutex;  // of the next two
std::function<void(ForcedEnd)> g_end;
bool g_is_watching = false;

// Of what POSIX allows in a handler of signals.
void ring_in(double seconds)
{
    itimerspec when {};
    when.it_value.tv_sec = std::time_t(seconds);
    when.it_value.tv_nsec = long(1e9 * (seconds - std::floor(seconds)));
    timer_settime(g_timer, 0, &when, nullptr);
}

void keep_signal(int signal)
{
    g_signal = signal;
    ring_in(k_time_to_stop);
}

void force_end(sigval)
{
    const std::lock_guard lock(g_mutex);
    if (g_is_watching)
        g_end(interrupted() ? ForcedEnd::stopped : ForcedEnd::time_limit);
}

}  // namespace

void watch_interruption(std::function<void(ForcedEnd)> end)
{
    const std::lock_guard lock(g_mutex);
    const bool is_first = !g_end;
    g_end = std::move(end);
    g_is_watching = true;
    sigevent event {};
    event.sigev_notify = SIGEV_THREAD;
    event.sigev_notify_function = force_end;
    if (is_first)
        timer_create(CLOCK_MONOTONIC, &event, &g_timer);
    struct sigaction action { };
    action.sa_handler = keep_signal;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return g_signal != 0; }

std::string interruption_text()
{
    return g_signal == SIGTERM
        ? "ended by SIGTERM, as `timeout`, `kill` and schedulers send it; to get the best result "
          "within a given time, use --time-limit"
        : Cancelled().what();
}

void stop_if_interrupted()
{
    if (interrupted())
        throw Cancelled();
}

void watch_time_limit(double seconds)
{
    if (seconds > 0 && !interrupted())
        ring_in(seconds + std::max(seconds, k_time_to_finish));
}

void stop_watching()
{
    const std::lock_guard lock(g_mutex);
    g_is_watching = false;
    ring_in(0);
}

}  // namespace garmentfit::cli
