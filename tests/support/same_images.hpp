// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"

#include <cstring>

namespace mirtest {

/// True when two images are equal in every bit.
template <class T>
bool same_bits(const mir::Image<T>& a, const mir::Image<T>& b) {
    return a.extent() == b.extent() &&
           (a.pixels().empty() ||
            std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0);
}

}  // namespace mirtest
