// SPDX-License-Identifier: MIT
//
// Lamps that lie exactly in a wall, or in one place with another lamp: every engine and every way
// to find lamps means the same picture.
#include "mir/scene/shapes.hpp"
#include "support.hpp"
#include "support/catch.hpp"
#include "support/statistics.hpp"

using namespace mirtest;
using mir::Acceleration;
using mir::LightSearch;
using mir::Vec3;

namespace {

/// A closed white room of 2 m, seen from one of its walls.
mir::Scene room() {
    mir::Scene s;
    const std::uint32_t white = s.add(mir::lambertian("white", {0.6f, 0.6f, 0.6f}));
    mir::Mesh box = mir::builtin::box("room", white, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2});
    for (mir::TriangleIndices& t : box.triangles) std::swap(t[1], t[2]);
    s.place(std::move(box));
    s.cameras.push_back(mir::Camera::look_at({0, 1, 0.95f}, {0, 1.2f, -1}, {0, 1, 0}, 1.4f));
    return s;
}

/// One square metre in the middle of the room's ceiling that shines downwards, or upwards where it
/// is `turned`, then only if it shines from both sides.
void add_lamp(mir::Scene& s, float radiance, bool both_sides = false, bool turned = false) {
    mir::Material m = mir::emitter("lamp", {0.2f, 0.2f, 0.2f}, {radiance, radiance, radiance});
    m.emits_from_both_sides = both_sides;
    const Vec3 x(1, 0, 0);
    const Vec3 z(0, 0, 1);
    s.place(
        mir::builtin::quad("lamp", s.add(m), {-0.5f, 2, -0.5f}, turned ? z : x, turned ? x : z));
}

/// Mean luminance of the path tracer's picture, over 16 seeds.
Moments brightness(const mir::Scene& scene, Acceleration by, LightSearch search) {
    mir::RenderSettings s = small_settings(16, 1);
    s.integrator = mir::Integrator::path;
    s.acceleration = by;
    s.path.samples = 32;
    s.path.light = search;
    Moments means;
    for (s.seed = 0; s.seed < 16; ++s.seed) means.add(mean_luminance(render(scene, s).beauty));
    return means;
}

constexpr Acceleration engines[] = {Acceleration::bvh, Acceleration::kd_tree, Acceleration::embree};
constexpr LightSearch searches[] = {LightSearch::lamps, LightSearch::directions};

}  // namespace

// H0: equal means. Welch's test, 16 replicates each, level 1 % over 3 lamps, 3 engines and 2
// searches. Seeds 0 to 15 either side, of other random numbers.
TEST_CASE("a lamp in a wall brings the same light to light samples and scattered directions",
          "[statistical]") {
    const double level = sidak(0.01, 3 * 3 * 2);
    struct Case {
        bool both_sides;
        bool turned;
    };
    for (const Case c : {Case{false, false}, Case{true, false}, Case{true, true}}) {
        mir::Scene scene = room();
        add_lamp(scene, 4.0f, c.both_sides, c.turned);
        const Moments truth = brightness(scene, Acceleration::bvh, LightSearch::mis);
        CAPTURE(c.both_sides, c.turned, truth.mean());
        CHECK(truth.mean() > 0.3);
        for (const Acceleration engine : engines)
            for (const LightSearch search : searches) {
                const Moments found = brightness(scene, engine, search);
                CAPTURE(static_cast<int>(engine), static_cast<int>(search), found.mean());
                CHECK(welch_p_value(found, truth) > level);
            }
    }
}

// H0 and test as above, level 1 % over 3 engines and 2 searches.
TEST_CASE("of two lamps in one place the first one lights the room", "[statistical]") {
    const double level = sidak(0.01, 3 * 2);
    mir::Scene one = room();
    add_lamp(one, 4.0f);
    mir::Scene two = one;
    add_lamp(two, 9.0f);
    const Moments truth = brightness(one, Acceleration::bvh, LightSearch::mis);
    for (const Acceleration engine : engines)
        for (const LightSearch search : searches) {
            const Moments found = brightness(two, engine, search);
            CAPTURE(static_cast<int>(engine), static_cast<int>(search), found.mean());
            CHECK(welch_p_value(found, truth) > level);
        }
}

// H0 and test as above, level 1 % over 3 engines: VPLs without a bound.
TEST_CASE("VPLs of a lamp in a wall bring the light of paths", "[statistical]") {
    mir::Scene scene = room();
    add_lamp(scene, 4.0f, true);
    const Moments truth = brightness(scene, Acceleration::bvh, LightSearch::mis);
    for (const Acceleration engine : engines) {
        mir::RenderSettings s = small_settings(16, 512);
        s.sampler = mir::SamplerKind::instant_radiosity;
        s.acceleration = engine;
        Moments found;
        for (s.seed = 0; s.seed < 16; ++s.seed) found.add(mean_luminance(render(scene, s).beauty));
        CAPTURE(static_cast<int>(engine), found.mean(), truth.mean());
        CHECK(welch_p_value(found, truth) > sidak(0.01, 3));
    }
}
