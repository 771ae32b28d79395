// SPDX-License-Identifier: MIT
// What a MetropolisSampler does not accept.
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/path_lab.hpp"

#include <cmath>
#include <string>

namespace {

using mir::Lambert;
using mir::MetropolisOptions;
using mir::MetropolisSampler;
using mirtest::PathLab;

/// The sentence with which options are refused; empty when they are not.
template <class Change>
std::string refusal(const Change& change) {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    MetropolisOptions o;
    change(o);
    try {
        const MetropolisSampler sampler(lab.world(), o);
    } catch (const mir::Error& e) {
        return e.what();
    }
    return {};
}

}  // namespace

TEST_CASE("bad options are refused with a sentence that names them") {
    using Catch::Matchers::Contains;
    using O = MetropolisOptions;
    CHECK_THAT(refusal([](O& o) { o.states = 0; }), Contains("states"));
    CHECK_THAT(refusal([](O& o) { o.chains = 0; }), Contains("chains"));
    CHECK_THAT(refusal([](O& o) { o.chains = 4194305; }), Contains("4194304"));
    CHECK_THAT(refusal([](O& o) { o.stride = 0; }), Contains("stride"));
    CHECK_THAT(refusal([](O& o) { o.suffix_refresh = 256; }), Contains("suffix"));
    CHECK_THAT(refusal([](O& o) { o.chain.tries = 0; }), Contains("tries"));
    CHECK_THAT(refusal([](O& o) { o.chain.tries = 255; }), Contains("tries"));
    CHECK_THAT(refusal([](O& o) { o.chain.large_step_probability = 0; }), Contains("large step"));
    CHECK_THAT(refusal([](O& o) { o.chain.large_step_probability = 1.1; }), Contains("large step"));
    CHECK_THAT(refusal([](O& o) { o.bootstrap.relative_error = -1; }), Contains("relative error"));
    CHECK_THAT(refusal([](O& o) { o.bootstrap.relative_error = std::nan(""); }),
               Contains("relative error"));
    CHECK_THAT(refusal([](O& o) { o.bootstrap.min_paths = 0; }), Contains("bootstrap"));
    CHECK_THAT(refusal([](O& o) { o.bootstrap.max_paths = 10; }), Contains("bootstrap"));
    CHECK_THAT(refusal([](O& o) { o.max_bounce = 0; }), Contains("64 edges"));
    CHECK_THAT(refusal([](O& o) { o.max_bounce = 64; }), Contains("64 edges"));
    // By the fewest chains that there may be, not by those that are wanted.
    const auto long_chains = [](O& o) {
        o.states = 4'000'000;
        o.stride = 1u << 20;
        o.chains = 4096;
    };
    CHECK_THAT(refusal(long_chains), Contains("2^32 mutations"));
    CHECK(refusal([](O& o) { o.max_bounce = 63; }).empty());
    CHECK(refusal([](O& o) { o.chain.tries = 254; }).empty());
}

TEST_CASE("more states than VPLs are allowed are refused") {
    const PathLab<Lambert> lab(mir::builtin::make("furnace"));
    MetropolisOptions o;
    o.states = 64;
    mir::Limits limits;
    limits.vpls = 63;
    using World = PathLab<Lambert>::World;
    CHECK_THROWS_AS(MetropolisSampler<World>(lab.world(), o, limits), mir::Error);
    limits.vpls = 64;
    CHECK_NOTHROW(MetropolisSampler<World>(lab.world(), o, limits));
}
