// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/validation/referee.hpp"
#include "mir/validation/report.hpp"
#include "mir/validation/worlds.hpp"

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

namespace mir::validation {

/// Two points that are asked about.
struct Segment {
    Vec3 a{0};  ///< one end, metres; asked first
    Vec3 b{0};  ///< the other end, metres
};

/// Barycentric margin below which single precision may decide either way. In units of 1e-4: four
/// times as many as the scene lies of its own sizes from the origin, at least 1. Triangles that
/// overlap by rounding do so by its unit there.
inline double doubt_of(const WorldGeometry& geometry) {
    const Bounds& box = geometry.bounds();
    const float farthest = larger(max_abs(box.low), max_abs(box.high));
    return std::max(1.0, 4.0 * static_cast<double>(farthest / max_abs(box.high - box.low)));
}

/// That margin.
inline double doubtful_margin(const WorldGeometry& geometry) { return 1e-4 * doubt_of(geometry); }

/// Segments whose ends are uniform in the bounds of the triangles.
inline std::vector<Segment> random_segments(const WorldGeometry& geometry, std::size_t count,
                                            std::uint64_t index) {
    Random random = detail::numbers(index);
    const Vec3 centre = geometry.bounds().centre();
    const Vec3 half = geometry.bounds().high - centre;
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a = centre + half * detail::point_in_cube(random);
        segments.push_back({a, centre + half * detail::point_in_cube(random)});
    }
    return segments;
}

namespace detail {

/// Whether there are triangles; notes it when there are none.
inline bool expect_triangles(const WorldGeometry& geometry, Report& report) {
    const bool some = !geometry.triangles().empty();
    report.expect(some, "there are triangles to ask about", "the geometry has none");
    return some;
}

/// Segments with two different answers.
struct Disagreements {
    double doubt;  ///< doubt_of() the geometry
    std::size_t all = 0;
    std::size_t sure = 0;  ///< of them, those that the referee does not doubt

    void add(const Referee::Verdict& verdict) {
        ++all;
        sure += verdict.doubtful(1e-4 * doubt) ? 0 : 1;
    }

    /// None may be sure, and one in a thousand of all `asked` in doubt. More by the same factor.
    void expect_few(std::size_t asked, const std::string& axiom, const std::string& how,
                    Report& report) const {
        const std::string of = " of " + std::to_string(asked) + " segments are judged " + how;
        report.expect(sure == 0, axiom, std::to_string(sure) + of);
        report.expect(static_cast<double>(all) <= doubt * static_cast<double>(asked) / 1000.0,
                      axiom + " at edges", std::to_string(all) + of);
    }
};

}  // namespace detail

/// Axiom 4 of Visibility: agrees with brute force over the triangles of `geometry`. Wherever the
/// referee is sure the answers are equal; where it is not, at most one segment in a thousand
/// differs, or as many times more as the scene lies from the origin in its own sizes.
template <Visibility V>
Report check_visibility_by_brute_force(const V& visibility, const WorldGeometry& geometry,
                                       std::size_t count = 20000) {
    Report report;
    if (!detail::expect_triangles(geometry, report)) return report;
    const Referee referee(geometry);
    std::size_t open = 0;
    detail::Disagreements wrong{doubt_of(geometry)};
    for (const Segment& s : random_segments(geometry, count, 2)) {
        const Referee::Verdict verdict = referee.segment(s.a, s.b);
        open += verdict.visible() ? 1 : 0;
        if (visibility.visible(s.a, s.b) == verdict.visible()) continue;
        wrong.add(verdict);
    }
    report.expect(open > 0 && open < count, "the triangles hide something, but not everything",
                  std::to_string(open) + " of " + std::to_string(count) + " segments are open");
    wrong.expect_few(count, "agrees with brute force", "in another way", report);
    return report;
}

