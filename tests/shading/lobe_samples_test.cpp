// SPDX-License-Identifier: MIT
#include "mir/shading/lobe_samples.hpp"

#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/scene_light.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"

namespace {

using mir::CookTorrance;
using mir::Scene;
using mir::Vec3;
using mirtest::FreeSight;
using mirtest::Moments;

// Every test of a mean in this file belongs to one family of level 1 %.
const double level = mirtest::sidak(0.01, 12);

const Vec3 up(0, 1, 0);

/// A scene with what light needs of it.
struct Lit {
    Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};

    explicit Lit(Scene s) : scene(std::move(s)) {}
};

/// The rule without lobes, to which LobeSamples are compared.
struct PickAlone : mir::PickByTree {};

/// Light of lamps that a glossy floor mirrors towards a viewer.
template <class Pick>
Moments mirrored(const Lit& lit, Vec3 at, float alpha, std::uint64_t seed,
                 mir::SharedSamples shared = {}) {
    const mir::EmitterLight<CookTorrance, FreeSight, Pick> light{lit.lights, {}, 4};
    const Vec3 viewer = glm::normalize(Vec3(0.3f, 1, 0.1f));
    const CookTorrance::Params plastic{{0.2f, 0.2f, 0.2f}, {0.04f, 0.04f, 0.04f}, 1.0f, alpha};
    const mir::Surface<CookTorrance::Params> surface{up, viewer, {}, plastic};
    Moments m;
    for (std::uint64_t i = 0; i < 20'000; ++i)
        m.add(
            static_cast<double>(light({at, up}, surface, shared, {seed, mir::Stream::test, i}).g));
    return m;
}

/// Lamps beside each other over the origin, small ones and a large one; one shines upwards too.
Scene lamps_of_sizes() {
    Scene s;
    mir::Material large = mir::emitter("large", {}, {1, 1, 1});
    large.emits_from_both_sides = true;
    s.place(mir::builtin::quad("large", s.add(large), {-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
    const std::uint32_t small = s.add(mir::emitter("small", {}, {50, 50, 50}));
    for (int i = -3; i <= 3; ++i)
        s.place(mir::builtin::quad("small", small, {0.6f * static_cast<float>(i), 0.9f, -0.5f},
                                   {0.05f, 0, 0}, {0, 0, 0.05f}));
    s.point_lights.push_back({"bulb", {0.2f, 0.8f, 0.1f}, {0.1f, 0.1f, 0.1f}});
    return s;
}

/// The same behind a veil that shines, and one behind that.
Scene lamps_behind_veils() {
    Scene s = lamps_of_sizes();
    mir::Material veil = mir::emitter("veil", {}, {1, 2, 3});
    veil.is_blended = true;
    veil.alpha = 0.5f;
    s.place(mir::builtin::quad("veil", s.add(veil), {-0.8f, 0.6f, -1}, {1.6f, 0, 0}, {0, 0, 2}));
    veil.emission = {2, 1, 2};
    s.place(mir::builtin::quad("veil", s.add(veil), {-0.5f, 0.4f, -1}, {2, 0, 0}, {0, 0, 1.5f}));
    return s;
}

}  // namespace

// H0: with LobeSamples the mean is that of samples of lamps alone. Welch's t over 20 000 estimates
// each, at three roughnesses and for a luxel of four.
TEST_CASE("directions into a lobe keep the mean of lamps and take its noise", "[statistical]") {
    const Lit lit(lamps_of_sizes());
    std::uint64_t seed = 140;
    for (const float alpha : {0.01f, 0.05f, 0.15f})
        for (const mir::SharedSamples shared : {mir::SharedSamples{}, mir::SharedSamples{4, 2}}) {
            const Moments both =
                mirrored<mir::PickByTree>(lit, {0.4f, 0, 0}, alpha, seed++, shared);
            const Moments alone = mirrored<PickAlone>(lit, {0.4f, 0, 0}, alpha, seed++, shared);
            CAPTURE(alpha, both.mean(), alone.mean(), both.variance(), alone.variance());
            CHECK(mirtest::welch_p_value(both, alone) > level);
            CHECK(both.variance() < (alpha < 0.1f ? 0.1 : 0.5) * alone.variance());
        }
}

// H0: the same where lamps are seen through. Nothing hides them from each other here.
TEST_CASE("directions into a lobe find lamps behind lamps that are seen through", "[statistical]") {
    const Lit lit(lamps_behind_veils());
    std::uint64_t seed = 160;
    for (const float alpha : {0.01f, 0.05f, 0.15f})
        for (const mir::SharedSamples shared : {mir::SharedSamples{}, mir::SharedSamples{4, 2}}) {
            const Moments both =
                mirrored<mir::PickByTree>(lit, {0.4f, 0, 0}, alpha, seed++, shared);
            const Moments alone = mirrored<PickAlone>(lit, {0.4f, 0, 0}, alpha, seed++, shared);
            CAPTURE(alpha, both.mean(), alone.mean());
            CHECK(mirtest::welch_p_value(both, alone) > level);
        }
}
