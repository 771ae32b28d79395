// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace mir {

/// What one sees of a feature that is not read.
/// @param feature a key of SceneReport::ignored
/// @return the rest of a sentence, such as "glass is opaque, painted in its base colour". Names of
///         features that this version does not know have a general one.
std::string visible_effect(std::string_view feature);

}  // namespace mir
