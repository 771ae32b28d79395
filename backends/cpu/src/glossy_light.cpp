// SPDX-License-Identifier: MIT
#include "mir/glossy_light.hpp"

#include "host_engine.hpp"

namespace mir {

using cpu::HostLoops;
template Image<Rgb> glossy_light(const BlockedGBuffer<Lambert::Params>&, const VisibilityMatrix&,
                                 VplSpan<Space::host>, std::span<const VplLobe<Lambert>>,
                                 GlossyShading<Lambert>, HostLoops&);
template Image<Rgb> glossy_light(const BlockedGBuffer<CookTorrance::Params>&,
                                 const VisibilityMatrix&, VplSpan<Space::host>,
                                 std::span<const VplLobe<CookTorrance>>,
                                 GlossyShading<CookTorrance>, HostLoops&);

}  // namespace mir
