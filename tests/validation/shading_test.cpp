// SPDX-License-Identifier: MIT
#include "mir/validation/shading.hpp"

#include "conformance/passes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/material_params.hpp"
#include "support/catch.hpp"
#include "validation/finds.hpp"

#include <limits>

namespace {

using mir::CookTorrance;
using mir::Hit;
using mir::Lambert;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;
using mir::validation::check_shading;
using mir::validation::check_shading_bound;
using mir::validation::Report;
using mir::validation::surfaces_with;
using mirtest::finds;
using mirtest::finds_only;

const Lambert::Params grey{{0.5f, 0.25f, 1.0f}};
const auto reflect_grey = [](Vec3 n, Vec3 wi, Vec3 wo) { return Lambert::eval(grey, n, wi, wo); };

/// What is wrong with a shading.
enum class Bug {
    none,
    no_cosine_at_luxel,
    no_cosine_at_vpl,
    cosine_twice,
    distance_not_squared,
    light_from_behind,
    light_from_below,
    square_of_intensity,
    mixes_channels,
    clamps,
    ambient,
    negative,
    not_a_number,
    counts_calls,
    denies_light,
    reaches_too_far,
    rounds_the_distance,
    turns_the_way,
    prepares_another_luxel,
    shines_along_the_normal
};

/// Shading of a Lambertian surface, and a bug.
struct Buggy {
    using Surface = mir::Surface<Lambert::Params>;

    Bug bug;
    mutable float calls = 0.0f;

    [[nodiscard]] bool reflects(const Surface& s) const {
        return bug != Bug::denies_light || s.normal.x > 0.0f;
    }
    [[nodiscard]] float reach_squared() const {
        return bug == Bug::reaches_too_far ? 100.0f : std::numeric_limits<float>::infinity();
    }
    Rgb operator()(const Hit& hit, const Surface& s, const Vpl& vpl) const {
        const Vec3 d = vpl.position - hit.position;
        const float inverse = 1.0f / glm::length(d);
        const Vec3 wi = d * inverse;
        const float g = geometry(wi, inverse, s, vpl);
        const Rgb c = s.bsdf.reflectance * (mir::inv_pi * g);
        const Rgb j = vpl.intensity;
        if (bug == Bug::square_of_intensity) return c * j * j;
        if (bug == Bug::mixes_channels) return c * Rgb{j.g, j.r, j.b};
        if (bug == Bug::clamps) return at_most(c * j, 10.0f);
        if (bug == Bug::ambient) return c * j + Rgb{1e-6f, 1e-6f, 1e-6f};
        if (bug == Bug::negative) return c * j * -1.0f;
        if (bug == Bug::not_a_number && g > 1e6f) return c * j * (0.0f / calls);
        if (bug == Bug::counts_calls) return c * j * (1.0f + 1e-6f * ++calls);
        if (bug == Bug::shines_along_the_normal) return c * j * (s.normal.y * s.normal.y);
        return c * j;
    }
    struct Prepared {
        Hit hit;
        Surface surface;
    };
    [[nodiscard]] Prepared prepared(const Hit& hit, const Surface& s) const {
        Prepared p{hit, s};
        if (bug == Bug::prepares_another_luxel) p.hit.position.x += 1e-3f;
        return p;
    }
    Rgb operator()(const Prepared& p, const Vpl& vpl) const {
        return (*this)(p.hit, p.surface, vpl);
    }
    [[nodiscard]] static float inverse_distance(Vec3 way) { return 1.0f / glm::length(way); }
    [[nodiscard]] Rgb at_distance(const Hit& hit, const Surface& s, const Vpl& vpl, Vec3 way,
                                  float inverse) const {
        Vpl seen = vpl;
        if (bug == Bug::turns_the_way) seen.position = hit.position - way;
        const float rounded = static_cast<float>(std::lround(4096.0f * inverse)) / 4096.0f;
        const Rgb c = (*this)(hit, s, seen);
        return bug == Bug::rounds_the_distance ? c * (rounded / inverse) : c;
    }

 private:
    static Rgb at_most(Rgb c, float most) {
        return {std::min(c.r, most), std::min(c.g, most), std::min(c.b, most)};
    }
    [[nodiscard]] float geometry(Vec3 wi, float inverse, const Surface& s, const Vpl& vpl) const {
        const float at_luxel = glm::dot(wi, s.normal);
        const float at_vpl = -glm::dot(wi, vpl.normal);
        float cos_l = std::max(at_luxel, 0.0f);
        float cos_v = std::max(at_vpl, 0.0f);
        if (bug == Bug::no_cosine_at_luxel && cos_l > 0.0f) cos_l = 1.0f;
        if (bug == Bug::no_cosine_at_vpl && cos_v > 0.0f) cos_v = 1.0f;
        if (bug == Bug::cosine_twice) cos_l *= cos_l;
        if (bug == Bug::light_from_behind) cos_v = std::fabs(at_vpl);
        if (bug == Bug::light_from_below) cos_l = std::fabs(at_luxel);
        return cos_l * cos_v * inverse * (bug == Bug::distance_not_squared ? 1.0f : inverse);
    }
};
static_assert(mir::ReachLimitedShading<Buggy> && mir::SurfaceSelectiveShading<Buggy> &&
              mir::DistanceShading<Buggy> && mir::PreparedShading<Buggy>);

Report check(Bug bug) { return check_shading(Buggy{bug}, surfaces_with(grey), reflect_grey); }

CookTorrance::Params gloss(float roughness, float metallic) {
    mir::Material m;
    m.base_color = {0.9f, 0.6f, 0.3f};
    m.roughness = roughness;
    m.metallic = metallic;
    return material_params(m, CookTorrance{});
}

/// f min(G, bound), or where `adds`, f max(G, bound).
struct Bounded {
    using Surface = mir::Surface<Lambert::Params>;

