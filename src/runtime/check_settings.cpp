// SPDX-License-Identifier: MIT
#include "mir/runtime/check_settings.hpp"

namespace mir {

void RenderSettings::validate() const { check(*this); }

}  // namespace mir
