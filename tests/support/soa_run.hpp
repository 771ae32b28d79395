// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"

#include <vector>

namespace mirtest {

/// What luxels hold, stored word by word, as kernels read it.
template <class T>
class SoaRun {
 public:
    explicit SoaRun(const std::vector<T>& values)
        : words_(mir::SoaView<T>::words * values.size()),
          stride_(static_cast<std::uint32_t>(values.size())) {
        const mir::SoaView<T> out{words_.data(), stride_};
        for (std::uint32_t i = 0; i < stride_; ++i) out.store(i, values[i]);
    }

    /// Valid while the run exists.
    [[nodiscard]] mir::SoaView<const T> view() const { return {words_.data(), stride_}; }
    [[nodiscard]] std::uint32_t size() const { return stride_; }

 private:
    std::vector<std::uint32_t> words_;
    std::uint32_t stride_;
};

using HitRun = SoaRun<mir::Hit>;

}  // namespace mirtest
