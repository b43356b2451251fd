// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_apart.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "garmentfit/error.h"

namespace garmentfit {
namespace {

constexpr char k_done = '+', k_failed = '-';  // unit: the first byte of what the copy sends

bool send(int pipe, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = write(pipe, bytes.data(), bytes.size());
        if (sent < 0)
            return false;
        bytes.remove_prefix(std::size_t(sent));
    }
    return true;
}

/// Mangled counts must not take the memory of other programs. Sanitizers reserve more than any limit.
void limit_memory()
{
#ifndef __SANITIZE_ADDRESS__
    constexpr rlim_t k_most_bytes = rlim_t(4) << 30;  // unit: files of 100 MB take less
    const rlimit limit { k_most_bytes, k_most_bytes };
    setrlimit(RLIMIT_DATA, &limit);
#endif
}

/// Never returns: the copy must not unwind into its caller.
[[noreturn]] void work_and_send(const std::function<std::string()>& work, int pipe)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const int signal_number : { SIGTERM, SIGABRT, SIGSEGV })
        signal(signal_number, SIG_DFL);
    signal(SIGINT, SIG_IGN);  // Ctrl-C is for the program, and its end is the copy's
    limit_memory();
    std::string result;
    try {
        result = k_done + work();
    } catch (const std::exception& error) {
        result = k_failed + std::string(error.what());
    }
    _exit(send(pipe, result) ? 0 : 1);
}

/// All that comes before the pipe closes. @return false when the deadline passes first
bool receive(int pipe, std::chrono::steady_clock::time_point deadline, std::string& bytes)
{
    std::array<char, 1 << 16> part;
    for (;;) {
        const auto left
            = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        pollfd ready { pipe, POLLIN, 0 };
        if (left.count() <= 0)
            return false;
        if (poll(&ready, 1, int(left.count())) <= 0)
            continue;  // the time is up, or a signal came
        const ssize_t count = read(pipe, part.data(), part.size());
        if (count <= 0)
            return true;
        bytes.append(part.data(), std::size_t(count));
    }
}

}  // namespace

ApartResult run_apart(const std::function<std::string()>& work, std::chrono::seconds limit)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw SolverFailure("no pipe to a process of its own can be opened; close files or programs");
    const pid_t copy = fork();
    if (copy == 0) {
        close(ends[0]);
        work_and_send(work, ends[1]);
    }
    close(ends[1]);
    ApartResult result;
    if (copy > 0) {
        std::string received;
        result.out_of_time = !receive(ends[0], std::chrono::steady_clock::now() + limit, received);
        if (result.out_of_time)
            kill(copy, SIGKILL);
        int status = 0;
        while (waitpid(copy, &status, 0) < 0 && errno == EINTR) { }
        const bool ended_well = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !received.empty();
        result.is_done = ended_well && received[0] == k_done;
        if (ended_well)
            result.bytes = received.substr(1);
    }
    close(ends[0]);
    if (copy < 0)
        throw SolverFailure("no process of its own can be started; close programs");
    return result;
}

}  // namespace garmentfit
