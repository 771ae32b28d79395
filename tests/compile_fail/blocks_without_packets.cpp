// expect: mir: sched::CpuBlocks needs a Visibility with visible_packet()
// SPDX-License-Identifier: MIT
#include "mir/concepts/archetypes.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"

namespace archetype = mir::archetype;

#ifdef MIR_COMPILE_FAIL
using Visibility = archetype::Visibility;
#else
using Visibility = archetype::PacketVisibility;
#endif

mir::Image<mir::Rgb> render(const mir::BlockedGBuffer<mir::Lambert::Params>& gbuffer,
                            archetype::VplSet vpls, Visibility visibility) {
    mir::InlineExecutor executor;
    return mir::reconstruct(mir::sched::CpuBlocks{executor}, gbuffer, vpls, visibility,
                            mir::VplShading<mir::Lambert>{});
}
