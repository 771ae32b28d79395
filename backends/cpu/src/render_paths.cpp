// SPDX-License-Identifier: MIT
#include "host_render.hpp"
#include "mir/runtime/missing_light.hpp"
#include "mir/runtime/path_render.hpp"
#include "mir/runtime/residual_light.hpp"

template class mir::ResidualLight<mir::Lambert, mir::AnyEngine, mir::cpu::HostLoops>;
template class mir::ResidualLight<mir::CookTorrance, mir::AnyEngine, mir::cpu::HostLoops>;
template class mir::MissingLight<mir::Lambert, mir::AnyEngine, mir::cpu::HostLoops>;
template class mir::MissingLight<mir::CookTorrance, mir::AnyEngine, mir::cpu::HostLoops>;

namespace mir::cpu {

template <Bsdf B>
RenderResult render_by_paths(const HostRender& r, const AnyEngine& engine) {
    HostLoops loops(r.executor, r.monitor);
    return PathRender<B, AnyEngine, HostLoops>(r.scene, r.settings, r.geometry, engine, loops,
                                               r.monitor, r.clock)
        .run();
}

template RenderResult render_by_paths<Lambert>(const HostRender&, const AnyEngine&);
template RenderResult render_by_paths<CookTorrance>(const HostRender&, const AnyEngine&);

}  // namespace mir::cpu
