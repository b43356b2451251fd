// SPDX-License-Identifier: GPL-3.0-or-later
#include "interruption.h"

#include <csignal>

#include "garmentfit/error.h"

namespace garmentfit::cli {
namespace {

volatile std::sig_atomic_t g_interrupted = 0;

void raise_flag(int) { g_interrupted = 1; }

}  // namespace

void watch_interruption()
{
    struct sigaction action { };
    action.sa_handler = raise_flag;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() { return g_interrupted != 0; }

void stop_if_interrupted()
{
    if (interrupted())
        throw Cancelled();
}

}  // namespace garmentfit::cli
