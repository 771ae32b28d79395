// SPDX-License-Identifier: MIT
#include "mir/io/visible_effect.hpp"

#include "io/detail/visible_effects.hpp"

#include <algorithm>

namespace mir {

std::string visible_effect(std::string_view feature) {
    for (const auto& list : detail::visible_effect_lists) {
        const auto found = std::find_if(
            list.begin(), list.end(),
            [&](const detail::VisibleEffect& effect) { return effect.is_of(feature); });
        if (found != list.end()) return std::string(found->words);
    }
    return std::string(detail::effect_of_unknown_feature);
}

}  // namespace mir
