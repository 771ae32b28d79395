// SPDX-License-Identifier: MIT
#include "host_render.hpp"
#include "mir/runtime/micro_render.hpp"

namespace mir::cpu {

template <Bsdf B>
RenderResult render_from_discs(const HostRender& r, const AnyEngine& engine) {
    HostLoops loops(r.executor, r.monitor);
    return MicroRender<B, AnyEngine, HostLoops>(r.scene, r.settings, r.geometry, engine, loops,
                                                r.monitor, r.clock)
        .run();
}

template RenderResult render_from_discs<Lambert>(const HostRender&, const AnyEngine&);
template RenderResult render_from_discs<CookTorrance>(const HostRender&, const AnyEngine&);

}  // namespace mir::cpu