    float bound;
    bool adds = false;

    Rgb operator()(const Hit& hit, const Surface& s, const Vpl& vpl) const {
        const Rgb whole = mir::VplShading<Lambert>{}(hit, s, vpl);
        if (!adds || is_black(whole)) return mir::VplShading<Lambert>{bound}(hit, s, vpl);
        const Rgb removed = mir::RemovedByBound<Lambert>{bound}(hit, s, vpl);
        return is_black(removed) ? whole * 1.01f : whole - removed;
    }
};

}  // namespace

TEST_CASE("check_shading passes mir's own, and shading that was written out") {
    mirtest::passes(check(Bug::none));
    mirtest::passes(check_shading(mir::VplShading<Lambert>{}, surfaces_with(grey), reflect_grey));
    for (const auto& params : {gloss(0.3f, 0.0f), gloss(0.5f, 1.0f), gloss(1.0f, 0.0f)})
        mirtest::passes(check_shading(
            mir::VplShading<CookTorrance>{}, surfaces_with(params),
            [&](Vec3 n, Vec3 wi, Vec3 wo) { return CookTorrance::eval(params, n, wi, wo); }));
    mirtest::passes(check_shading(mir::RemovedByBound<Lambert>{2.0f}, surfaces_with(grey)));
}

TEST_CASE("check_shading finds a closed form that is missed") {
    for (const Bug bug : {Bug::no_cosine_at_luxel, Bug::no_cosine_at_vpl, Bug::cosine_twice,
                          Bug::distance_not_squared, Bug::shines_along_the_normal}) {
        const Report report = check(bug);
        CAPTURE(int(bug), report.text());
        CHECK(finds(report, "light is J f cos cos / d^2"));
        CHECK(finds(report, "viewer and VPL may change places") ==
              (bug == Bug::no_cosine_at_luxel || bug == Bug::cosine_twice));
        CHECK(finds(report, "axioms: nothing comes from below either horizon") == false);
    }
}

TEST_CASE("check_shading finds each axiom that a shading breaks") {
    const char* below = "nothing comes from below either horizon";
    const char* linear = "light is linear in the VPL's intensity, channel by channel";
    CHECK(finds_only(check(Bug::light_from_behind), below));
    CHECK(finds_only(check(Bug::light_from_below), below));
    CHECK(finds(check(Bug::square_of_intensity), linear));
    CHECK(finds(check(Bug::mixes_channels), linear));
    CHECK(finds(check(Bug::clamps), linear));
    CHECK(finds(check(Bug::ambient), "a VPL of no intensity adds nothing"));
    CHECK(finds(check(Bug::ambient), below));
    CHECK(finds(check(Bug::negative), "values are finite and not negative"));
    CHECK(finds(check(Bug::not_a_number), "values are finite and not negative"));
    CHECK(finds(check(Bug::not_a_number), linear));
    CHECK(finds(check(Bug::counts_calls), "the same question has the same answer"));
    CHECK(finds_only(check(Bug::denies_light), "what reflects() denies is black"));
    CHECK(finds_only(check(Bug::reaches_too_far), "what lies out of reach is black"));
    for (const Bug bug : {Bug::rounds_the_distance, Bug::turns_the_way})
        CHECK(finds_only(check(bug), "at_distance() is the same in every bit"));
    CHECK(finds_only(check(Bug::prepares_another_luxel), "prepared() changes no bit"));
    CHECK(finds(check_shading(mir::VplShading<Lambert>{}, surfaces_with(Lambert::Params{})),
                "VPLs light the luxels"));
}

TEST_CASE("check_shading_bound finds bounds that add light, take all or take none") {
    const mir::VplShading<Lambert> whole;
    const auto surfaces = surfaces_with(grey);
    mirtest::passes(check_shading_bound(mir::VplShading<Lambert>{2.0f}, whole, surfaces));
    mirtest::passes(check_shading_bound(Bounded{0.5f}, whole, surfaces));
    CHECK(finds(check_shading_bound(Bounded{0.5f, true}, whole, surfaces),
                "the bound adds no light"));
    CHECK(finds_only(check_shading_bound(whole, whole, surfaces),
                     "the bound takes light from some pairs"));
    CHECK(finds_only(check_shading_bound(Bounded{1e-20f}, whole, surfaces),
                     "the bound leaves some pairs alone"));
}
