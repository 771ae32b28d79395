// SPDX-License-Identifier: MIT
#include "mir/validation/bsdf.hpp"

#include "mir/shading/lambert.hpp"
#include "mir/validation/bsdf_samples.hpp"
#include "support/catch.hpp"
#include "validation/finds.hpp"

#include <limits>

namespace {

using mir::BsdfSample;
using mir::Lambert;
using mir::Rgb;
using mir::Vec2;
using mir::Vec3;
using mirtest::finds;
using mirtest::finds_only;

// Each differs from Lambert in what its name says.

struct BrighterFromOneSide : Lambert {
    static Rgb eval(const Params& p, Vec3 n, Vec3 wi, Vec3) {
        return p.reflectance * (mir::inv_pi * mir::larger(glm::dot(n, wi), 0.0f));
    }
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        s.weight = s.weight * glm::dot(n, s.wi);
        return s;
    }
};
struct StopsBelow : Lambert {
    static Rgb eval(const Params& p, Vec3 n, Vec3 wi, Vec3 wo) {
        return glm::dot(n, wo) > 0.0f ? Lambert::eval(p, n, wi, wo) : Rgb{};
    }
};
struct TwiceAsBright : Lambert {
    static Rgb eval(const Params& p, Vec3, Vec3, Vec3) { return p.reflectance * (2 * mir::inv_pi); }
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        s.weight = s.weight * 2.0f;
        return s;
    }
};
struct NotANumberWhenGrazing : Lambert {
    static Rgb eval(const Params& p, Vec3 n, Vec3 wi, Vec3 wo) {
        const bool grazing = glm::dot(n, wi) < 1e-8f || glm::dot(n, wo) < 1e-8f;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        return p.reflectance * (grazing ? nan : mir::inv_pi);
    }
};
/// In one channel, away from where check_bsdf() looks for single values.
struct NotANumberInBlue : Lambert {
    static Rgb eval(const Params& p, Vec3 n, Vec3 wi, Vec3) {
        const float cosine = glm::dot(n, wi);
        const bool there = cosine > 0.4f && cosine < 0.6f;
        const float nan = std::numeric_limits<float>::quiet_NaN();
        return {p.reflectance.r * mir::inv_pi, p.reflectance.g * mir::inv_pi,
                there ? nan : p.reflectance.b * mir::inv_pi};
    }
};
struct PdfTooLarge : Lambert {
    static float pdf(const Params&, Vec3 n, Vec3 wi, Vec3) {
        return mir::larger(glm::dot(n, wi), 0.0f);
    }
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        return {s.wi, s.weight * mir::inv_pi, s.pdf * mir::pi};
    }
};
struct AlbedoIsPercent : Lambert {
    static Rgb albedo(const Params& p, Vec3, Vec3) { return p.reflectance * 100.0f; }
};
struct CallsItselfBlack : Lambert {
    static bool is_black(const Params&) { return true; }
};
struct WeightWithoutCosine : Lambert {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        s.weight = s.weight * (1.0f / glm::dot(n, s.wi));
        return s;
    }
};
struct SamplesBelow : Lambert {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        return Lambert::sample(p, -n, wo, u, lobe);
    }
};
struct ThrowsMostAway : Lambert {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        return lobe < 0.9f ? BsdfSample{} : Lambert::sample(p, n, wo, u, lobe);
    }
};
/// `Own` reflects, once for all directions, what is told of each rounding.
template <class Own>
struct Prepared : Lambert {
    struct Outgoing {
        using Model = Own;
        Rgb f;
        Rgb operator()(Vec3, float) const { return f; }
    };
    template <class Rounding>
    static Outgoing outgoing(const Params& p, Vec3, Vec3) {
        return {p.reflectance * Own::factor(Rounding{})};
    }
};
struct PreparedRightly : Prepared<PreparedRightly> {
    template <class Rounding>
    static float factor(Rounding) {
        return mir::inv_pi;
    }
};
struct PreparedDarker : Prepared<PreparedDarker> {
    static float factor(mir::SeparateRounding) { return 0.999999f * mir::inv_pi; }
    static float factor(mir::FusedRounding) { return mir::inv_pi; }
};
struct FusedDarker : Prepared<FusedDarker> {
    static float factor(mir::SeparateRounding) { return mir::inv_pi; }
    static float factor(mir::FusedRounding) { return 0.99f * mir::inv_pi; }
};
/// sample() squeezes directions towards the normal, pdf() does not know.
struct SamplesAnotherDensity : Lambert {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        return Lambert::sample(p, n, wo, {u.x, 0.95f * u.y}, lobe);
    }
};
struct ThrowsFewAway : Lambert {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        return lobe < 0.02f ? BsdfSample{} : Lambert::sample(p, n, wo, u, lobe);
    }
};
struct SamplesAreNotANumber : Lambert {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        if (lobe < 1e-3f) s.wi.x = std::numeric_limits<float>::quiet_NaN();
        return s;
    }
};
/// Lambert, one side of whose hemisphere is folded onto the other.
struct OneSided : Lambert {
    static float pdf(const Params& p, Vec3 n, Vec3 wi, Vec3 wo) {
        const bool there = glm::dot(mir::Frame::around(n).bitangent, wi) > 0.0f;
        return there ? 2.0f * Lambert::pdf(p, n, wi, wo) : 0.0f;
    }
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        const Vec3 across = mir::Frame::around(n).bitangent;
        const float side = glm::dot(across, s.wi);
        if (side < 0.0f) s.wi -= 2.0f * side * across;
        return {s.wi, s.weight * 0.5f, 2.0f * s.pdf};
    }
};
struct SamplesWherePdfIsZero : OneSided {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        return lobe < 0.02f ? Lambert::sample(p, n, wo, u, lobe)
                            : OneSided::sample(p, n, wo, u, lobe);
    }
};
/// Throws everything away.
struct Black : Lambert {
    static Rgb eval(const Params&, Vec3, Vec3, Vec3) { return {}; }
    static float pdf(const Params&, Vec3, Vec3, Vec3) { return 0.0f; }
    static Rgb albedo(const Params&, Vec3, Vec3) { return {}; }
    static bool is_black(const Params&) { return true; }
    static BsdfSample sample(const Params&, Vec3, Vec3, Vec2, float) { return {}; }
};
struct BlackButSampled : Black {
    static BsdfSample sample(const Params& p, Vec3 n, Vec3 wo, Vec2 u, float lobe) {
        return Lambert::sample(p, n, wo, u, lobe);
    }
};

