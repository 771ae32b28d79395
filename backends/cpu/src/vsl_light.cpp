// SPDX-License-Identifier: MIT
#include "mir/vsl_light.hpp"

#include "host_engine.hpp"

namespace mir {

using cpu::HostLoops;
template Image<Rgb> vsl_light(const BlockedGBuffer<Lambert::Params>&, const VisibilityMatrix&,
                              VplSpan<Space::host>, std::span<const float>, VslShading<Lambert>,
                              HostLoops&);
template Image<Rgb> vsl_light(const BlockedGBuffer<CookTorrance::Params>&, const VisibilityMatrix&,
                              VplSpan<Space::host>, std::span<const float>,
                              VslShading<CookTorrance>, HostLoops&);

}  // namespace mir
