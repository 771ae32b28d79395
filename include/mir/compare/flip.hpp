// SPDX-License-Identifier: MIT
#pragma once

#include "mir/compare/comparable.hpp"
#include "mir/compare/detail/flip_colour.hpp"
#include "mir/compare/detail/flip_filters.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace mir {

/// Pixels per degree of visual angle of FLIP's usual observer, 67.02. 0.7 m in front of a screen of
/// 0.7 m with 3840 pixels across.
inline constexpr float default_pixels_per_degree = 3840.0f * pi / 180.0f;

namespace detail {

inline Rgb clamped_to_display(Rgb c) {
    return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

/// What FLIP's observer sees of an image.
struct Percept {
    Image<Vec3> colour;  ///< Hunt-adjusted CIELAB of the image as the eye blurs it
    Image<float> edge;   ///< strength of edges
    Image<float> point;  ///< strength of points
};

/// One coordinate of YCxCz of all pixels.
template <Executor E>
Image<float> opponent_plane(const Image<Rgb>& image, int coordinate, E& executor) {
    Image<float> plane(image.extent());
    executor.for_each(image.height(), [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < image.width(); ++x)
            plane(x, y) = ycxcz_of(clamped_to_display(image(x, y)))[coordinate];
    });
    return plane;
}

/// Length of the two derivatives of the achromatic plane.
template <Executor E>
Image<float> feature_strength(const Image<float>& plane, const FilterWeights& derivative,
                              const FilterWeights& smooth, E& executor) {
    Image<float> strength = filtered(plane, derivative, smooth, executor);
    const Image<float> down = filtered(plane, smooth, derivative, executor);
    for (std::size_t i = 0; i < strength.pixels().size(); ++i)
        strength.pixels()[i] = std::hypot(strength.pixels()[i], down.pixels()[i]);
    return strength;
}

/// Colour pipeline up to the colour difference. Blur by contrast sensitivity, back to what a
/// display can show, to a perceptually uniform space.
template <Executor E>
Image<Vec3> seen_colour(const Image<Rgb>& image, const FlipFilters& f, E& executor) {
    const auto blurred = [&](int coordinate, const FilterWeights& w) {
        return filtered(opponent_plane(image, coordinate, executor), w, w, executor);
    };
    const Image<float> y = blurred(0, f.achromatic);
    const Image<float> cx = blurred(1, f.red_green);
    const Image<float> cz[2] = {blurred(2, f.blue_yellow[0]), blurred(2, f.blue_yellow[1])};
    Image<Vec3> colour(image.extent());
    executor.for_each(image.height(), [&](std::size_t row) {
        for (std::size_t i = row * image.width(); i < (row + 1) * image.width(); ++i) {
            const float z = f.blue_yellow_share[0] * cz[0].pixels()[i] +
                            f.blue_yellow_share[1] * cz[1].pixels()[i];
            const Rgb linear = rgb_of_ycxcz({y.pixels()[i], cx.pixels()[i], z});
            colour.pixels()[i] = hunt_lab_of(clamped_to_display(linear));
        }
    });
    return colour;
}

template <Executor E>
Percept percept_of(const Image<Rgb>& image, const FlipFilters& f, E& executor) {
    Image<float> achromatic = opponent_plane(image, 0, executor);
    for (float& y : achromatic.pixels()) y = (y + 16.0f) / 116.0f;
    return {seen_colour(image, f, executor),
            feature_strength(achromatic, f.edge, f.smooth, executor),
            feature_strength(achromatic, f.point, f.smooth, executor)};
}

/// Colour difference mapped to 0..1, more finely where it is small.
inline float colour_error(Vec3 a, Vec3 b) {
    constexpr float exponent = 0.7f;
    constexpr float knee = 0.4f;
    constexpr float knee_error = 0.95f;
    static const float largest =
        std::pow(hyab(hunt_lab_of({0.0f, 1.0f, 0.0f}), hunt_lab_of({0.0f, 0.0f, 1.0f})), exponent);
    const float share = std::pow(hyab(a, b), exponent) / largest;
    return share < knee ? knee_error / knee * share
                        : knee_error + (share - knee) / (1.0f - knee) * (1.0f - knee_error);
}

/// Error of every pixel. The colour error, raised where one image has an edge or point that the
/// other lacks.
template <Executor E>
Image<float> flip_errors(const Percept& a, const Percept& b, E& executor) {
    Image<float> errors(a.edge.extent());
    executor.for_each(errors.height(), [&](std::size_t row) {
        for (std::size_t i = row * errors.width(); i < (row + 1) * errors.width(); ++i) {
            const float feature = std::max(std::fabs(a.edge.pixels()[i] - b.edge.pixels()[i]),
                                           std::fabs(a.point.pixels()[i] - b.point.pixels()[i]));
            const float exponent = 1.0f - std::sqrt(std::min(feature / std::sqrt(2.0f), 1.0f));
            const float colour = colour_error(a.colour.pixels()[i], b.colour.pixels()[i]);
            errors.pixels()[i] = std::min(std::pow(colour, exponent), 1.0f);
        }
    });
    return errors;
}

inline FlipFilters checked_flip_filters(float pixels_per_degree) {
    expects(pixels_per_degree >= 1.0f && pixels_per_degree <= 1000.0f,
            "FLIP was asked for a number of pixels per degree outside of 1 to 1000 (the observer "
            "would see no pixel or nothing but one); use 67");
    return FlipFilters(pixels_per_degree);
}

}  // namespace detail

/// LDR-FLIP: how visible the difference of two pictures is, pixel by pixel. It says how much an
/// observer notices who flips between them on a display, 0 (nothing) to 1. Numbers are linear light
/// of the display, not sRGB codes, and are clamped to 0..1. Symmetric. The result does not depend
/// on the executor.
/// @throws Error(invalid_input) as check_comparable(); Error(invalid_argument) when
///         `pixels_per_degree` is not within 1 to 1000.
/// Source: Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild, "FLIP: A Difference
/// Evaluator for Alternating Images", 2020.
template <class E = InlineExecutor>
    requires(Executor<std::remove_reference_t<E>>)
Image<float> ldr_flip(const Image<Rgb>& image, const Image<Rgb>& reference,
                      float pixels_per_degree = default_pixels_per_degree, E&& executor = {}) {
    check_comparable(image, reference);
    const detail::FlipFilters filters = detail::checked_flip_filters(pixels_per_degree);
    return detail::flip_errors(detail::percept_of(image, filters, executor),
                               detail::percept_of(reference, filters, executor), executor);
}

}  // namespace mir
