// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <utility>

namespace mirtool {
namespace {

bool stderr_is_terminal() {
    const char* term = std::getenv("TERM");
    return isatty(STDERR_FILENO) != 0 && term != nullptr && std::strcmp(term, "dumb") != 0;
}

// A signal handler takes no argument: what it cancels has to be global.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables)
std::atomic<mir::Monitor*> interrupted_monitor{nullptr};

extern "C" void on_interrupt(int signal) {
    if (mir::Monitor* monitor = interrupted_monitor.load()) monitor->cancelled = true;
    std::signal(signal, SIG_DFL);
}

}  // namespace

std::string progress_text(const mir::RenderWork& work, const mir::RenderPace& pace) {
    std::string text = work.stage != nullptr ? work.stage : "preparing";
    char figures[96];
    if (const std::optional<double> share = work.stage_share()) {
        std::snprintf(figures, sizeof figures, " %.0f %%", 100.0 * *share);
        text += figures;
    }
    if (const std::optional<double> left = pace.seconds_left()) {
        std::snprintf(figures, sizeof figures, ", %.1f M %s/s, %.1f s left", 1e-6 * pace.rate(),
                      work.unit, *left);
        text += figures;
    }
    return text;
}

Progress::Progress(const mir::Monitor& monitor)
    : monitor_(monitor), terminal_(stderr_is_terminal()), thread_([this] { run(); }) {}

Progress::~Progress() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_all();
    thread_.join();
    if (terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::run() {
    constexpr std::chrono::milliseconds period(200);
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, period, [this] { return stop_; })) {
        const Clock::time_point now = Clock::now();
        look(now);
        if (terminal_ || is_due(now)) tell();
    }
}

void Progress::look(Clock::time_point now) {
    const std::uint32_t done = monitor_.passes.load();
    if (done != std::exchange(passes_, done)) {
        pass_start_ = now;
        pace_ = {};
    }
    const char* before = work_.stage;
    work_ = mir::work_of(monitor_);
    if (work_.stage != before) stage_start_ = now;
    pace_.look(work_, std::chrono::duration<double>(now - pass_start_).count());
}

/// For outputs where lines stay: a stage is told when it has lasted. It is told again from time to
/// time.
bool Progress::is_due(Clock::time_point now) {
    constexpr std::chrono::seconds lasting(1);
    constexpr std::chrono::seconds from_time_to_time(10);
    const bool is_new = work_.stage != told_stage_ && now - stage_start_ >= lasting;
    if (!is_new && now - told_ < from_time_to_time) return false;
    told_ = now;
    told_stage_ = work_.stage;
    return true;
}

void Progress::tell() const {
    const std::string pass = passes_ > 0 ? "pass " + std::to_string(passes_ + 1) + ", " : "";
    const std::string text = pass + progress_text(work_, pace_);
    std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "mir: %s\n", text.c_str());
    std::fflush(stderr);
}

CancelOnInterrupt::CancelOnInterrupt(mir::Monitor& monitor) {
    interrupted_monitor = &monitor;
    std::signal(SIGINT, on_interrupt);
    std::signal(SIGTERM, on_interrupt);
}

CancelOnInterrupt::~CancelOnInterrupt() {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    interrupted_monitor = nullptr;
}

}  // namespace mirtool
