// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"

#include <nlohmann/json_fwd.hpp>

namespace mirtool {

/// What --sampler calls the sampler of a render; the integrator where there is none.
const char* sampler_name(const mir::RenderSettings& settings);

/// Contributions per second of everything that pairs of luxels and VPLs cost.
double contributions_per_second(const mir::RenderStatistics& statistics);

/// Adds all that programs may want to know of a picture, without its warnings.
void add_facts(nlohmann::ordered_json& out, const mir::RenderResult& result,
               const mir::RenderSettings& settings);

}  // namespace mirtool
