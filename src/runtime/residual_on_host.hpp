// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

#include <span>

namespace mir {

/// RenderFrame::residual() by rays of the host: of luxels whose first row is `first_row` of the
/// whole image.
[[nodiscard]] Image<Rgb> residual_on_host(RenderFrame& frame, const AnyLuxels& luxels,
                                          std::uint32_t first_row, float bound,
                                          std::span<Image<Rgb>* const> bounces);

}  // namespace mir
