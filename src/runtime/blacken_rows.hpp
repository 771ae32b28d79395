// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"

#include <algorithm>
#include <cstdint>

namespace mir {

/// Makes pixels black that were not asked for, in all images of a result. They hold what luxels of
/// other rows shone there, or nothing.
inline void blacken_other_rows(PixelRows rows, RenderResult& r) {
    if (rows.count == 0) return;
    const auto blacken = [&]<class T>(Image<T>& image) {
        const std::span<T> pixels = image.pixels();
        for (std::uint32_t y = 0; y < image.height(); ++y)
            if (!rows.hold(y))
                std::ranges::fill(pixels.subspan(y * std::size_t{image.width()}, image.width()),
                                  T{});
    };
    for (Image<Rgb>* layer :
         {&r.beauty, &r.emission, &r.direct, &r.indirect, &r.removed, &r.guides.albedo})
        blacken(*layer);
    for (Image<Rgb>& bounce : r.bounces) blacken(bounce);
    for (Image<float>* layer : {&r.pick_error, &r.coverage, &r.guides.depth}) blacken(*layer);
    blacken(r.guides.normal);
    blacken(r.guides.position);
}

}  // namespace mir
