// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"
#include "mir/core/space.hpp"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace mir {

/// Types that SoaView can cut into 32-bit words.
template <class T>
concept WordCopyable = DeviceCopyable<T> && sizeof(T) % 4 == 0 && alignof(T) <= 4;

/// A T per luxel, stored as one plane per 32-bit word of T. Neighbouring luxels are neighbouring
/// words. Word k of luxel i is planes[k * stride + i]. `SoaView<const T>` only reads. A view: does
/// not own, may be passed to kernels; concurrent stores to different luxels are safe.
template <class T>
    requires WordCopyable<std::remove_const_t<T>>
struct SoaView {
    using Value = std::remove_const_t<T>;  ///< what a luxel holds
    /// Const where the view only reads.
    using Word = std::conditional_t<std::is_const_v<T>, const std::uint32_t, std::uint32_t>;
    static constexpr std::uint32_t words = sizeof(T) / 4;  ///< of a value; the number of planes

    Word* planes = nullptr;    ///< words * stride of them, plane after plane
    std::uint32_t stride = 0;  ///< luxels of a plane, padding included

    /// The value of luxel `i` < stride, put together from its planes.
    [[nodiscard]] MIR_HD Value load(std::uint32_t i) const {
        return load(i, std::make_index_sequence<words>{});
    }

    /// Writes every word of luxel `i` < stride.
    MIR_HD void store(std::uint32_t i, const Value& value) const requires(!std::is_const_v<T>) {
        store(i, value, std::make_index_sequence<words>{});
    }

 private:
    // Word by word through index packs: compilers see plain loads and stores of members, drop the
    // words that nobody reads, and vectorise loops over luxels.
    template <std::size_t... K>
    [[nodiscard]] MIR_HD Value load(std::uint32_t i, std::index_sequence<K...>) const {
        Value value;
        auto* bytes = reinterpret_cast<unsigned char*>(&value);
        (put(bytes + 4 * K, planes[K * stride + i]), ...);
        return value;
    }
    template <std::size_t... K>
    MIR_HD void store(std::uint32_t i, const Value& value, std::index_sequence<K...>) const {
        const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
        ((planes[K * stride + i] = word_at(bytes + 4 * K)), ...);
    }

    // Planes are read and written as words: nvcc makes four accesses of a memcpy from memory that
    // it takes for bytes.
    MIR_HD static void put(unsigned char* bytes, std::uint32_t word) { memcpy(bytes, &word, 4); }
    MIR_HD static std::uint32_t word_at(const unsigned char* bytes) {
        std::uint32_t word = 0;
        memcpy(&word, bytes, 4);
        return word;
    }
};

}  // namespace mir
