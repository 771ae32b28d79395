// SPDX-License-Identifier: MIT
#include "mir/validation/visibility.hpp"

#include "conformance/brute_force.hpp"
#include "support/catch.hpp"
#include "validation/finds.hpp"

#include <atomic>
#include <stdexcept>

namespace {

using mir::Vec3;
using mirtest::finds;
using mirtest::finds_only;

/// Right, and the base of those that differ from it in what their name says.
struct Right {
    static constexpr mir::Space space = mir::Space::host;

    mirtest::Referee referee;

    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return referee.segment(a, b).visible(); }
};
struct SeesEverything : Right {
    [[nodiscard]] bool visible(Vec3, Vec3) const { return true; }
};
struct MissesATriangle : Right {
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return referee.segment(a, b, 3).visible(); }
};
struct StopsShort : Right {
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        return referee.segment(a, a + 0.9f * (b - a)).visible();
    }
};
struct GoesTooFar : Right {
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        return referee.segment(a, a + 1.01f * (b - a)).visible();
    }
};
/// Remembers what it was asked, as a cache without a lock would.
struct CountsCalls : Right {
    std::atomic<int>* calls = nullptr;

    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        return Right::visible(a, b) != (++*calls == 6000);
    }
};
/// Fails on threads that are not the one that made it.
struct FailsElsewhere : Right {
    std::thread::id home = std::this_thread::get_id();

    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        if (std::this_thread::get_id() != home) throw std::runtime_error("no buffer");
        return Right::visible(a, b);
    }
};

const mir::validation::World& soup() {
    static const mir::validation::World world = mir::validation::triangle_soup(60, 1);
    return world;
}

}  // namespace

TEST_CASE("check_visibility finds nothing wrong with brute force") {
    const Right right{mirtest::Referee(soup().geometry)};
    CHECK(mir::validation::check_visibility(right, soup().geometry).text().empty());
}

TEST_CASE("check_visibility finds visibility that is wrong") {
    const Right right{mirtest::Referee(soup().geometry)};
    const auto& geometry = soup().geometry;
    using mir::validation::check_lifted_points;
    using mir::validation::check_visibility_by_brute_force;
    using mir::validation::check_visibility_symmetry;
    const char* agrees = "agrees with brute force";
    CHECK(finds(check_visibility_by_brute_force(SeesEverything{right}, geometry), agrees));
    CHECK(finds(check_visibility_by_brute_force(MissesATriangle{right}, geometry), agrees));
    CHECK(finds(check_visibility_symmetry(StopsShort{right}, geometry), "is symmetric"));
    CHECK(check_visibility_symmetry(SeesEverything{right}, geometry).passed());
    CHECK(finds_only(check_lifted_points(GoesTooFar{right}, geometry),
                     "lifted points are not hidden by their own surface"));
}

TEST_CASE("check_visibility finds answers that depend on who else asks") {
    std::atomic<int> calls{0};
    const CountsCalls cache{{mirtest::Referee(soup().geometry)}, &calls};
    CHECK(finds_only(mir::validation::check_concurrent_visibility(cache, soup().geometry),
                     "may be asked from many threads at once"));
}

TEST_CASE("check_visibility finds exceptions of threads") {
    const FailsElsewhere fails{{mirtest::Referee(soup().geometry)}};
    CHECK(finds_only(mir::validation::check_concurrent_visibility(fails, soup().geometry),
                     "may be asked from many threads at once"));
}

TEST_CASE("check_visibility finds that there is nothing to check") {
    const mir::WorldGeometry empty{mir::Scene{}};
    const Right right{mirtest::Referee(empty)};
    const char* triangles = "there are triangles to ask about";
    CHECK(finds_only(mir::validation::check_visibility(right, empty), triangles));
    CHECK(finds_only(mir::validation::check_visibility_by_brute_force(right, empty), triangles));
    CHECK(finds_only(mir::validation::check_visibility_symmetry(right, empty), triangles));
    CHECK(finds_only(mir::validation::check_lifted_points(right, empty), triangles));
    CHECK(finds_only(mir::validation::check_concurrent_visibility(right, empty), triangles));
}

TEST_CASE("check_visibility says when triangles that hide nothing prove nothing") {
    const mir::validation::World speck = mir::validation::triangle_soup(1, 5, 1e-3f);
    const Right right{mirtest::Referee(speck.geometry)};
    const auto segments = mir::validation::random_segments(speck.geometry, 1, 2);
    CHECK(segments.size() == 1);
    CHECK(finds(mir::validation::check_visibility_by_brute_force(right, speck.geometry, 1),
                "the triangles hide something, but not everything"));
}
