// SPDX-License-Identifier: MIT
#pragma once

#include "exit_code.hpp"
#include "text.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

namespace mirtool {

/// What to say about a failure that is none of the library's own errors.
inline std::string sentence_of(const std::exception& e) {
    const auto* system = dynamic_cast<const std::system_error*>(&e);
    const bool no_thread =
        system != nullptr && system->code() == std::errc::resource_unavailable_try_again;
    // TBB has no type of its own for it.
    if (no_thread || std::string(e.what()).find("pthread_create") != std::string::npos)
        return "no further thread can be started (" + shown(e.what()) +
               "); ask for fewer with --threads, or raise the limit of processes (ulimit -u)";
    if (dynamic_cast<const std::bad_alloc*>(&e) != nullptr)
        return "out of memory (the picture or scene is too large for this machine); ask for fewer "
               "pixels, luxels or VPLs";
    return "unexpected failure: " + shown(e.what());
}

/// Says why the program fails, on standard error, the first time that it is called. What follows
/// from a failure is no news.
inline void say_failure(const std::string& sentence) {
    static std::atomic<bool> is_said{false};
    if (!is_said.exchange(true)) std::fprintf(stderr, "mir: %s\n", sentence.c_str());
}

namespace detail {

/// Libraries throw where nothing may: TBB when a thread cannot be started, whatever called it.
[[noreturn]] inline void end_after_failure() noexcept {
    try {
        if (const std::exception_ptr failure = std::current_exception())
            std::rethrow_exception(failure);
        say_failure("unexpected failure: a library gave up");
    } catch (const std::exception& e) {
        say_failure(sentence_of(e));
    } catch (...) {
        say_failure("unexpected failure: of unknown kind");
    }
    std::_Exit(exit_failure);
}

/// Opens the numbers of closed streams before files can take them. What is meant for people would
/// be written into these files.
inline void open_standard_streams() {
    for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
        const bool is_closed = fcntl(descriptor, F_GETFD) < 0 && errno == EBADF;
        // The lowest number that is free: this one.
        if (is_closed && open("/dev/null", O_RDWR) != descriptor) std::_Exit(exit_failure);
    }
}

}  // namespace detail

/// To be called before anything else.
inline void prepare_process() {
    detail::open_standard_streams();
    // A file that becomes too large is an error of writing like others.
    std::signal(SIGXFSZ, SIG_IGN);
    std::set_terminate(detail::end_after_failure);
}

/// The exit code of a program, once its results are written. It would end with `code`.
inline int end_results(int code) {
    errno = 0;
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    say_failure(std::string("standard output cannot be written (") +
                (errno != 0 ? std::strerror(errno) : "some of it was not taken") +
                "); free space there");
    return code == exit_done ? exit_failure : code;
}

}  // namespace mirtool
