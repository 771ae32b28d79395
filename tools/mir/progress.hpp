// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace mirtool {

/// Tells on stderr how a render gets on: on a terminal one line, rewritten five times a second;
/// elsewhere a line every ten seconds. Stops with its life.
class Progress {
 public:
    explicit Progress(const mir::Monitor& monitor);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

 private:
    void run();

    const mir::Monitor& monitor_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    bool terminal_;
    bool stop_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread thread_;
};

/// How far a render is.
struct Work {
    std::uint64_t done = 0;
    std::uint64_t planned = 0;  ///< 0: not known yet
    const char* unit = "";
};

Work work_of(const mir::Monitor& monitor);

/// "45 %  172.00 M contributions/s  3.2 s left" for work done in `seconds`.
std::string progress_text(const Work& work, double seconds);

/// Makes Ctrl-C cancel `monitor` for the life of the object; a second Ctrl-C ends the program.
class CancelOnInterrupt {
 public:
    explicit CancelOnInterrupt(mir::Monitor& monitor);
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
    ~CancelOnInterrupt();
};

}  // namespace mirtool
