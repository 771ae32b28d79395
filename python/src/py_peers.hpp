// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/peers.hpp"

#include <nanobind/nanobind.h>

namespace mirpy {

/// Processes whose messages Python carries: an object with the methods of mir.team.Peers. To be
/// made and destroyed with the GIL held; what is called takes it.
class PyPeers final : public mir::Peers {
 public:
    /// @throws What the object raises; mir::Error for numbers that cannot be.
    explicit PyPeers(nanobind::object carrier);

    [[nodiscard]] std::uint32_t rank() const override { return rank_; }
    [[nodiscard]] std::uint32_t count() const override { return count_; }
    void send(std::uint32_t to, const Bytes& message) override;
    [[nodiscard]] std::optional<Letter> receive() override;

 private:
    nanobind::object carrier_;
    std::uint32_t rank_;
    std::uint32_t count_;
};

}  // namespace mirpy
