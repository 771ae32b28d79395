// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// Shape of a pixel filter.
enum class FilterKind {
    box,       ///< the mean of a pixel's luxels
    tent,      ///< linear fall-off
    gaussian,  ///< exp(-2 d^2), lowered so that it reaches zero at the half-width
    mitchell,  ///< cubic with B = C = 1/3 (Mitchell and Netravali, SIGGRAPH 1988)
    lanczos    ///< sinc windowed by a wider sinc: the kernel of the paper, made finite
};

/// Separable pixel filter: how much a luxel counts for a pixel. Distances are in pixels. Weights
/// are not scaled to integrate to one, because Film divides by their sum; they may be negative. A
/// small value; free of state. Its weights are defined in mir/film/filter.hpp.
struct Filter {
    FilterKind kind = FilterKind::lanczos;  ///< shape
    float half_width = 3.0f;  ///< pixels; the weight is zero from here on, at least 0.5
    /// Only for lanczos. With half_width == tau the zeros lie on the integers, so that one luxel
    /// per pixel is left alone; a half_width of 4 with tau 3 stretches the zeros to 4/3 of a pixel
    /// and blurs (the pair of pbrt-v2).
    float tau = 3.0f;

    /// Weight along one axis at distance `d` = luxel - pixel centre. Even in `d`. A luxel on the
    /// very border of a box counts half, so that neighbouring boxes share it.
    [[nodiscard]] inline float along(float d) const;

    /// Weight of a luxel at `(dx, dy)` pixels from the centre of the pixel.
    [[nodiscard]] inline float operator()(float dx, float dy) const;

    /// True when kind, half-width and tau are equal.
    friend bool operator==(const Filter&, const Filter&) = default;
};

/// The filter of a kind with its usual half-width. That is 0.5 for box, 1 for tent, 2 for gaussian,
/// 2 for mitchell, 3 with tau 3 for lanczos.
constexpr Filter default_filter(FilterKind kind) {
    switch (kind) {
        case FilterKind::box:
            return {kind, 0.5f};
        case FilterKind::tent:
            return {kind, 1.0f};
        case FilterKind::gaussian:
        case FilterKind::mitchell:
            return {kind, 2.0f};
        case FilterKind::lanczos:
            break;
    }
    return {FilterKind::lanczos, 3.0f, 3.0f};
}

}  // namespace mir
