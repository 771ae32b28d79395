// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"

#include <nanobind/nanobind.h>

#include <functional>
#include <optional>
#include <string>

namespace mirpy {

/// What a progress callback is told.
struct PyProgress {
    std::string stage;                   ///< what a person reads
    std::optional<double> share;         ///< of the pass, 0..1, where it is known
    std::optional<double> seconds_left;  ///< of the pass, where it can be told
    double seconds = 0.0;                ///< since it began
    std::uint32_t passes = 0;            ///< behind it
    bool done = false;                   ///< it is the last call
};

/// Runs `work` on a thread of its own. Meanwhile this one, which holds the GIL, looks after signals
/// and tells `progress`, which may be None, ten times a second. What Python raises there cancels
/// `monitor`, which `work` must look at, and is raised when that has ended.
void watched(mir::Monitor& monitor, nanobind::handle progress, const std::function<void()>& work);

/// Declares the class Progress.
void bind_watch(nanobind::module_& m);

}  // namespace mirpy
