// SPDX-License-Identifier: MIT
//
// What must not change a picture (docs/validation.md, "Invariances"). Equal seeds give equal random
// numbers: pictures are compared directly, but for changes that lead the numbers elsewhere.
#include "reference/studio.hpp"
#include "support.hpp"
#include "support/catch.hpp"

using namespace mirtest;

namespace {

/// The whole scene under x -> scale x + shift.
mir::Scene transformed(mir::Scene scene, float scale, mir::Vec3 shift) {
    mir::Mat4 m(scale);
    m[3] = mir::Vec4(shift, 1.0f);
    for (mir::Instance& i : scene.instances) i.to_world = m * i.to_world;
    for (mir::Camera& c : scene.cameras) c.position = scale * c.position + shift;
    return scene;
}

/// The whole scene turned by `angle` about the axis (1, 2, 3).
mir::Scene turned(mir::Scene scene, float angle) {
    const mir::Vec3 axis = glm::normalize(mir::Vec3(1, 2, 3));
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    const auto turn = [&](mir::Vec3 v) {
        return c * v + s * glm::cross(axis, v) + (1.0f - c) * glm::dot(axis, v) * axis;
    };
    const mir::Mat4 m(mir::Vec4(turn({1, 0, 0}), 0), mir::Vec4(turn({0, 1, 0}), 0),
                      mir::Vec4(turn({0, 0, 1}), 0), mir::Vec4(0, 0, 0, 1));
    for (mir::Instance& i : scene.instances) i.to_world = m * i.to_world;
    for (mir::Camera& k : scene.cameras) {
        k.position = turn(k.position);
        k.right = turn(k.right);
        k.up = turn(k.up);
        k.back = turn(k.back);
    }
    return scene;
}

/// Every triangle cut into four: the surface stays, the sampling numbers lead elsewhere.
mir::Scene subdivided(mir::Scene scene) {
    for (mir::Mesh& m : scene.meshes) {
        std::vector<mir::TriangleIndices> finer;
        for (const mir::TriangleIndices& t : m.triangles) {
            const auto first = static_cast<std::uint32_t>(m.positions.size());
            for (std::uint32_t k = 0; k < 3; ++k)
                m.positions.push_back(0.5f * (m.positions[t[k]] + m.positions[t[(k + 1) % 3]]));
            finer.push_back({t[0], first, first + 2});
            finer.push_back({first, t[1], first + 1});
            finer.push_back({first + 2, first + 1, t[2]});
            finer.push_back({first, first + 1, first + 2});
        }
        m.triangles = finer;
        m.normals.clear();
    }
    return scene;
}

mir::Scene two_lamps(float first, float second) {
    mir::Scene s = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    const mir::Rgb radiance = s.materials[s.meshes.back().material].emission;
    const std::uint32_t a = s.add(mir::emitter("a", {}, radiance * first));
    const std::uint32_t b = s.add(mir::emitter("b", {}, radiance * second));
    s.meshes.back().material = a;
    mir::Mesh twin = s.meshes.back();
    twin.material = b;
    for (mir::Vec3& p : twin.positions) p.y -= 1e-3f;
    if (second > 0.0f) s.place(twin);
    return s;
}

/// Settings of one sampler.
mir::RenderSettings settings_of(mir::SamplerKind sampler, std::uint32_t side, std::uint32_t vpls) {
    mir::RenderSettings s = small_settings(side, vpls);
    s.sampler = sampler;
    s.metropolis.chains = 128;  // fewer than VPLs, or nothing would mutate
    s.metropolis.stride = 16;
    s.metropolis.bootstrap = {1.0, 1u << 14, 1u << 14};
    return s;
}

/// p-value, after Sidak, of "both scenes give the same mean indirect light in four tiles": Welch's
/// test over 24 seeds each.
double p_of_equal_light(const mir::Scene& a, const mir::Scene& b, mir::SamplerKind sampler) {
    constexpr std::uint32_t side = 24;
    TileMeans first(side / 2);
    TileMeans second(side / 2);
    mir::RenderSettings s = settings_of(sampler, side, 128);
    s.direct_samples = 1;
    s.bound = {mir::BoundPolicy::Kind::fixed, 14.0f};
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        s.seed = seed;
        first.add(render(a, s).indirect);
        s.seed = seed + 1000;
        second.add(render(b, s).indirect);
    }
    return -std::expm1(4.0 * std::log1p(-smallest_p(first, second)));
}

}  // namespace

