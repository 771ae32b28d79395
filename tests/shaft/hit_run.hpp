// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/luxel.hpp"
#include "mir/data/soa.hpp"

#include <vector>

namespace mirtest {

/// Luxels stored word by word, as kernels read them.
class HitRun {
 public:
    explicit HitRun(const std::vector<mir::Hit>& hits)
        : words_(mir::SoaView<mir::Hit>::words * hits.size()),
          stride_(static_cast<std::uint32_t>(hits.size())) {
        const mir::SoaView<mir::Hit> out{words_.data(), stride_};
        for (std::uint32_t i = 0; i < stride_; ++i) out.store(i, hits[i]);
    }

    /// Valid while the run exists.
    [[nodiscard]] mir::SoaView<const mir::Hit> view() const { return {words_.data(), stride_}; }
    [[nodiscard]] std::uint32_t size() const { return stride_; }

 private:
    std::vector<std::uint32_t> words_;
    std::uint32_t stride_;
};

}  // namespace mirtest
