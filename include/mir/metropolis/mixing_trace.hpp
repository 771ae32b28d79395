// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/diagnostics.hpp"
#include "mir/paths/path_generator.hpp"

#include <array>

namespace mir {

/// Numbers along one chain that judge its mixing: x, y and z of x_v, log Y(R) and k. At most some
/// thousand states are kept, evenly spaced.
class MixingTrace {
 public:
    static constexpr std::size_t scalars = 5;

    MixingTrace() = default;
    /// For a chain of `states` states.
    explicit MixingTrace(std::uint64_t states) : stride_((states + most - 1) / most) {}

    /// Takes the next state of the chain.
    void add(const WeightedPath& state) {
        if (seen_++ % stride_ != 0) return;
        const Vec3 v = state.path.x(2).position;
        const double radiance = luminance(state.measure.leaving);
        const double values[scalars] = {static_cast<double>(v.x), static_cast<double>(v.y),
                                        static_cast<double>(v.z), std::log(radiance),
                                        static_cast<double>(state.path.edges())};
        for (std::size_t i = 0; i < scalars; ++i) values_[i].push_back(values[i]);
    }

    /// States between two that are kept.
    [[nodiscard]] std::uint64_t stride() const { return stride_; }
    [[nodiscard]] const std::vector<double>& values(std::size_t scalar) const {
        return values_[scalar];
    }

 private:
    static constexpr std::uint64_t most = 4096;
    std::uint64_t stride_ = 1;
    std::uint64_t seen_ = 0;
    std::array<std::vector<double>, scalars> values_;
};

/// Mixing of several chains, judged by the scalar that mixes worst.
inline Mixing mixing_of(const std::vector<const MixingTrace*>& chains) {
    std::array<Traces, MixingTrace::scalars> traces;
    for (std::size_t i = 0; i < MixingTrace::scalars; ++i)
        for (const MixingTrace* chain : chains) traces[i].push_back(chain->values(i));
    return worst_mixing(traces);
}

}  // namespace mir