TEST_CASE("a picture does not depend on the scale of the scene") {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (const mir::SamplerKind sampler : samplers) {
        auto settings = settings_of(sampler, 48, 64);
        settings.bound.kind = mir::BoundPolicy::Kind::automatic;
        const auto reference = render(scene, settings);
        for (float scale : {0x1p-10f, 0x1p-4f, 0x1p4f, 0x1p10f}) {
            // Powers of two change no digit of any coordinate: the pictures agree to rounding of
            // sums.
            const auto scaled = render(transformed(scene, scale, {0, 0, 0}), settings);
            CAPTURE(int(sampler), scale);
            CHECK(relative_difference(reference.beauty, scaled.beauty) < 1e-6);
        }
        for (float scale : {1e-3f, 1e3f}) {
            const auto scaled = render(transformed(scene, scale, {0, 0, 0}), settings);
            CAPTURE(int(sampler), scale);
            CHECK(relative_difference(reference.beauty, scaled.beauty) < 2e-3);
            // A length that does not grow with the scene is noticed, here one over the root of a
            // bound.
            settings.bound = {mir::BoundPolicy::Kind::fixed, reference.statistics.bound};
            const auto unscaled = render(transformed(scene, scale, {0, 0, 0}), settings);
            CHECK(relative_difference(reference.indirect, unscaled.indirect) > 1e-2);
            settings.bound.kind = mir::BoundPolicy::Kind::automatic;
        }
    }
}

TEST_CASE("a scene far from the origin looks the same and does not leak") {
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (const mir::SamplerKind sampler : samplers) {
        auto settings = settings_of(sampler, 48, 512);
        settings.bound.kind = mir::BoundPolicy::Kind::automatic;
        const auto reference = render(scene, settings);
        for (float away : {8.0f, 128.0f, 1024.0f}) {
            // At 1024 m a 2 m room keeps 2^-14 m of resolution: shadow edges move by some of that,
            // and now and then a light path takes another turn. Resampling takes other candidates
            // then as well.
            const auto far =
                render(transformed(scene, 1.0f, away * mir::Vec3(1, -0.5f, 2)), settings);
            CAPTURE(int(sampler), away);
            CHECK(mean_luminance(far.direct) ==
                  mirtest::Approx(mean_luminance(reference.direct)).epsilon(1e-2));
            CHECK(mean_luminance(far.indirect) ==
                  mirtest::Approx(mean_luminance(reference.indirect)).epsilon(2e-2));
        }
    }
}

TEST_CASE("a scene whose floats hold its place far away gives the same picture in every bit") {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    scene.cameras[0].position.z = 6.75f;
    for (const mir::SamplerKind sampler : samplers) {
        const auto settings = settings_of(sampler, 32, 64);
        const auto reference = render(scene, settings);
        CHECK(reference.statistics.origin == mir::DVec3(0.0));
        for (float away : {1024.0f, 65536.0f, 1048576.0f}) {
            const mir::Vec3 way = away * mir::Vec3(1, -0.5f, 2);
            const auto far = render(transformed(scene, 1.0f, way), settings);
            CAPTURE(int(sampler), away);
            CHECK(same_bits(far.beauty, reference.beauty));
            CHECK(far.guides.position.pixels().front() ==
                  reference.guides.position.pixels().front());
            CHECK(far.statistics.origin == mir::DVec3(way));
            CHECK(far.warnings == reference.warnings);
        }
    }
}

TEST_CASE("vertices that floats rounded far away are among the warnings of a renderer") {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (mir::Mesh& mesh : scene.meshes)
        for (mir::Vec3& p : mesh.positions) p.x += 65536.0f;
    scene.cameras[0].position.x += 65536.0f;
    const auto far = render(scene, settings_of(mir::SamplerKind::instant_radiosity, 8, 16));
    CHECK(far.statistics.origin == mir::DVec3(65536, 0, 0));
    REQUIRE_FALSE(far.warnings.empty());
    CHECK(far.warnings[0].find("0.00781 m apart") != std::string::npos);
}

