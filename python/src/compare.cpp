// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "errors.hpp"
#include "mir/compare/hdr_flip.hpp"
#include "mir/compare/metrics.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "parts.hpp"
#include "views.hpp"
#include "watch.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/unique_ptr.h>

#include <array>
#include <memory>

namespace nb = nanobind;

namespace mirpy {
namespace {

/// How a picture differs from its reference.
struct PyComparison {
    mir::ImageMetrics metrics;
    mir::Image<float> flip_map;
    double flip = 0.0;
};

mir::Image<mir::Rgb> image_of(nb::handle value, const char* place) {
    const FloatArray pixels(value, place, {any_size, any_size, 3});
    auto image = mir::Image<mir::Rgb>::unwritten(
        {static_cast<std::uint32_t>(pixels.size(1)), static_cast<std::uint32_t>(pixels.size(0))});
    for (std::uint32_t y = 0; y < image.height(); ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x)
            image(x, y) = {pixels.at(y, x, 0), pixels.at(y, x, 1), pixels.at(y, x, 2)};
    return image;
}

std::unique_ptr<PyComparison> compare(nb::handle image, nb::handle reference, double epsilon,
                                      float pixels_per_degree) {
    const mir::Image<mir::Rgb> a = image_of(image, "image");
    const mir::Image<mir::Rgb> b = image_of(reference, "reference");
    auto found = std::make_unique<PyComparison>();
    mir::Monitor monitor;
    watched(monitor, nb::none(), [&] {
        found->metrics = mir::compare_images(a, b, epsilon);
        mir::TbbExecutor threads;
        mir::CancellableExecutor executor(threads, &monitor);
        found->flip_map = mir::hdr_flip(a, b, pixels_per_degree, executor);
        found->flip = mir::mean_of(found->flip_map);
    });
    return found;
}

}  // namespace

void bind_compare(nb::module_& m) {
    using C = PyComparison;
    nb::class_<C>(m, "Comparison", "How a picture differs from its reference.")
        .def_prop_ro(
            "rmse", [](const C& c) { return c.metrics.rmse(); },
            "Root of the mean squared error, in the unit of the pictures.")
        .def_prop_ro(
            "rel_mse", [](const C& c) { return c.metrics.rel_mse; },
            "Mean of (a - b)^2 / (b^2 + epsilon); b is the reference.")
        .def_prop_ro(
            "mae", [](const C& c) { return c.metrics.mae; }, "Mean of |a - b|.")
        .def_prop_ro(
            "mean", [](const C& c) { return c.metrics.mean; }, "Of each channel of the picture.")
        .def_prop_ro(
            "reference_mean", [](const C& c) { return c.metrics.reference_mean; },
            "Of each channel of the reference.")
        .def_prop_ro(
            "mean_difference", [](const C& c) { return c.metrics.mean_difference(); },
            "Relative difference of the means, of the channel where it is largest.")
        .def_ro("flip", &C::flip, "Mean of flip_map, 0..1.")
        .def_prop_ro(
            "flip_map", [](nb::handle self) { return view_of(nb::cast<C&>(self).flip_map, self); },
            "(h, w): HDR-FLIP of each pixel, 0..1.");
    m.def("_compare", compare, nb::arg("image").none(), nb::arg("reference").none(),
          nb::arg("epsilon"), nb::arg("pixels_per_degree"));
    m.attr("default_epsilon") = mir::default_rel_mse_epsilon;
    m.attr("default_pixels_per_degree") = mir::default_pixels_per_degree;
}

}  // namespace mirpy
