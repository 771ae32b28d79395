// expect: mir: sched::Cpu needs a Visibility that lives in host memory
// SPDX-License-Identifier: MIT
#include "mir/concepts/archetypes.hpp"
#include "mir/sched/cpu.hpp"

namespace archetype = mir::archetype;

#ifdef MIR_COMPILE_FAIL
using Visibility = archetype::DeviceVisibility;
#else
using Visibility = archetype::Visibility;
#endif

mir::Image<mir::Rgb> render(const archetype::TiledGBuffer& gbuffer, archetype::VplSet vpls,
                            Visibility visibility, archetype::Shading shading) {
    mir::InlineExecutor executor;
    return mir::reconstruct(mir::sched::Cpu{executor}, gbuffer, vpls, visibility, shading);
}
