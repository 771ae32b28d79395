// SPDX-License-Identifier: MIT
#include "host_render.hpp"
#include "mir/runtime/sampler_choice.hpp"

template mir::SampledVpls mir::sample_vpls(
    const mir::RenderContext<mir::Lambert, mir::AnyEngine, mir::cpu::HostLoops>&,
    const mir::LightTable&, float);
template mir::SampledVpls mir::sample_vpls(
    const mir::RenderContext<mir::CookTorrance, mir::AnyEngine, mir::cpu::HostLoops>&,
    const mir::LightTable&, float);
