// SPDX-License-Identifier: MIT
#include "arrays.hpp"

#include "errors.hpp"

#include <algorithm>
#include <cmath>

namespace nb = nanobind;

namespace mirpy {
namespace {

using AnyArray = nb::ndarray<nb::ro>;
using Code = nb::dlpack::dtype_code;

bool is_kind(const AnyArray& array, Code code) {
    return array.dtype().code == static_cast<std::uint8_t>(code) && array.dtype().lanes == 1;
}

std::string shape_of(const AnyArray& array) {
    std::string text = "(";
    for (std::size_t i = 0; i < array.ndim(); ++i)
        text += (i > 0 ? ", " : "") + std::to_string(array.shape(i));
    return text + (array.ndim() == 1 ? ",)" : ")");
}

/// Lists become arrays of `dtype`, or of their own; what is an array stays where it is.
AnyArray to_array(nb::handle value, const std::string& place, nb::handle dtype) {
    AnyArray array;
    if (nb::try_cast(value, array)) return array;
    const bool is_list = nb::isinstance<nb::sequence>(value) && !nb::isinstance<nb::str>(value);
    if (is_list) {
        nb::object numbers;
        try {
            numbers = nb::module_::import_("numpy").attr("asarray")(value, dtype);
        } catch (const nb::python_error&) {
            throw ArgumentError(place, "it is no regular list of numbers; give an array");
        }
        if (nb::try_cast(numbers, array)) return array;
    }
    throw ArgumentError(place, "it is no array of numbers (" +
                                   std::string(nb::str(value.type()).c_str()) +
                                   "); give what NumPy or DLPack can read");
}

/// An array of the processor with this shape.
AnyArray checked_array(nb::handle value, const std::string& place,
                       std::initializer_list<long> shape, nb::handle dtype = nb::none()) {
    AnyArray array = to_array(value, place, dtype);
    if (array.device_type() != nb::device::cpu::value)
        throw ArgumentError(place,
                            "it lies in the memory of another device (the processor reads it); "
                            "copy it to the processor");
    check_shape(array, place, shape);
    return array;
}

/// An element as a whole number, whatever its type; -1 for those that are none from 0 up.
template <class T>
std::int64_t whole_number(const AnyArray& array, std::int64_t place) {
    T number;
    std::memcpy(&number, static_cast<const T*>(array.data()) + place, sizeof number);
    if constexpr (sizeof(T) == 8)
        if (number > T{0xFFFFFFFFu}) return -1;
    return static_cast<std::int64_t>(number);
}

using ReadWhole = std::int64_t (*)(const AnyArray&, std::int64_t);

ReadWhole reader_of(const AnyArray& array) {
    const bool has_sign = is_kind(array, Code::Int);
    if (!has_sign && !is_kind(array, Code::UInt)) return nullptr;
    switch (array.dtype().bits) {
        case 8:
            return has_sign ? whole_number<std::int8_t> : whole_number<std::uint8_t>;
        case 16:
            return has_sign ? whole_number<std::int16_t> : whole_number<std::uint16_t>;
        case 32:
            return has_sign ? whole_number<std::int32_t> : whole_number<std::uint32_t>;
        case 64:
            return has_sign ? whole_number<std::int64_t> : whole_number<std::uint64_t>;
        default:
            return nullptr;
    }
}

}  // namespace

std::string dtype_text(const AnyArray& array) {
    const auto code = static_cast<Code>(array.dtype().code);
    const char* kind = code == Code::Int       ? "int"
                       : code == Code::UInt    ? "uint"
                       : code == Code::Float   ? "float"
                       : code == Code::Complex ? "complex"
                       : code == Code::Bool    ? "bool"
                                               : "another type of ";
    return code == Code::Bool ? kind : kind + std::to_string(array.dtype().bits);
}

void check_shape(const AnyArray& array, const std::string& place,
                 std::initializer_list<long> shape) {
    bool fits = array.ndim() == shape.size();
    for (std::size_t i = 0; fits && i < shape.size(); ++i) {
        const long wanted = *(shape.begin() + i);
        fits = wanted == any_size || array.shape(i) == static_cast<std::size_t>(wanted);
    }
    if (!fits)
        throw ArgumentError(place,
                            "it has the shape " + shape_of(array) + "; give " + shape_text(shape));
}

std::string shape_text(std::initializer_list<long> shape) {
    constexpr const char* letters[] = {"n", "m", "k"};
    std::string text = "(";
    std::size_t letter = 0;
    for (const long size : shape) {
        text += text.size() > 1 ? ", " : "";
        text += size == any_size ? letters[letter++] : std::to_string(size);
    }
    return text + (shape.size() == 1 ? ",)" : ")");
}

FloatArray::FloatArray(nb::handle value, std::string place, std::initializer_list<long> shape,
                       Numbers numbers)
    : array_(checked_array(value, place, shape, nb::str("float64"))),
      data_(static_cast<const char*>(array_.data())) {
    const std::uint8_t bits = array_.dtype().bits;
    is_double_ = bits == 64;
    const bool is_single = bits == 32;
    const bool may_be_double = numbers == Numbers::floats;
    if (!is_kind(array_, Code::Float) || !(is_single || (is_double_ && may_be_double)))
        throw ArgumentError(place, "its dtype is " + dtype_text(array_) + "; give float32" +
                                       (may_be_double ? " or float64" : ""));
    for (std::size_t i = 0; i < array_.ndim(); ++i) {
        strides_[i] = array_.stride(i);
        sizes_[i] = array_.shape(i);
    }
    check_finite(place);
}

void FloatArray::check_finite(const std::string& place) const {
    for (std::size_t i = 0; i < sizes_[0]; ++i)
        for (std::size_t j = 0; j < sizes_[1]; ++j)
            for (std::size_t k = 0; k < sizes_[2]; ++k) {
                if (std::isfinite(at(i, j, k))) continue;
                const std::size_t index[] = {i, j, k};
                std::string where;
                for (std::size_t axis = 0; axis < array_.ndim(); ++axis)
                    where += (axis > 0 ? ", " : "") + std::to_string(index[axis]);
                throw ArgumentError(place, "element [" + where +
                                               "] is NaN or infinite, or too large for float32; "
                                               "repair it");
            }
}

std::vector<std::uint32_t> index_rows(nb::handle value, const std::string& place,
                                      std::size_t columns, std::size_t limit) {
    const AnyArray array = checked_array(value, place, {any_size, static_cast<long>(columns)});
    const ReadWhole read = reader_of(array);
    if (read == nullptr)
        throw ArgumentError(place,
                            "its dtype is " + dtype_text(array) + "; give whole numbers (uint32)");
    std::vector<std::uint32_t> all;
    all.reserve(array.shape(0) * columns);
    for (std::size_t i = 0; i < array.shape(0); ++i)
        for (std::size_t k = 0; k < columns; ++k) {
            const std::int64_t index =
                read(array, static_cast<std::int64_t>(i) * array.stride(0) +
                                static_cast<std::int64_t>(k) * array.stride(1));
            if (index < 0 || static_cast<std::uint64_t>(index) >= limit)
                throw ArgumentError(place, "element [" + std::to_string(i) + ", " +
                                               std::to_string(k) + "] names none of the " +
                                               std::to_string(limit) +
                                               " that there are; count from 0");
            all.push_back(static_cast<std::uint32_t>(index));
        }
    return all;
}

void check_dense(const AnyArray& array, const std::string& place) {
    std::int64_t step = 1;
    for (std::size_t i = array.ndim(); i-- > 0;) {
        if (array.shape(i) > 1 && array.stride(i) != step)
            throw ArgumentError(place,
                                "its elements do not lie one behind the other (they are read where "
                                "they are); give a contiguous copy");
        step *= static_cast<std::int64_t>(array.shape(i));
    }
}

AnyArray byte_array(nb::handle value, const std::string& place, std::initializer_list<long> shape) {
    AnyArray array = checked_array(value, place, shape);
    if (!is_kind(array, Code::UInt) || array.dtype().bits != 8)
        throw ArgumentError(place, "its dtype is " + dtype_text(array) + "; give uint8");
    check_dense(array, place);
    return array;
}

std::vector<double> numbers_of(nb::handle value, const std::string& place, std::size_t count) {
    const std::string wanted = "give " + std::to_string(count) + " numbers";
    std::vector<double> numbers;
    try {
        for (const nb::handle item : value) {
            const double number = PyFloat_AsDouble(item.ptr());
            if (PyErr_Occurred() != nullptr) nb::raise_python_error();
            numbers.push_back(number);
        }
    } catch (const nb::python_error&) {
        throw ArgumentError(place, "it is no row of numbers; " + wanted);
    }
    const bool is_finite = std::all_of(numbers.begin(), numbers.end(), [](double x) {
        return std::isfinite(static_cast<float>(x));
    });
    if (numbers.size() != count || !is_finite)
        throw ArgumentError(place, "it has " + std::to_string(numbers.size()) +
                                       " numbers, or one that is not finite; " + wanted);
    return numbers;
}

}  // namespace mirpy