TEST_CASE("a picture does not depend on a rigid motion of scene and camera") {
    mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    // How a tree divides several lamps follows the axes, and so do the lamps that it picks.
    scene.meshes.back().triangles.resize(1);
    const auto settings = settings_of(mir::SamplerKind::instant_radiosity, 48, 64);
    const auto reference = render(scene, settings);
    // The turned frames around normals send the same numbers into other directions: only the light
    // that does not depend on them is equal. Rounding moves a few pixels across an edge.
    const auto other = render(turned(scene, 1.0f), settings);
    CHECK(share_of_changed_pixels(reference.direct, other.direct, 1e-3f) < 0.005);
    CHECK(share_of_changed_pixels(reference.emission, other.emission, 1e-3f) < 0.005);
}

TEST_CASE("a rigid motion does not change the mean indirect light", "[statistical]") {
    // H0 and test: see p_of_equal_light(); level 1 % over 3 samplers.
    const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    for (const mir::SamplerKind sampler : samplers) {
        CAPTURE(int(sampler));
        CHECK(p_of_equal_light(scene, turned(scene, 1.0f), sampler) > sidak(0.01, samplers.size()));
    }
}

TEST_CASE("twice the power gives twice the picture, in every bit") {
    for (const mir::SamplerKind sampler : samplers) {
        mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
        const auto settings = settings_of(sampler, 32, 64);
        const auto once = render(scene, settings);
        for (mir::Material& m : scene.materials) m.emission = m.emission * 2.0f;
        const auto twice = render(scene, settings);
        mir::Image<mir::Rgb> expected = once.beauty;
        for (mir::Rgb& p : expected.pixels()) p = p * 2.0f;
        CAPTURE(int(sampler));
        CHECK(same_bits(expected, twice.beauty));
    }
}

TEST_CASE("splitting a lamp in two leaves the light as it was", "[statistical]") {
    // H0 and test: see p_of_equal_light(); level 1 % over 3 samplers. A lamp that is a tenth
    // brighter must be seen.
    for (const mir::SamplerKind sampler : samplers) {
        CAPTURE(int(sampler));
        CHECK(p_of_equal_light(two_lamps(1.0f, 0.0f), two_lamps(0.0f, 1.0f), sampler) >
              sidak(0.01, samplers.size()));
        CHECK(p_of_equal_light(two_lamps(1.0f, 0.0f), two_lamps(0.6f, 0.5f), sampler) <
              sidak(0.01, samplers.size()));
    }
}

TEST_CASE("cutting triangles does not change the light", "[statistical]") {
    // H0 and test: see p_of_equal_light(); level 1 % over 3 samplers.
    const mir::Scene coarse = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    const mir::Scene fine = subdivided(coarse);
    for (const mir::SamplerKind sampler : samplers) {
        CAPTURE(int(sampler));
        CHECK(p_of_equal_light(coarse, fine, sampler) > sidak(0.01, samplers.size()));
    }
}

TEST_CASE("threads, tiles and scheduler change no bit of any layer") {
    mir::Scene scene = mir::builtin::sphere_room(mir::builtin::Lamp::up);
    for (mir::Material& m : scene.materials) m.specular = 1.0f;  // the full shading model
    for (mir::Material& m : scene.materials) m.roughness = 0.4f;
    auto settings = settings_of(GENERATE(from_range(samplers)), 50, 48);
    settings.image = {70, 50};
    settings.luxels_per_pixel = 3;
    settings.bound.kind = mir::BoundPolicy::Kind::automatic;
    settings.compensate = 6;
    settings.filter = mir::default_filter(mir::FilterKind::lanczos);
    settings.threads = 1;
    const auto reference = render(scene, settings);
    CHECK(reference.statistics.residual_luminance > 0.0);
    for (unsigned threads : {1u, 2u})
        for (std::uint32_t tile : {16u, 64u, 80u})
            for (const char* scheduler : {"cpu", "cpu-blocks"}) {
                settings.threads = threads;
                settings.tile = {tile, tile};
                settings.scheduler = scheduler;
                const auto other = render(scene, settings);
                CAPTURE(int(settings.sampler), threads, tile, scheduler);
                CHECK(same_bits(reference.beauty, other.beauty));
                CHECK(same_bits(reference.indirect, other.indirect));
                CHECK(same_bits(reference.guides.albedo, other.guides.albedo));
                CHECK(reference.statistics.removed_luminance == other.statistics.removed_luminance);
                CHECK(reference.statistics.residual_luminance ==
                      other.statistics.residual_luminance);
            }
}
