// SPDX-License-Identifier: MIT
#include "mir/sampling/path_numbers.hpp"

#include "support/catch.hpp"
#include "support/statistics.hpp"

namespace {

using mir::PathNumbers;
using mir::Sequence;
using mir::Stream;
using mirtest::Approx;

std::vector<float> take(PathNumbers numbers, int count) {
    std::vector<float> all;
    for (int i = 0; i < count; ++i) all.push_back(numbers.next());
    return all;
}

}  // namespace

TEST_CASE("radical inverses mirror the digits at the point") {
    CHECK(mir::radical_inverse(2, 0) == 0.0f);
    CHECK(mir::radical_inverse(2, 1) == 0.5f);
    CHECK(mir::radical_inverse(2, 2) == 0.25f);
    CHECK(mir::radical_inverse(2, 3) == 0.75f);
    CHECK(mir::radical_inverse(2, 6) == 0.375f);
    CHECK(mir::radical_inverse(3, 5) == Approx(7.0 / 9));  // 12 in base 3
    CHECK(mir::radical_inverse(10, 1234) == Approx(0.4321));
    CHECK(mir::radical_inverse(71, 70) == Approx(70.0 / 71));
    CHECK(mir::radical_inverse(71, 71) == Approx(1.0 / 5041));
}

TEST_CASE("radical inverses never reach 1") {
    for (std::uint32_t base : {2u, 3u, 71u})
        for (std::uint64_t i : {(1ull << 24) - 1, (1ull << 32) - 1, (1ull << 60) - 1, ~0ull})
            CHECK(mir::radical_inverse(base, i) < 1.0f);
}

TEST_CASE("the first base^k radical inverses hit every interval of length base^-k once") {
    for (std::uint32_t base : {2u, 3u, 5u, 7u}) {
        const std::uint32_t count = base * base * base;
        std::vector<int> hits(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            // The small shift keeps values that round down below their interval inside it.
            const double x = static_cast<double>(mir::radical_inverse(base, i)) + 1e-6;
            ++hits[static_cast<std::size_t>(x * count)];
        }
        CHECK(std::all_of(hits.begin(), hits.end(), [](int n) { return n == 1; }));
    }
}

TEST_CASE("numbers are a function of sequence, seed, stream and path") {
    const Sequence sequence = GENERATE(Sequence::random, Sequence::halton);
    const auto of = [&](std::uint64_t seed, Stream stream, std::uint64_t path) {
        return take({sequence, seed, stream, path}, 30);
    };
    const auto first = of(1, Stream::light_path, 5);
    CHECK(first == of(1, Stream::light_path, 5));
    CHECK(first != of(2, Stream::light_path, 5));
    CHECK(first != of(1, Stream::pilot, 5));
    CHECK(first != of(1, Stream::light_path, 6));
    for (float x : first) CHECK((x >= 0.0f && x < 1.0f));
}

TEST_CASE("next_2d takes two numbers in order") {
    PathNumbers a(Sequence::halton, 1, Stream::test, 7);
    PathNumbers b = a;
    const mir::Vec2 pair = a.next_2d();
    CHECK(pair.x == b.next());
    CHECK(pair.y == b.next());
    CHECK(a.next() == b.next());
}

TEST_CASE("Halton numbers of all paths are the sequence moved by one shift per dimension") {
    const auto origin = take({Sequence::halton, 9, Stream::test, 0}, 20);
    const std::uint32_t primes[] = {2, 3, 5, 7, 11};
    for (std::uint64_t path = 1; path < 50; ++path) {
        const auto moved = take({Sequence::halton, 9, Stream::test, path}, 5);
        for (std::size_t d = 0; d < 5; ++d) {
            const float apart =
                mir::radical_inverse(primes[d], path + 1) - mir::radical_inverse(primes[d], 1);
            const float difference = moved[d] - origin[d] - apart;
            CHECK(std::fabs(difference - std::round(difference)) < 1e-6f);
        }
    }
}

TEST_CASE("Halton paths use random numbers past their dimensions") {
    const auto halton = take({Sequence::halton, 9, Stream::test, 3}, 24);
    const auto random = take({Sequence::random, 9, Stream::test, 3}, 24);
    for (std::size_t d = 20; d < 24; ++d) CHECK(halton[d] == random[d]);
    CHECK(halton[19] != random[19]);
}

// H0: numbers of neighbouring dimensions are uniform on the square. Chi-square on 10 x 10 cells
// over paths (random) or seeds (Halton: uniform over seeds for each path), level 1 % over 10, seed
// 151.
TEST_CASE("pairs of dimensions are uniform over paths and over seeds", "[statistical]") {
    const double level = mirtest::sidak(0.01, 10);
    const auto uniform = [](double, double) { return 1.0; };
    for (int first : {0, 4, 18, 19, 30}) {
        mirtest::Histogram over_paths(10, 10);
        mirtest::Histogram over_seeds(10, 10);
        const auto f = static_cast<std::size_t>(first);
        for (std::uint64_t i = 0; i < 5000; ++i) {
            const auto a = take({Sequence::random, 151, Stream::test, i}, first + 2);
            over_paths.add(static_cast<double>(a[f]), static_cast<double>(a[f + 1]));
            const auto b = take({Sequence::halton, 151 + i, Stream::test, 12345}, first + 2);
            over_seeds.add(static_cast<double>(b[f]), static_cast<double>(b[f + 1]));
        }
        CAPTURE(first);
        CHECK(over_paths.against(uniform).p_value > level);
        CHECK(over_seeds.against(uniform).p_value > level);
    }
    // The same path and seed again and again is not uniform.
    mirtest::Histogram stuck(10, 10);
    for (int i = 0; i < 5000; ++i) stuck.add(0.5, 0.5);
    CHECK(stuck.against(uniform).p_value < level);
}

TEST_CASE("Halton points spread more evenly than chance") {
    // 50 points per cell on average: the counts of random points have variance 50.
    std::vector<int> cells(36);
    for (std::uint64_t path = 0; path < 1800; ++path) {
        const auto x = take({Sequence::halton, 3, Stream::test, path}, 2);
        ++cells[static_cast<std::size_t>(static_cast<int>(x[0] * 4) * 9 +
                                         static_cast<int>(x[1] * 9))];
    }
    mirtest::Moments counts;
    for (int n : cells) counts.add(static_cast<double>(n));
    CHECK(counts.mean() == 50.0);
    CHECK(counts.variance() < 12.5);
}
