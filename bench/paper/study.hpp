// SPDX-License-Identifier: MIT
#pragma once

#include "machine.hpp"
#include "options.hpp"
#include "row.hpp"

#include <functional>

namespace mirpaper {

/// Measures everything that the options ask for; progress goes to stderr. `keep` is called with
/// what there is after each scene, so that a run that is cut short is not lost.
/// @throws Error(no_device) when a backend was asked for that is not there, and what `keep` throws.
Results run_study(const Options& options, const std::function<void(const Results&)>& keep);

}  // namespace mirpaper