const std::vector<Lambert::Params> grey{{{0.9f, 0.6f, 0.3f}}};

template <class B>
mir::validation::Report check() {
    return mir::validation::check_bsdf<B>(grey);
}

template <class B>
mir::validation::Report check_samples() {
    return mir::validation::check_bsdf_samples<B>(grey[0], 0.7f);
}

}  // namespace

TEST_CASE("check_bsdf finds nothing wrong with a right model") {
    CHECK(check<Lambert>().passed());
    CHECK(check<Black>().passed());
    CHECK(check<PreparedRightly>().passed());
    CHECK_FALSE(mir::validation::check_bsdf<Lambert>({}).passed());
}

TEST_CASE("check_bsdf finds each axiom that a model breaks, and no other") {
    CHECK(finds(check<BrighterFromOneSide>(), "eval is reciprocal"));
    CHECK(finds(check<BrighterFromOneSide>(),
                "below the normal it reflects as elsewhere, or nothing"));
    CHECK(finds_only(check<StopsBelow>(), "below the normal it reflects as elsewhere, or nothing"));
    CHECK(finds_only(check<TwiceAsBright>(), "no more light is reflected than arrives"));
    CHECK(finds(check<NotANumberWhenGrazing>(), "eval and pdf are finite and not negative"));
    CHECK(finds(check<NotANumberInBlue>(), "eval is reciprocal"));
    CHECK(finds(check<NotANumberInBlue>(), "no more light is reflected than arrives"));
    CHECK(finds_only(check<PdfTooLarge>(), "pdf integrates to at most 1"));
    CHECK(finds_only(check<AlbedoIsPercent>(), "albedo lies in [0, 1]"));
    CHECK(finds_only(check<CallsItselfBlack>(), "what is black reflects nothing"));
    CHECK(finds_only(check<WeightWithoutCosine>(), "weights of samples are eval cos / pdf"));
    CHECK(finds(check<SamplesBelow>(),
                "samples are unit directions above the surface with finite weights"));
    CHECK(finds_only(check<ThrowsMostAway>(), "samples of what reflects are mostly kept"));
    CHECK(finds_only(check<PreparedDarker>(), "prepared, it is the same in every bit"));
    CHECK(finds_only(check<FusedDarker>(), "rounded otherwise, it is the same function"));
}

// Hypothesis, level and seed: see check_bsdf_samples().
TEST_CASE("check_bsdf_samples finds samples of another density", "[statistical]") {
    CHECK(check_samples<Lambert>().passed());
    CHECK(check_samples<OneSided>().passed());
    CHECK(check_samples<Black>().passed());
    const char* follow = "samples follow pdf";
    CHECK(finds_only(check_samples<SamplesAnotherDensity>(), follow));
    CHECK(finds_only(check_samples<ThrowsFewAway>(), follow));
    CHECK(finds_only(check_samples<SamplesWherePdfIsZero>(), follow));
    CHECK(finds_only(check_samples<BlackButSampled>(), follow));
    CHECK(finds(check_samples<SamplesAreNotANumber>(), "samples are finite"));
}
