// SPDX-License-Identifier: MIT
#include "mir/metropolis/primary_sample.hpp"

#include "metropolis/faulty_sample.hpp"
#include "support/catch.hpp"

#include <set>
#include <vector>

using mir::LargeStep;
using mir::PrimarySample;
using mir::Random;
using mir::SmallStep;
using mir::Stream;
using mirtest::Fault;
using mirtest::FaultySample;

namespace {

constexpr std::uint64_t seed = 77;
constexpr std::uint32_t chain = 5;
constexpr std::uint32_t dimensions = 400;

/// The same state the plain way: all coordinates are there and move at every step.
class EagerSample {
 public:
    explicit EagerSample(LargeStep base) { accept_large(base); }

    [[nodiscard]] float at(std::uint32_t d) const { return values_[d]; }
    [[nodiscard]] EagerSample propose_small(std::uint32_t step) const {
        EagerSample moved = *this;
        moved.accept_small(step);
        return moved;
    }
    void accept_small(std::uint32_t step) {
        const Random numbers = mir::step_numbers(seed, chain, step);
        for (std::uint32_t d = 0; d < dimensions; ++d)
            values_[d] = kernel_.perturb(values_[d], numbers.at(mir::step_decisions + d));
    }
    void accept_large(LargeStep large) {
        values_.clear();
        const Random numbers(seed, large.stream, large.index);
        for (std::uint32_t d = 0; d < dimensions; ++d) values_.push_back(numbers.at(d));
    }

 private:
    SmallStep kernel_;
    std::vector<float> values_;
};

/// Runs lazy states of type S next to eager ones through `steps` random steps, looking at a random
/// few coordinates of state and proposal at each, and counts coordinates that differ.
template <class S>
int disagreements(std::uint32_t steps, float large_share, std::uint64_t index) {
    Random random(33, Stream::test, index);
    S lazy(seed, chain, LargeStep{Stream::bootstrap, index});
    EagerSample eager(LargeStep{Stream::bootstrap, index});
    int differences = 0;
    const auto compare = [&](auto&& a, const auto& b) {
        const auto looks = static_cast<int>(4 * random.next());
        const float reach = random.next() * random.next();  // high dimensions are touched late
        for (int i = 0; i < looks; ++i) {
            const auto d = static_cast<std::uint32_t>(random.next() * reach * dimensions);
            if (a.at(d) != b.at(d)) ++differences;
        }
    };
    for (std::uint32_t step = 0; step < steps; ++step) {
        const bool accept = random.next() < 0.6f;
        if (random.next() < large_share) {
            const LargeStep large = mir::large_step(chain, step, step % 3);
            compare(lazy.propose_large(large), Random(seed, large.stream, large.index));
            if (accept) lazy.accept_large(large), eager.accept_large(large);
        } else {
            compare(lazy.propose_small(step), eager.propose_small(step));
            if (accept) lazy.accept_small(step), eager.accept_small(step);
        }
        compare(lazy, eager);
    }
    return differences;
}

template <class S>
int disagreements_of_many_runs() {
    int sum = 0;
    for (std::uint64_t run = 0; run < 20; ++run)
        sum += disagreements<S>(100, run % 2 ? 0.1f : 0.01f, run);
    return sum;
}

}  // namespace

TEST_CASE("lazy coordinates equal eager ones in every bit") {
    CHECK(disagreements_of_many_runs<PrimarySample>() == 0);
}

TEST_CASE("a long history without a large step keeps equal in every bit") {
    CHECK(disagreements<PrimarySample>(5000, 0.0f, 1000) == 0);
}

