// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/runtime/render_pace.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace mirtool {

/// Tells on stderr how a render gets on. On a terminal one line, rewritten five times a second;
/// elsewhere a line for each stage that lasts a second, and one every ten seconds. Stops with its
/// life.
class Progress {
 public:
    explicit Progress(const mir::Monitor& monitor);
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    ~Progress();

 private:
    using Clock = std::chrono::steady_clock;

    void run();
    void look(Clock::time_point now);
    [[nodiscard]] bool is_due(Clock::time_point now);
    void tell() const;

    const mir::Monitor& monitor_;
    bool terminal_;
    std::uint32_t passes_ = 0;
    Clock::time_point pass_start_ = Clock::now();
    mir::RenderPace pace_;
    mir::RenderWork work_;
    Clock::time_point stage_start_ = Clock::now();
    Clock::time_point told_ = Clock::now();
    const char* told_stage_ = nullptr;
    bool stop_ = false;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::thread thread_;
};

/// "light of VPLs 45 %, 172.0 M contributions/s, 3.2 s left".
std::string progress_text(const mir::RenderWork& work, const mir::RenderPace& pace);

/// Makes Ctrl-C cancel `monitor` for the life of the object. A second Ctrl-C ends the program.
class CancelOnInterrupt {
 public:
    explicit CancelOnInterrupt(mir::Monitor& monitor);
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
    ~CancelOnInterrupt();
};

}  // namespace mirtool
