// expect: mir: this Visibility cannot be traced by the scheduler's backend
// SPDX-License-Identifier: MIT
#include "mir/concepts/archetypes.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/host/backend.hpp"
#include "mir/sched/reconstruct.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"

// The visibility lives in a device's memory, the backend is the host.
#ifdef MIR_COMPILE_FAIL
using Wrong = mir::archetype::DeviceVisibility;
#else
using Wrong = mir::archetype::Visibility;
#endif

mir::Image<mir::Rgb> draw() {
    using mir::archetype::make;
    mir::InlineExecutor executor;
    const mir::BlockedGBuffer<mir::Lambert::Params> gbuffer({16, 16}, {16, 16});
    return mir::reconstruct(mir::sched::Reconstruct{mir::host::Backend(executor)}, gbuffer,
                            mir::VplSpan<mir::Space::host>{}, Wrong{make},
                            mir::VplShading<mir::Lambert>{});
}
