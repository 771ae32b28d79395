// SPDX-License-Identifier: MIT
#pragma once

#include "mir/metropolis/diagnostics.hpp"
#include "mir/paths/path_generator.hpp"

#include <array>

namespace mir {

/// What a MixingTrace keeps of a state.
struct TraceSample {
    Vec3 place{0};            ///< of x_v, metres
    std::uint32_t edges = 0;  ///< k
    double radiance = 0.0;    ///< Y(R)

    /// What is kept of a path that carries light.
    MIR_HD static TraceSample of(const WeightedPath& state) {
        return {state.path.x(2).position, state.path.edges(), luminance(state.measure.leaving)};
    }
};

/// Which states of a chain a trace keeps: some thousand at most, evenly spaced. A value.
class TraceRhythm {
 public:
    TraceRhythm() = default;
    /// For a chain of `states` states; `seen` of them have passed.
    MIR_HD explicit TraceRhythm(std::uint64_t states, std::uint64_t seen = 0)
        : stride_((states + most - 1) / most), seen_(seen) {}

    /// Counts the next state and says whether it is one.
    MIR_HD bool keeps_next() { return seen_++ % stride_ == 0; }
    /// States between two that are kept.
    [[nodiscard]] MIR_HD std::uint64_t stride() const { return stride_; }
    /// Number of states kept of `states`.
    [[nodiscard]] MIR_HD std::uint64_t kept(std::uint64_t states) const {
        return (states + stride_ - 1) / stride_;
    }

 private:
    static constexpr std::uint64_t most = 4096;
    std::uint64_t stride_ = 1;
    std::uint64_t seen_ = 0;
};

/// Numbers along one chain that judge its mixing. They are x, y and z of x_v, log Y(R) and k.
class MixingTrace {
 public:
    static constexpr std::size_t scalars = 5;  ///< numbers kept of each state

    MixingTrace() = default;
    /// For a chain of `states` states.
    explicit MixingTrace(std::uint64_t states) : rhythm_(states) {}

    /// Takes the next state of the chain.
    void add(const WeightedPath& state) {
        if (rhythm_.keeps_next()) add(TraceSample::of(state));
    }
    /// Takes the next state that a TraceRhythm has chosen.
    void add(const TraceSample& sample) { samples_.push_back(sample); }

    /// States between two that are kept.
    [[nodiscard]] std::uint64_t stride() const { return rhythm_.stride(); }
    /// One number along all states kept. 0 to 2 are x, y and z of x_v, metres; 3 is log Y(R), 4 is
    /// k.
    [[nodiscard]] std::vector<double> values(std::size_t scalar) const {
        std::vector<double> values;
        values.reserve(samples_.size());
        for (const TraceSample& s : samples_) values.push_back(value(s, scalar));
        return values;
    }

 private:
    /// The logarithm is taken here, on the host, whose bits a device might not have.
    static double value(const TraceSample& s, std::size_t scalar) {
        switch (scalar) {
            case 0:
                return static_cast<double>(s.place.x);
            case 1:
                return static_cast<double>(s.place.y);
            case 2:
                return static_cast<double>(s.place.z);
            case 3:
                return std::log(s.radiance);
            default:
                return static_cast<double>(s.edges);
        }
    }

    TraceRhythm rhythm_;
    std::vector<TraceSample> samples_;
};

/// Mixing of several chains, judged by the scalar that mixes worst.
inline Mixing mixing_of(const std::vector<const MixingTrace*>& chains) {
    std::array<Traces, MixingTrace::scalars> traces;
    for (std::size_t i = 0; i < MixingTrace::scalars; ++i)
        for (const MixingTrace* chain : chains) traces[i].push_back(chain->values(i));
    return worst_mixing(traces);
}

}  // namespace mir
