// SPDX-License-Identifier: MIT
#include "mir/normalise/normalise.hpp"

#include "mir/reshade.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "normalise/lit_box.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"

#include <limits>

// Whatever radiance a sampler records at whatever points, normalised VPLs bring equal luminance to
// the image, one share per recorded state, and P_c in all.

namespace {

using mir::ImageResponse;
using mir::NormalisationReport;
using mir::PathVpl;
using mir::Rgb;
using mirtest::Approx;
using Responses = std::vector<ImageResponse>;

constexpr mir::Extent image_size{60, 40};
constexpr double path_luminance = mirtest::RandomRecords::path_luminance;

template <mir::Bsdf B>
class Normalised {
 public:
    Normalised() = default;

    [[nodiscard]] const mirtest::LitBox<B>& box() const { return box_; }
    [[nodiscard]] double states() const { return box_.records.states; }

    /// Responses where `matrix` says who sees whom.
    [[nodiscard]] Responses responses(const mir::VisibilityMatrix& matrix) const {
        mir::InlineExecutor executor;
        return response(box_.gbuffer, box_.vpls.span(), matrix, shading_, executor);
    }
    [[nodiscard]] Responses responses() const { return responses(box_.matrix); }

    [[nodiscard]] double mean_luminance(const std::vector<mir::Vpl>& vpls) const {
        mir::InlineExecutor executor;
        const auto image = reshade(mir::sched::CpuBlocks{executor}, box_.gbuffer,
                                   mir::span_of(vpls), box_.matrix, shading_);
        double sum = 0.0;
        for (const Rgb& c : image.pixels()) sum += static_cast<double>(luminance(c));
        return sum / static_cast<double>(image_size.area());
    }

 private:
    mirtest::LitBox<B> box_{image_size};
    mir::VplShading<B> shading_{3.0f};
};

/// What must be true of normalised VPLs.
struct Verdict {
    double energy_error = 0.0;    ///< relative, of the image's mean luminance
    double flux_variation = 0.0;  ///< coefficient of variation of flux per recorded state

    [[nodiscard]] bool good() const { return energy_error < 1e-5 && flux_variation < 1e-4; }
};

/// Looks at images alone: one of all VPLs and one of each path VPL.
template <mir::Bsdf B>
Verdict judge(const Normalised<B>& n, const mir::VplList& list, double dropped_share) {
    const std::vector<mir::Vpl> all(list.vpls().begin(), list.vpls().end());
    const double expected = path_luminance * (1.0 - dropped_share);
    Verdict v;
    v.energy_error = std::abs(n.mean_luminance(all) / expected - 1.0);
    mirtest::Moments flux;
    for (const PathVpl& p : list.path_vpls()) {
        if (is_black(p.intensity)) continue;
        std::vector<mir::Vpl> one = all;
        for (mir::Vpl& vpl : one) vpl.intensity = {};
        one[p.vpl].intensity = p.intensity;
        flux.add(n.mean_luminance(one) / static_cast<double>(p.weight));
    }
    v.flux_variation = std::sqrt(flux.variance()) / flux.mean();
    return v;
}

/// Verdict on intensities that come from a rule J = rule(path VPL).
template <class Rule>
Verdict judge_rule(const Normalised<mir::Lambert>& n, double dropped_share, const Rule& rule) {
    mir::VplList list = n.box().vpls;
    std::vector<Rgb> intensities;
    for (const PathVpl& p : list.path_vpls()) intensities.push_back(rule(p));
    list.relight(intensities);
    return judge(n, list, dropped_share);
}

/// Verdict on wrong responses, normalised as they should be.
Verdict judge_responses(const Normalised<mir::Lambert>& n, const Responses& responses) {
    mir::VplList list = n.box().vpls;
    const NormalisationReport report = normalise(list, responses, path_luminance, n.states());
    return judge(n, list, report.dropped_share);
}

/// A list of one VPL of radiance `r`.
mir::VplList single(Rgb r, float weight = 1.0f) {
    mir::VplList list;
    list.push_back({{0, 0, 0}, {0, 0, 1}, r}, {}, 2, 0, weight);
    return list;
}

}  // namespace

