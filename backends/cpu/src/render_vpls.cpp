// SPDX-License-Identifier: MIT
#include "host_render.hpp"
#include "mir/runtime/tiled_render.hpp"

namespace mir {

// Of sample_vpls.cpp, render_paths.cpp, vsl_light.cpp and glossy_light.cpp.
extern template SampledVpls sample_vpls(const RenderContext<Lambert, AnyEngine, cpu::HostLoops>&,
                                        const LightTable&, float);
extern template SampledVpls sample_vpls(
    const RenderContext<CookTorrance, AnyEngine, cpu::HostLoops>&, const LightTable&, float);
extern template class ResidualLight<Lambert, AnyEngine, cpu::HostLoops>;
extern template class ResidualLight<CookTorrance, AnyEngine, cpu::HostLoops>;
extern template class MissingLight<Lambert, AnyEngine, cpu::HostLoops>;
extern template class MissingLight<CookTorrance, AnyEngine, cpu::HostLoops>;
extern template Image<Rgb> vsl_light(const BlockedGBuffer<Lambert::Params>&,
                                     const VisibilityMatrix&, VplSpan<Space::host>,
                                     std::span<const float>, VslShading<Lambert>, cpu::HostLoops&);
extern template Image<Rgb> vsl_light(const BlockedGBuffer<CookTorrance::Params>&,
                                     const VisibilityMatrix&, VplSpan<Space::host>,
                                     std::span<const float>, VslShading<CookTorrance>,
                                     cpu::HostLoops&);
extern template Image<Rgb> glossy_light(const BlockedGBuffer<Lambert::Params>&,
                                        const VisibilityMatrix&, VplSpan<Space::host>,
                                        std::span<const VplLobe<Lambert>>, GlossyShading<Lambert>,
                                        cpu::HostLoops&);
extern template Image<Rgb> glossy_light(const BlockedGBuffer<CookTorrance::Params>&,
                                        const VisibilityMatrix&, VplSpan<Space::host>,
                                        std::span<const VplLobe<CookTorrance>>,
                                        GlossyShading<CookTorrance>, cpu::HostLoops&);

namespace cpu {

template <Bsdf B>
RenderResult render_by_vpls(const HostRender& r, const HostEngine& engine) {
    HostLoops loops(r.executor, r.monitor);
    const auto make = [kind = r.scheduler](HostLoops& executor, Monitor* monitor) {
        return AnyScheduler<HostLoops>{kind, executor, monitor};
    };
    return TiledRender<B, HostEngine, HostLoops, decltype(make)>(
               r.scene, r.settings, r.geometry, engine, loops, r.monitor, r.clock, make)
        .run();
}

template RenderResult render_by_vpls<Lambert>(const HostRender&, const HostEngine&);
template RenderResult render_by_vpls<CookTorrance>(const HostRender&, const HostEngine&);

}  // namespace cpu
}  // namespace mir
