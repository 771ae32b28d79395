// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace mir {

/// FNV-1a, 64 bits, over bytes; it finds what was cut off or overwritten.
class ByteHash {
 public:
    /// Adds bytes of memory; several calls count as one.
    void add(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ bytes[i]) * 0x100000001b3ull;
    }
    /// Of all bytes so far.
    [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace mir
