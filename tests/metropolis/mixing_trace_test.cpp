// SPDX-License-Identifier: MIT
#include "mir/metropolis/mixing_trace.hpp"

#include "support/catch.hpp"

#include <cmath>

namespace {

using mir::mixing_of;
using mir::MixingTrace;
using mirtest::Approx;

/// A path of `edges` edges whose x2 lies at `v` and sends out `radiance`.
mir::WeightedPath state(mir::Vec3 v, double radiance, std::uint32_t edges) {
    mir::WeightedPath p;
    p.path.vertices.resize(edges);
    p.path.x(2).position = v;
    p.measure.leaving = {radiance, radiance, radiance};
    return p;
}

MixingTrace trace_of(std::uint64_t states, float offset) {
    MixingTrace trace(states);
    for (std::uint64_t i = 0; i < states; ++i) {
        const auto x = static_cast<float>((i * 7) % 16);
        trace.add(state({x + offset, x, -x}, 1.0 + static_cast<double>(x),
                        3 + static_cast<std::uint32_t>(i % 4)));
    }
    return trace;
}

}  // namespace

TEST_CASE("a trace holds x, y and z of x2, log of its luminance and the length") {
    MixingTrace trace(2);
    trace.add(state({1, 2, 3}, std::exp(2.0), 5));
    trace.add(state({4, 5, 6}, std::exp(-700.0), 3));
    CHECK(trace.values(0) == std::vector<double>{1, 4});
    CHECK(trace.values(1) == std::vector<double>{2, 5});
    CHECK(trace.values(2) == std::vector<double>{3, 6});
    CHECK(trace.values(3)[0] == Approx(2.0));
    CHECK(trace.values(3)[1] == Approx(-700.0));
    CHECK(trace.values(4) == std::vector<double>{5, 3});
}

TEST_CASE("a long chain is thinned evenly to some thousand states") {
    constexpr std::uint64_t states = 100'000;
    MixingTrace trace(states);
    for (std::uint64_t i = 0; i < states; ++i)
        trace.add(state({static_cast<float>(i), 0, 0}, 1.0, 3));
    const auto& x = trace.values(0);
    REQUIRE(x.size() > 3000);
    CHECK(x.size() <= 4096);
    for (std::size_t i = 0; i < x.size(); ++i)
        REQUIRE(x[i] == static_cast<double>(i * trace.stride()));
    CHECK(MixingTrace(4096).stride() == 1);
    CHECK(MixingTrace(4097).stride() == 2);
}

TEST_CASE("mixing is that of the scalar that mixes worst") {
    const MixingTrace a = trace_of(400, 0.0f);
    const MixingTrace b = trace_of(400, 0.0f);
    const MixingTrace far = trace_of(400, 100.0f);
    const mir::Mixing good = mixing_of({&a, &b});
    const mir::Mixing bad = mixing_of({&a, &far});
    CHECK(good.split_r_hat < 1.05);
    CHECK(bad.split_r_hat > 2.0);
    CHECK(bad.effective_sample_size < good.effective_sample_size);
}

TEST_CASE("traces without states are defined") {
    const MixingTrace none;
    CHECK(mixing_of({&none, &none}).effective_sample_size == 0.0);
    CHECK(mixing_of({}).effective_sample_size == 0.0);
}
