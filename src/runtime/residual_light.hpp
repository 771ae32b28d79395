// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

#include <span>

namespace mir {

/// Adds the light that the bound keeps from luxels, traced back by paths. They leave each luxel as
/// its BSDF says: f cos max(0, 1 - b/G) / p times the light that the point they meet sends back,
/// which is that of a path tracer without bound. `layers` are those of the rows from `first_row`
/// on: it goes to the indirect light and to the bounces where there are any, and is returned, W
/// m^-2 sr^-1. Unbiased; surfaces met reflect with their full BSDF, so what is added is what the
/// bound removed where those are Lambertian, as VPLs are, or where VPLs keep a lobe that was not
/// widened. Source: Kollig and Keller, "Illumination in the presence of weak singularities", MCQMC
/// 2004, with paths instead of the recursion. By rays of the host. Bits depend on seed and luxel
/// alone.
Image<Rgb> add_residual_light(RenderFrame& frame, const AnyLuxels& luxels, std::uint32_t first_row,
                              float bound, std::span<Image<Rgb>* const> layers);

}  // namespace mir