TEMPLATE_TEST_CASE("Mean luminance is P_c less what was dropped, and every state brings P_c / n",
                   "", mir::Lambert, mir::CookTorrance) {
    const Normalised<TestType> n;
    mir::VplList list = n.box().vpls;
    const NormalisationReport report = normalise(list, n.responses(), path_luminance, n.states());
    // Some points of the box are seen by no luxel.
    CHECK(report.dropped_share > 0.0);
    CHECK(report.dropped_share < 0.5);
    const Verdict verdict = judge(n, list, report.dropped_share);
    CAPTURE(verdict.energy_error, verdict.flux_variation);
    CHECK(verdict.good());
}

TEST_CASE("Bounces and light groups keep the shares of their paths") {
    const Normalised<mir::Lambert> n;
    mir::VplList list = n.box().vpls;
    const NormalisationReport report = normalise(list, n.responses(), path_luminance, n.states());
    double bounces = 0.0;
    double groups = 0.0;
    for (std::uint8_t b = 2; b <= list.max_bounce(); ++b) {
        double states = 0.0;
        for (const PathVpl& p : list.path_vpls())
            if (p.bounce == b && !is_black(p.intensity)) states += static_cast<double>(p.weight);
        const double found = n.mean_luminance(list.bounce(b));
        CHECK(found == Approx(path_luminance * states / n.states()).epsilon(1e-5));
        bounces += found;
    }
    for (std::uint16_t group : {std::uint16_t{0}, std::uint16_t{1}})
        groups += n.mean_luminance(list.light_group(group));
    const double wanted = path_luminance * (1.0 - report.dropped_share);
    CHECK(bounces == Approx(wanted).epsilon(1e-5));
    CHECK(groups == Approx(wanted).epsilon(1e-5));
}

TEST_CASE("Wrong normalisations are rejected") {
    const Normalised<mir::Lambert> n;
    const Responses right = n.responses();
    mir::VplList list = n.box().vpls;
    const double dropped = normalise(list, right, path_luminance, n.states()).dropped_share;
    REQUIRE(judge(n, list, dropped).good());
    const auto share = [&](const PathVpl& p, double s) {
        return mir::detail::scaled(
            p.intensity, path_luminance * static_cast<double>(p.weight) / (n.states() * s));
    };

    SECTION("equal emitted power, even with the right mean") {
        const auto power = [&](const PathVpl& p) {
            return share(p, static_cast<double>(luminance(p.intensity)));
        };
        std::vector<Rgb> intensities;
        for (const PathVpl& p : n.box().vpls.path_vpls()) intensities.push_back(power(p));
        list.relight(intensities);
        const double mean = n.mean_luminance({list.vpls().begin(), list.vpls().end()});
        const double factor = path_luminance * (1.0 - dropped) / mean;
        const Verdict verdict = judge_rule(
            n, dropped, [&](const PathVpl& p) { return mir::detail::scaled(power(p), factor); });
        CHECK(verdict.energy_error < 1e-5);
        CHECK_FALSE(verdict.good());
    }
    SECTION("unshadowed responses") {
        const auto open = n.box().visibility(n.box().gbuffer, mirtest::FreeSight{});
        CHECK_FALSE(judge_responses(n, n.responses(open)).good());
    }
    SECTION("one luxel of twice its weight") {
        // A lit luxel of the first tile, by its bits alone.
        mir::VisibilityMatrix one(n.box().gbuffer.tiles(), n.box().vpls.size());
        const auto bits = n.box().matrix.view();
        for (mir::VplIndex j = 0; j < n.box().vpls.size(); ++j)
            one.store(1, 4, j, bits.mask(1, 4, j) & 1u);
        Responses wrong = n.responses(one);
        for (std::size_t j = 0; j < wrong.size(); ++j) wrong[j] += right[j];
        const Verdict verdict = judge_responses(n, wrong);
        CAPTURE(verdict.energy_error, verdict.flux_variation);
        CHECK_FALSE(verdict.good());
    }
    SECTION("one S for all path VPLs of a geometric VPL") {
        std::vector<Rgb> radiance(n.box().vpls.size());
        std::vector<double> weight(radiance.size());
        for (const PathVpl& p : n.box().vpls.path_vpls()) {
            radiance[p.vpl] += p.intensity * p.weight;
            weight[p.vpl] += static_cast<double>(p.weight);
        }
        const Verdict verdict = judge_rule(n, dropped, [&](const PathVpl& p) {
            const double s = image_luminance(right[p.vpl], radiance[p.vpl]) / weight[p.vpl];
            return s > 0.0 ? share(p, s) : Rgb{};
        });
        CHECK(verdict.energy_error < 1e-5);
        CHECK_FALSE(verdict.good());
    }
    SECTION("a mean over luxels that see something") {
        std::uint64_t seeing = 0;
        for (mir::TileIndex t = 0; t < n.box().gbuffer.tiles().size(); ++t)
            for (mir::LuxelIndex i = 0; i < n.box().gbuffer.view(t).size(); ++i)
                seeing += is_empty(n.box().gbuffer.view(t).hit(i)) ? 0 : 1;
        REQUIRE(seeing < image_size.area());
        const double factor = static_cast<double>(image_size.area()) / static_cast<double>(seeing);
        Responses wrong = right;
        for (ImageResponse& t : wrong) t = {t.r * factor, t.g * factor, t.b * factor, t.lit_luxels};
        CHECK_FALSE(judge_responses(n, wrong).good());
    }
    SECTION("a multiplicity that is forgotten") {
        CHECK_FALSE(judge_rule(n, dropped, [&](const PathVpl& p) {
                        const double s = image_luminance(right[p.vpl], p.intensity);
                        PathVpl once = p;
                        once.weight = 1.0f;
                        return s > 0.0 ? share(once, s) : Rgb{};
                    }).good());
    }
}

