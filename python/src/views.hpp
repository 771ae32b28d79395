// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <memory>
#include <utility>
#include <vector>

namespace mirpy {

/// An array for NumPy over memory that lies elsewhere.
template <class T>
using NumpyArray = nanobind::ndarray<nanobind::numpy, T>;

/// (height, width) or (height, width, 3) floats of an image, where it lies; `owner` keeps it.
inline NumpyArray<float> view_of(mir::Image<float>& image, nanobind::handle owner) {
    return {image.pixels().data(), {image.height(), image.width()}, owner};
}
/// The same of three floats a pixel.
template <class Pixel>
NumpyArray<float> view_of(mir::Image<Pixel>& image, nanobind::handle owner) {
    static_assert(sizeof(Pixel) == 3 * sizeof(float));
    auto* first = reinterpret_cast<float*>(image.pixels().data());
    return {first, {image.height(), image.width(), 3}, owner};
}

/// An array of `shape` that owns what it shows.
template <class T>
NumpyArray<T> array_from(std::vector<T>&& values, std::initializer_list<std::size_t> shape) {
    auto kept = std::make_unique<std::vector<T>>(std::move(values));
    T* first = kept->data();
    const nanobind::capsule owner(kept.release(), [](void* p) noexcept {
        delete static_cast<std::vector<T>*>(p);  // NOLINT(cppcoreguidelines-owning-memory)
    });
    return {first, shape, owner};
}

/// The same of an image.
template <class Pixel>
NumpyArray<float> array_from(mir::Image<Pixel>&& image) {
    auto kept = std::make_unique<mir::Image<Pixel>>(std::move(image));
    mir::Image<Pixel>& shown = *kept;
    const nanobind::capsule owner(kept.release(), [](void* p) noexcept {
        delete static_cast<mir::Image<Pixel>*>(p);  // NOLINT(cppcoreguidelines-owning-memory)
    });
    return view_of(shown, owner);
}

}  // namespace mirpy
