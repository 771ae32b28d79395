// SPDX-License-Identifier: MIT
#include "mir/concepts/shading.hpp"

#include "conformance/shading_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "mir/shading/material_params.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"

#include <string>

namespace {

namespace archetype = mir::archetype;
using mir::CookTorrance;
using mir::Lambert;

static_assert(mir::Shading<archetype::Shading>);
static_assert(!mir::ReachLimitedShading<archetype::Shading>);

struct WithoutCall : archetype::Value {
    using Surface = archetype::Surface;
};
static_assert(!mir::Shading<WithoutCall>);

struct WithoutSurface : archetype::Value {
    mir::Rgb operator()(const mir::Hit&, const archetype::Surface&, const mir::Vpl&) const {
        return {};
    }
};
static_assert(!mir::Shading<WithoutSurface>);

struct ReturnsFloat : archetype::Value {
    using Surface = archetype::Surface;
    float operator()(const mir::Hit&, const Surface&, const mir::Vpl&) const { return 0.0f; }
};
static_assert(!mir::Shading<ReturnsFloat>);

struct ChangesItself : archetype::Value {
    using Surface = archetype::Surface;
    mir::Rgb operator()(const mir::Hit&, const Surface&, const mir::Vpl&) { return {}; }
};
static_assert(!mir::Shading<ChangesItself>);

struct OwnsMemory : archetype::Shading {
    std::string name;
};
static_assert(!mir::Shading<OwnsMemory>);

static_assert(mir::ReachLimitedShading<archetype::ReachLimitedShading>);
static_assert(mir::SurfaceSelectiveShading<archetype::SurfaceSelectiveShading>);
static_assert(!mir::SurfaceSelectiveShading<archetype::Shading>);

struct ReflectsMaybe : archetype::Shading {
    [[nodiscard]] int reflects(const Surface&) const { return 1; }
};
static_assert(mir::Shading<ReflectsMaybe> && !mir::SurfaceSelectiveShading<ReflectsMaybe>);

struct DoubleReach : archetype::Shading {
    [[nodiscard]] double reach_squared() const { return 1.0; }
};
static_assert(mir::Shading<DoubleReach> && !mir::ReachLimitedShading<DoubleReach>);

struct RedAtDistance : archetype::Shading {
    [[nodiscard]] float at_distance(const mir::Hit&, const Surface&, const mir::Vpl&, mir::Vec3,
                                    float) const {
        return 1.0f;
    }
};
static_assert(mir::Shading<RedAtDistance> && !mir::DistanceShading<RedAtDistance>);
static_assert(mir::DistanceShading<archetype::DistanceShading>);

/// Shades otherwise than its base, whose at_distance() it has.
struct Doubled : mir::VplShading<Lambert> {
    mir::Rgb operator()(const mir::Hit& h, const Surface& s, const mir::Vpl& v) const {
        return mir::VplShading<Lambert>::operator()(h, s, v) * 2.0f;
    }
};
static_assert(mir::Shading<Doubled> && !mir::DistanceShading<Doubled>);
static_assert(!mir::PreparedShading<Doubled>);
static_assert(mir::PreparedShading<archetype::PreparedShading>);
static_assert(!mir::PreparedShading<archetype::Shading>);
static_assert(mir::PreparedShading<mir::VplShading<CookTorrance>>);
static_assert(mir::PreparedShading<mir::VplShading<Lambert>>);
static_assert(!mir::PreparedShading<mir::RemovedByBound<CookTorrance>>);
static_assert(mir::PreparedBsdf<CookTorrance> && !mir::PreparedBsdf<Lambert>);

/// Reflects otherwise than its base, whose outgoing() it has.
struct Matt : CookTorrance {
    static mir::Rgb eval(const Params& p, mir::Vec3, mir::Vec3, mir::Vec3) { return p.diffuse; }
};
static_assert(mir::Bsdf<Matt> && !mir::PreparedBsdf<Matt>);
static_assert(!mir::DistanceShading<archetype::Shading>);
static_assert(mir::DistanceShading<mir::VplShading<CookTorrance>>);
static_assert(!mir::DistanceShading<mir::RemovedByBound<CookTorrance>>);

static_assert(mir::Shading<mir::VplShading<Lambert>>);
static_assert(mir::Shading<mir::VplShading<CookTorrance>>);
static_assert(!mir::ReachLimitedShading<mir::VplShading<Lambert>>);
static_assert(mir::ReachLimitedShading<mir::RemovedByBound<CookTorrance>>);
static_assert(mir::SurfaceSelectiveShading<mir::VplShading<Lambert>>);
static_assert(mir::SurfaceSelectiveShading<mir::RemovedByBound<CookTorrance>>);

const std::vector<Lambert::Params> grey{{{0.5f, 0.5f, 0.5f}}, {{1.0f, 0.0f, 0.2f}}};

std::vector<CookTorrance::Params> glossy() {
    std::vector<CookTorrance::Params> list;
    for (float roughness : {0.0f, 0.3f, 1.0f})
        for (float metallic : {0.0f, 1.0f}) {
            mir::Material m;
            m.roughness = roughness;
            m.metallic = metallic;
            list.push_back(material_params(m, CookTorrance{}));
        }
    return list;
}

/// The two are computed apart, so they add up to the unbounded value but for rounding.
template <mir::Bsdf B, class Params>
void bounded_and_removed_make_the_whole(const std::vector<Params>& list) {
    const float bound = 0.5f;
    mir::Random random = mirtest::test_random(44);
    using Surface = mir::Surface<Params>;
    std::size_t removed = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto pair = mirtest::random_pair<Surface>(list[i % list.size()], random);
        const mir::Rgb whole = mir::VplShading<B>{}(pair.hit, pair.surface, pair.vpl);
        const mir::Rgb kept = mir::VplShading<B>{bound}(pair.hit, pair.surface, pair.vpl);
        const mir::Rgb lost = mir::RemovedByBound<B>{bound}(pair.hit, pair.surface, pair.vpl);
        REQUIRE(kept.r + lost.r == mirtest::Approx(whole.r).epsilon(1e-5));
        REQUIRE(kept.g + lost.g == mirtest::Approx(whole.g).epsilon(1e-5));
        removed += mir::is_black(lost) ? 0 : 1;
    }
    CHECK(removed > 50);
}

}  // namespace

