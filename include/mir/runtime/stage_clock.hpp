// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/runtime/stage_seconds.hpp"

#include <chrono>
#include <thread>

namespace mir {

/// Measures the stages of a render, from its own start on. A stage that begins inside another
/// interrupts it, so that no moment counts twice; what no stage claims is StageSeconds::other.
/// Times are those of one thread, which made it: what others do beside it is part of what it does.
class StageClock {
 public:
    using Stage = StageMember;  ///< which counter a stage adds to

    /// A stage from its construction to its end.
    class Scope {
     public:
        /// Begins `stage`; the stage that it interrupts goes on at its end. The clock must outlive
        /// it. Does nothing on a thread that is not the clock's.
        Scope(StageClock& clock, Stage stage)
            : clock_(clock.is_own_thread() ? &clock : nullptr),
              outer_(clock_ != nullptr ? clock_->change_to(stage) : stage) {}
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;
        ~Scope() {
            if (clock_ != nullptr) clock_->change_to(outer_);
        }

     private:
        StageClock* clock_;  ///< null on other threads
        Stage outer_;
    };

    /// Tells `monitor` which stage it is, unless that is null. Else it must outlive the clock.
    explicit StageClock(Monitor* monitor = nullptr) : monitor_(monitor) { tell(); }
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;
    ~StageClock() = default;

    /// Counts what the calling thread does from now on. No stage may be under way, nor another
    /// thread use the clock meanwhile.
    void follow_this_thread() { thread_ = std::this_thread::get_id(); }

    /// Begins a stage, which lasts as long as what is returned. Callable from any thread.
    [[nodiscard]] Scope measure(Stage stage) { return {*this, stage}; }

    /// Counts seconds of stage `from`, measured by themselves, as those of stage `to`.
    void reassign(double seconds, Stage from, Stage to) {
        seconds_.*from -= seconds;
        seconds_.*to += seconds;
    }

    /// All stages up to now.
    [[nodiscard]] StageSeconds seconds() {
        change_to(current_);
        StageSeconds all = seconds_;
        for (const RenderStage& stage : render_stages) all.total += all.*stage.seconds;
        return all;
    }

 private:
    using Clock = std::chrono::steady_clock;

    [[nodiscard]] bool is_own_thread() const { return std::this_thread::get_id() == thread_; }
    Stage change_to(Stage next) {
        const Clock::time_point now = Clock::now();
        seconds_.*current_ += std::chrono::duration<double>(now - since_).count();
        since_ = now;
        const Stage before = current_;
        current_ = next;
        if (next != before) tell();
        return before;
    }
    void tell() {
        if (monitor_ != nullptr) monitor_->stage = title_of(current_);
    }

    Monitor* monitor_;
    std::thread::id thread_ = std::this_thread::get_id();
    StageSeconds seconds_;
    Stage current_ = &StageSeconds::other;
    Clock::time_point since_ = Clock::now();
};

}  // namespace mir