TEST_CASE("wrong lazy coordinates differ from eager ones") {
    CHECK(disagreements_of_many_runs<FaultySample<Fault::none>>() == 0);
    CHECK(disagreements_of_many_runs<FaultySample<Fault::stale_coordinate>>() > 0);
    CHECK(disagreements_of_many_runs<FaultySample<Fault::no_roll_back>>() > 0);
    CHECK(disagreements_of_many_runs<FaultySample<Fault::large_step_forgets>>() > 0);
    CHECK(disagreements_of_many_runs<FaultySample<Fault::late_is_fresh>>() > 0);
    CHECK(disagreements_of_many_runs<FaultySample<Fault::one_way>>() > 0);
}

TEST_CASE("a state starts as the numbers of its large step") {
    PrimarySample state(seed, chain, {Stream::bootstrap, 12});
    const Random numbers(seed, Stream::bootstrap, 12);
    for (std::uint32_t d : {7u, 0u, 399u, 3u}) CHECK(state.at(d) == numbers.at(d));
    const LargeStep large = mir::large_step(chain, 3, 1);
    CHECK(state.propose_large(large).at(9) == Random(seed, Stream::mutation, large.index).at(9));
}

TEST_CASE("a state is rebuilt from its history alone") {
    PrimarySample state(seed, chain, {Stream::bootstrap, 3}, SmallStep(0.01f, 0.2f));
    state.accept_small(1);
    state.accept_large(mir::large_step(chain, 2));
    static_cast<void>(state.at(4));
    for (std::uint32_t step : {4u, 5u, 9u}) state.accept_small(step);

    PrimarySample again(seed, chain, mir::large_step(chain, 2), SmallStep(0.01f, 0.2f));
    for (std::uint32_t step : {4u, 5u, 9u}) again.accept_small(step);
    for (std::uint32_t d = 0; d < 20; ++d) CHECK(again.at(d) == state.at(d));
}

TEST_CASE("a state that starts anew remembers nothing") {
    PrimarySample state(seed, chain, {Stream::bootstrap, 3}, SmallStep(0.01f, 0.2f));
    static_cast<void>(state.at(7));
    state.accept_small(9);
    state.start(seed + 1, chain, {Stream::bootstrap, 4});
    state.accept_small(2);
    PrimarySample fresh(seed + 1, chain, {Stream::bootstrap, 4});
    fresh.accept_small(2);
    for (std::uint32_t d = 0; d < 20; ++d) CHECK(state.at(d) == fresh.at(d));
}

TEST_CASE("copies of a state go separate ways") {
    PrimarySample a(seed, chain, {Stream::bootstrap, 3});
    PrimarySample b = a;
    const float before = a.at(0);
    b.accept_small(1);
    CHECK(a.at(0) == before);
    CHECK(b.at(0) != before);
}

TEST_CASE("chains, seeds, steps and tries share no numbers") {
    std::set<float> seen;
    std::size_t asked = 0;
    for (std::uint32_t c : {0u, 1u, mir::max_chains - 1})
        for (std::uint32_t step : {0u, 1u, 65'536u, ~0u}) {
            const auto add = [&](const Random& r) { seen.insert(r.at(8) + r.at(9)), ++asked; };
            for (std::uint64_t s : {1u, 2u}) add(mir::step_numbers(s, c, step));
            for (std::uint32_t j : {0u, 1u, mir::max_tries - 1}) {
                const LargeStep large = mir::large_step(c, step, j);
                add(Random(1, large.stream, large.index));
            }
        }
    CHECK(seen.size() == asked);
}

TEST_CASE("what cannot be named is refused") {
    CHECK_THROWS_AS(mir::large_step(mir::max_chains, 0), mir::Error);
    CHECK_THROWS_AS(mir::large_step(0, 0, mir::max_tries), mir::Error);
    CHECK_THROWS_AS(mir::step_numbers(1, mir::max_chains, 0), mir::Error);
    CHECK_THROWS_AS(PrimarySample(1, mir::max_chains, {}), mir::Error);
    PrimarySample state(seed, chain, {});
    state.accept_small(4);
    CHECK_THROWS_AS(state.accept_small(4), mir::Error);
    state.accept_large(mir::large_step(chain, 5));
    state.accept_small(6);
}