TEST_CASE("VplShading keeps the axioms of Shading") {
    mirtest::shading_suite(mir::VplShading<Lambert>{}, std::span(grey));
    mirtest::shading_suite(mir::VplShading<Lambert>{2.0f}, std::span(grey));
    const auto list = glossy();
    mirtest::shading_suite(mir::VplShading<CookTorrance>{}, std::span(list));
    mirtest::shading_suite(mir::VplShading<CookTorrance>{2.0f}, std::span(list));
}

TEST_CASE("RemovedByBound keeps the axioms of Shading and does nothing beyond its reach") {
    mirtest::shading_suite(mir::RemovedByBound<Lambert>{2.0f}, std::span(grey));
    const auto list = glossy();
    mirtest::shading_suite(mir::RemovedByBound<CookTorrance>{2.0f}, std::span(list));
}

TEST_CASE("Shadings tell surfaces that reflect nothing from others") {
    const Lambert::Params black{};
    mirtest::selective_suite(mir::VplShading<Lambert>{}, black, std::span(grey));
    mirtest::selective_suite(mir::RemovedByBound<Lambert>{2.0f}, black, std::span(grey));
    const auto list = glossy();
    const CookTorrance::Params glossless{};
    mirtest::selective_suite(mir::VplShading<CookTorrance>{}, glossless, std::span(list));
    mirtest::selective_suite(mir::RemovedByBound<CookTorrance>{2.0f}, glossless, std::span(list));
}

TEST_CASE("What the bound leaves and what it removes add up to the unbounded contribution") {
    bounded_and_removed_make_the_whole<Lambert>(grey);
    bounded_and_removed_make_the_whole<CookTorrance>(glossy());
}

TEST_CASE("A VPL on the luxel contributes nothing") {
    const archetype::Visibility visible{archetype::make};
    mirtest::coincident_points_give_nothing(mir::VplShading<Lambert>{}, visible, grey[0]);
    mirtest::coincident_points_give_nothing(mir::VplShading<CookTorrance>{}, visible, glossy()[0]);
}

TEST_CASE("A VPL straight above a Lambertian luxel contributes rho J / (pi d^2)") {
    const mir::Hit hit{{0, 0, 0}, {0, 0, 1}};
    const mir::Surface<Lambert::Params> surface{{0, 0, 1}, {0, 0, 1}, {}, {{0.5f, 0.25f, 1.0f}}};
    const mir::Vpl vpl{{0, 0, 2}, {0, 0, -1}, {4.0f, 8.0f, 16.0f}};
    const mir::Rgb c = mir::VplShading<Lambert>{}(hit, surface, vpl);
    CHECK(c.r == mirtest::Approx(0.5 * mir::inv_pi).epsilon(1e-6));
    CHECK(c.g == mirtest::Approx(0.5 * mir::inv_pi).epsilon(1e-6));
    CHECK(c.b == mirtest::Approx(4.0 * mir::inv_pi).epsilon(1e-6));
    // G = 1/4; a bound of 1/8 halves it.
    CHECK(mir::VplShading<Lambert>{0.125f}(hit, surface, vpl).r == mirtest::Approx(0.5f * c.r));
    CHECK(mir::RemovedByBound<Lambert>{0.125f}(hit, surface, vpl).r == mirtest::Approx(0.5f * c.r));
}