/// Axiom 1 of Visibility: symmetric. Only segments that graze an edge may differ, at most one in a
/// thousand.
template <Visibility V>
Report check_visibility_symmetry(const V& visibility, const WorldGeometry& geometry,
                                 std::size_t count = 20000) {
    Report report;
    if (!detail::expect_triangles(geometry, report)) return report;
    const Referee referee(geometry);
    detail::Disagreements turned{doubt_of(geometry)};
    for (const Segment& s : random_segments(geometry, count, 4)) {
        if (visibility.visible(s.a, s.b) == visibility.visible(s.b, s.a)) continue;
        turned.add(referee.segment(s.a, s.b));
    }
    turned.expect_few(count, "is symmetric", "otherwise backwards", report);
    return report;
}

/// Axiom 2 of Visibility: points that are lifted are not hidden by
/// their own surface.
template <Visibility V>
Report check_lifted_points(const V& visibility, const WorldGeometry& geometry,
                           std::size_t count = 40000) {
    Report report;
    if (!detail::expect_triangles(geometry, report)) return report;
    const Referee referee(geometry);
    Random random = detail::numbers(6);
    std::size_t asked = 0;
    std::size_t hidden = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const SurfacePoint p = random_surface_point(geometry, random);
        const SurfacePoint q = random_surface_point(geometry, random);
        const Vec3 a = lift(p);
        const Vec3 b = lift(q);
        const bool facing = glm::dot(b - a, p.geometric_normal) > 0.0f &&
                            glm::dot(a - b, q.geometric_normal) > 0.0f;
        if (!facing) continue;
        // Neighbours that come within the lift of a segment may rightly hide it.
        const auto others = referee.segment(a, b, p.triangle, q.triangle);
        if (!others.visible() || others.doubtful(doubtful_margin(geometry))) continue;
        ++asked;
        hidden += visibility.visible(a, b) ? 0 : 1;
    }
    report.expect(asked > count / 40, "points of surfaces see one another",
                  "only " + std::to_string(asked) + " of " + std::to_string(count) + " pairs do");
    report.expect(hidden == 0, "lifted points are not hidden by their own surface",
                  std::to_string(hidden) + " of " + std::to_string(asked) + " are");
    return report;
}

/// Axiom 3 of Visibility: four threads get the answers that one gets. An exception of visible() is
/// a finding on one of the four, and reaches the caller where only one asks.
template <Visibility V>
Report check_concurrent_visibility(const V& visibility, const WorldGeometry& geometry) {
    Report report;
    if (!detail::expect_triangles(geometry, report)) return report;
    const auto segments = random_segments(geometry, 4000, 8);
    const auto ask = [&] {
        std::vector<char> answers;
        for (const Segment& s : segments)
            answers.push_back(visibility.visible(s.a, s.b) ? 'y' : 'n');
        return answers;
    };
    const std::vector<char> alone = ask();
    std::vector<std::vector<char>> together(4);
    std::vector<char> failed(4, 0);
    {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < together.size(); ++i)
            threads.emplace_back([&, i] {
                try {
                    together[i] = ask();
                } catch (...) {
                    failed[i] = 1;
                }
            });
    }
    for (std::size_t i = 0; i < together.size(); ++i)
        report.expect(failed[i] == 0 && together[i] == alone,
                      "may be asked from many threads at once",
                      failed[i] != 0 ? "a thread got an exception" : "a thread got other answers");
    return report;
}

/// All axioms of Visibility, for a model and the triangles it knows. Use those of the program's own
/// scene, or triangle_soup() of several scales and places. Brute force takes time in proportion to
/// the triangles; a few hundred are enough.
template <Visibility V>
Report check_visibility(const V& visibility, const WorldGeometry& geometry) {
    Report report;
    if (!detail::expect_triangles(geometry, report)) return report;
    report.add("segments", check_visibility_by_brute_force(visibility, geometry));
    report.add("segments", check_visibility_symmetry(visibility, geometry));
    report.add("surfaces", check_lifted_points(visibility, geometry));
    report.add("threads", check_concurrent_visibility(visibility, geometry));
    return report;
}

}  // namespace mir::validation
