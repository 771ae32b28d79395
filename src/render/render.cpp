// SPDX-License-Identifier: MIT
#include "mir/render.hpp"

#include "mir/runtime/all_renderers.hpp"

namespace mir {

RenderResult render(const Scene& scene, const RenderSettings& settings, Monitor* monitor) {
    Registry registry;
    add_all_to(registry);
    const Registry::Choice choice = registry.make_for(settings);
    RenderResult result = choice.renderer->render(scene, settings, monitor);
    result.warnings.insert(result.warnings.begin(), choice.remarks.begin(), choice.remarks.end());
    return result;
}

}  // namespace mir
