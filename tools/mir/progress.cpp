// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
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

std::string progress_text(const Work& work, double seconds) {
    if (work.planned == 0 || work.done == 0) return "preparing";
    const std::uint64_t done = std::min(work.done, work.planned);
    const double share = static_cast<double>(done) / static_cast<double>(work.planned);
    const double rate = seconds > 0.0 ? static_cast<double>(done) / seconds : 0.0;
    const double left = rate > 0.0 ? static_cast<double>(work.planned - done) / rate : 0.0;
    char text[96];
    std::snprintf(text, sizeof text, "%3.0f %%  %.2f M %s/s  %.1f s left", 100.0 * share,
                  1e-6 * rate, work.unit, left);
    return text;
}

Work work_of(const mir::Monitor& monitor) {
    if (const std::uint64_t planned = monitor.planned_gathers.load(); planned != 0)
        return {monitor.gathers.load(), planned, "gathers"};
    return {monitor.contributions.load(), monitor.planned_contributions.load(), "contributions"};
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
    const auto period = terminal_ ? std::chrono::milliseconds(200) : std::chrono::seconds(10);
    std::uint32_t passes = 0;
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, period, [this] { return stop_; })) {
        const std::uint32_t done = monitor_.passes.load();
        if (done != std::exchange(passes, done)) start_ = std::chrono::steady_clock::now();
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        const std::string text =
            (passes > 0 ? "pass " + std::to_string(passes + 1) + "  " : std::string()) +
            progress_text(work_of(monitor_), seconds);
        std::fprintf(stderr, terminal_ ? "\r%s\033[K" : "mir: %s\n", text.c_str());
        std::fflush(stderr);
    }
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
