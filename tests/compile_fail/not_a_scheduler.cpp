// expect: mir: the first argument of reconstruct() is not a Scheduler for these inputs
// SPDX-License-Identifier: MIT
#include "mir/concepts/archetypes.hpp"
#include "mir/reconstruct.hpp"

namespace archetype = mir::archetype;

#ifdef MIR_COMPILE_FAIL
using Scheduler = archetype::Pipeline;
#else
using Scheduler = archetype::Scheduler;
#endif

mir::Image<mir::Rgb> render(const Scheduler& scheduler, const archetype::TiledGBuffer& gbuffer,
                            archetype::VplSet vpls, archetype::Visibility visibility,
                            archetype::Shading shading) {
    return mir::reconstruct(scheduler, gbuffer, vpls, visibility, shading);
}
