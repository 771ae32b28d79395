// SPDX-License-Identifier: MIT
#pragma once

#include "strided_floats.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <vector>

namespace mirpy {

/// Of a shape: a size that may be anything.
inline constexpr long any_size = -1;

/// Which numbers an array may hold.
enum class Numbers {
    floats,        ///< float32, or float64, which is rounded as it is read
    single_floats  ///< float32 alone, so that nothing is converted
};

/// An array of real numbers, read where its owner keeps it, whatever its strides. To be made and to
/// end with the GIL held; at() needs none.
class FloatArray {
 public:
    /// Of what holds an array of any library, or is a list of numbers.
    /// @throws ArgumentError that calls it `place`, unless it lies in the memory of the processor
    ///         and has such numbers, all of them finite, and this shape.
    FloatArray(nanobind::handle value, std::string place, std::initializer_list<long> shape,
               Numbers numbers = Numbers::floats);

    /// Of one axis.
    [[nodiscard]] std::size_t size(std::size_t axis) const { return array_.shape(axis); }
    /// For kernels, of single floats alone.
    [[nodiscard]] StridedFloats view() const {
        return {reinterpret_cast<const float*>(data_), {strides_[0], strides_[1], strides_[2]}};
    }
    /// An element: not checked.
    [[nodiscard]] float at(std::size_t i, std::size_t j = 0, std::size_t k = 0) const {
        const std::int64_t place = static_cast<std::int64_t>(i) * strides_[0] +
                                   static_cast<std::int64_t>(j) * strides_[1] +
                                   static_cast<std::int64_t>(k) * strides_[2];
        if (is_double_) return static_cast<float>(read<double>(place));
        return read<float>(place);
    }

 private:
    template <class T>
    [[nodiscard]] T read(std::int64_t place) const {
        T number;
        std::memcpy(&number, data_ + place * static_cast<std::int64_t>(sizeof(T)), sizeof number);
        return number;
    }
    void check_finite(const std::string& place) const;

    nanobind::ndarray<nanobind::ro> array_;
    const char* data_ = nullptr;
    std::array<std::int64_t, 3> strides_{};
    std::array<std::size_t, 3> sizes_{1, 1, 1};
    bool is_double_ = false;
};

/// Checks the sizes of an array.
/// @throws ArgumentError that calls it `place`, unless it has this shape.
void check_shape(const nanobind::ndarray<nanobind::ro>& array, const std::string& place,
                 std::initializer_list<long> shape);

/// Checks that elements lie one behind the other, rows first.
/// @throws ArgumentError that calls the array `place`, unless they do.
void check_dense(const nanobind::ndarray<nanobind::ro>& array, const std::string& place);

/// "float32": what an array holds.
std::string dtype_text(const nanobind::ndarray<nanobind::ro>& array);

/// Whole numbers of rows of `columns`, each from 0 to below `limit`.
/// @throws ArgumentError that calls it `place`, for anything else.
std::vector<std::uint32_t> index_rows(nanobind::handle value, const std::string& place,
                                      std::size_t columns, std::size_t limit);

/// An array of bytes one behind the other, where its owner keeps it.
/// @throws ArgumentError that calls it `place`, unless it has this shape.
nanobind::ndarray<nanobind::ro> byte_array(nanobind::handle value, const std::string& place,
                                           std::initializer_list<long> shape);

/// "(3, 4)", or "(n, 4)" where a size may be anything.
std::string shape_text(std::initializer_list<long> shape);

/// Some numbers, finite ones.
/// @throws ArgumentError that calls them `place`.
std::vector<double> numbers_of(nanobind::handle value, const std::string& place, std::size_t count);

}  // namespace mirpy