TEST_CASE("Records that light nothing are dropped with their weight, and others keep theirs") {
    mir::VplList list;
    list.append({{0, 0, 0}, {0, 0, 1}, {1, 1, 1}}, {mir::VplKind::reflective, 1}, 2, 0, 3.0f);
    list.append({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}, {mir::VplKind::reflective, 2}, 2, 0, 2.0f);
    list.append({{0, 0, 0}, {0, 0, 1}, {0, 1, 0}}, {mir::VplKind::reflective, 2}, 3, 0, 5.0f);
    // The second point lights nothing red.
    const Responses responses{{0, 0, 0, 0}, {0, 0.25, 0.25, 7}};
    const NormalisationReport report = normalise(list, responses, 4.0, 10.0);
    CHECK(report.dropped_records == 2);
    CHECK(report.dropped_share == Approx(0.5));
    CHECK(is_black(list.vpls()[0].intensity));
    REQUIRE(list.size() == 2);
    const Rgb j = list.vpls()[1].intensity;
    CHECK(j.r == 0.0f);
    CHECK(j.g == Approx(4.0 / 10.0 * 5.0 / (0.7152 * 0.25)));
    CHECK(is_black(list.path_vpls()[1].intensity));
}

TEST_CASE("Nothing that comes in makes NaN or infinity come out") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const Responses usual{{0.1, 0.1, 0.1, 9}};
    for (const Rgb r : {Rgb{}, Rgb{nan, 1, 1}, Rgb{infinity, 1, 1}}) {
        mir::VplList list = single(r);
        CHECK(normalise(list, usual, 1.0, 1.0).dropped_share == 1.0);
        CHECK(is_black(list.vpls()[0].intensity));
    }
    mir::VplList faint = single({1e-38f, 0, 0});
    CHECK(normalise(faint, usual, 1.0, 1.0).dropped_records == 0);
    CHECK(faint.vpls()[0].intensity.r == Approx(1.0 / 0.02126));
    mir::VplList hardly_lit = single({1, 1, 1});
    CHECK(normalise(hardly_lit, Responses{{1e-300, 0, 0, 1}}, 1.0, 1.0).dropped_records == 1);
    mir::VplList none;
    CHECK(normalise(none, {}, 0.0, 0.0).dropped_share == 0.0);
    mir::VplList stateless = single({1, 1, 1});
    CHECK(std::isfinite(normalise(stateless, usual, 1.0, 0.0).dropped_share));
    CHECK(is_black(stateless.vpls()[0].intensity));
}

TEST_CASE("Responses of other VPLs are refused") {
    mir::VplList list = single({1, 1, 1});
    CHECK_THROWS_AS(normalise(list, Responses(2), 1.0, 1.0), mir::Error);
}
