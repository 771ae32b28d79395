// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/runtime/peers.hpp"

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace mir {

/// Plain values one behind the other, as memory has them.
class PackedBytes {
 public:
    /// Adds a value.
    template <class T>
    requires std::is_trivially_copyable_v<T> PackedBytes& add(const T& value) {
        return append(&value, sizeof value);
    }
    /// Adds many values and how many they are.
    template <class T>
    PackedBytes& add_all(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        add(std::uint64_t{values.size()});
        return append(values.data(), values.size_bytes());
    }
    /// All of them.
    [[nodiscard]] Peers::Bytes take() { return std::move(bytes_); }

 private:
    PackedBytes& append(const void* data, std::size_t size) {
        const auto* first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
        return *this;
    }

    Peers::Bytes bytes_;
};

/// Takes PackedBytes apart, in the order in which they were added.
class BytesReader {
 public:
    /// The bytes must outlive it.
    explicit BytesReader(std::span<const std::byte> bytes) : left_(bytes) {}

    /// The next value.
    /// @throws Error(internal) when there are too few bytes.
    template <class T>
    [[nodiscard]] T get() {
        T value;
        copy(&value, sizeof value);
        return value;
    }
    /// The next values, as many as were added.
    /// @throws Error(internal) when there are too few bytes.
    template <class T>
    [[nodiscard]] std::vector<T> get_all() {
        std::vector<T> values(size_of_next(sizeof(T)));
        copy(values.data(), values.size() * sizeof(T));
        return values;
    }
    /// The same as text.
    [[nodiscard]] std::string text() {
        std::string text(size_of_next(1), '\0');
        copy(text.data(), text.size());
        return text;
    }
    /// Bytes of the next values, which stay where they are.
    [[nodiscard]] std::span<const std::byte> next_bytes() { return taken(size_of_next(1)); }

 private:
    [[nodiscard]] std::size_t size_of_next(std::size_t each) {
        const auto size = get<std::uint64_t>();
        require(size <= left_.size() / each);
        return static_cast<std::size_t>(size);
    }
    [[nodiscard]] std::span<const std::byte> taken(std::size_t size) {
        require(size <= left_.size());
        const std::span<const std::byte> bytes = left_.first(size);
        left_ = left_.subspan(size);
        return bytes;
    }
    void copy(void* to, std::size_t size) {
        const std::span<const std::byte> from = taken(size);
        if (size > 0) std::memcpy(to, from.data(), size);
    }
    static void require(bool enough) {
        if (!enough)
            throw Error(ErrorCode::internal,
                        "a message of another process is shorter than it says (it may be another "
                        "version); start the same program everywhere");
    }

    std::span<const std::byte> left_;
};

}  // namespace mir
