// SPDX-License-Identifier: MIT
#include "mir/shading/specular_tracer.hpp"

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/core/decay.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/surface_table.hpp"
#include "support/catch.hpp"
#include "support/test_sky.hpp"

#include <cmath>
#include <utility>

namespace {

using mir::CookTorrance;
using mir::Lambert;
using mir::Rgb;
using mir::Transport;
using mir::Vec3;

mir::Material glass(bool thin, float ior = 1.5f) {
    mir::Material m;
    m.name = "glass";
    m.base_color = {1, 1, 1};
    m.roughness = 0.0f;
    m.transmission = 1.0f;
    m.is_thin = thin;
    m.ior = ior;
    return m;
}

mir::Material mirror() {
    mir::Material m;
    m.name = "mirror";
    m.base_color = {1, 1, 1};
    m.metallic = 1.0f;
    m.roughness = 0.0f;
    return m;
}

/// A scene and what luxels see of it.
template <class B = CookTorrance>
struct Seen {
    explicit Seen(mir::Scene s) : scene(std::move(s)) {}

    mir::Scene scene;
    mir::WorldGeometry geometry{scene};
    mir::LightTable lights{scene, geometry};
    mir::SurfaceTable<B> surfaces{scene};
    mir::KdTreeScene tree{geometry};

    [[nodiscard]] auto tracer() const {
        return mir::LuxelTracer{tree.ray_caster(), surfaces.view()};
    }
    [[nodiscard]] Rgb radiance(const mir::Ray& ray) const {
        return tracer().surface(tracer()(ray), lights.environment().view()).emission;
    }
    [[nodiscard]] mir::SpecularEnd followed(const mir::Ray& ray, Transport transport,
                                            std::uint64_t i) const {
        mir::SpecularEnd end;
        end.ray = ray;
        end.is_background = !find_point(tree.ray_caster(), ray, end.point);
        mir::Random numbers(910, mir::Stream::test, i);
        mir::SpecularTracer{tree.ray_caster(), surfaces.view()}.follow(end, transport, numbers);
        return end;
    }
};

mir::Ray fan(int i, Vec3 from) {
    const float a = 0.37f * static_cast<float>(i);
    return {from, glm::normalize(Vec3(0.4f * std::sin(a), 0.3f * std::cos(1.7f * a), 0) - from)};
}

/// A ray to a plane of glass at y = 0, and what is behind.
mir::Ray down(float x) { return {{x, 1, 0.2f}, glm::normalize(Vec3(0.2f - x, -1, 0))}; }

}  // namespace

TEST_CASE("under a constant sky a ball of clear glass is not seen") {
    mir::Scene s;
    s.place(mir::builtin::sphere("ball", s.add(glass(false)), {0, 0, 0}, 1.0f, 40, 20));
    s.environment = mirtest::constant_sky({1, 1, 1});
    const Seen seen(s);
    double sum = 0.0;
    int lost = 0;
    for (int i = 0; i < 2000; ++i) {
        const Rgb light = seen.radiance(fan(i, {0, 0.2f, 4}));
        if (is_black(light))
            ++lost;
        else
            REQUIRE(light.g == Approx(1.0f).epsilon(1e-4));
        sum += static_cast<double>(light.g);
    }
    CHECK(lost <= 2);
    CHECK(sum / 2000 == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("light through a closed slab keeps its radiance, and inside has the index squared") {
    mir::Scene s;
    const std::uint32_t m = s.add(glass(false, 1.33f));
    s.place(mir::builtin::box("water", m, {-50, -1, -50}, {100, 0, 0}, {0, 1, 0}, {0, 0, 100}));
    s.environment = mirtest::constant_sky({1, 1, 1});
    mir::Material bottom = mir::lambertian("bottom", {0.5f, 0.5f, 0.5f});
    mir::Scene pool = s;
    pool.place(
        mir::builtin::quad("bottom", pool.add(bottom), {-40, -0.5f, 40}, {80, 0, 0}, {0, 0, -80}));
    const Seen through(s);
    const Seen into(pool);
    int reflected = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const float x = 0.01f * static_cast<float>(i);
        for (const Transport t : {Transport::radiance, Transport::power})
            CHECK(through.followed(down(x), t, i).light.g == Approx(1.0f).epsilon(1e-4));
        const mir::SpecularEnd end = into.followed(down(x), Transport::radiance, i);
        if (end.is_background) {
            ++reflected;
            continue;
        }
        CHECK(end.reflection.g == Approx(1.0f / (1.33f * 1.33f)).epsilon(1e-4));
        CHECK(into.followed(down(x), Transport::power, i).reflection.g ==
              Approx(1.0f).epsilon(1e-4));
    }
    CHECK(reflected > 0);
    CHECK(reflected < 40);
}

TEST_CASE("a body takes its colour by the way through it") {
    mir::Scene s;
    mir::Material m = glass(false, 1.0f);
    m.attenuation_color = {0.5f, 0.25f, 1.0f};
    m.attenuation_distance = 2.0f;
    s.place(mir::builtin::box("slab", s.add(m), {-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}));
    s.environment = mirtest::constant_sky({1, 1, 1});
    const Rgb light = Seen(s).radiance({{0.1f, 0.2f, 4}, {0, 0, -1}});
    CHECK(light.r == Approx(0.5f).epsilon(1e-4));
    CHECK(light.g == Approx(0.25f).epsilon(1e-4));
    CHECK(light.b == Approx(1.0f).epsilon(1e-4));
}

TEST_CASE("a mirror at 45 degrees shows the unfolded room") {
    // The mirror is the plane x = z; it swaps x and z.
    const auto ball = [](mir::Scene& s, Vec3 at) {
        s.place(mir::builtin::sphere("ball", s.add(mir::lambertian("b", {0.5f, 0.5f, 0.5f})), at,
                                     0.6f, 20, 10));
    };
    mir::Scene folded;
    folded.place(
        mir::builtin::quad("mirror", folded.add(mirror()), {-2, -2, -2}, {4, 0, 4}, {0, 4, 0}));
    mir::Scene unfolded = mir::Scene{};
    ball(folded, {-3, 0.1f, 0.2f});
    ball(unfolded, {0.2f, 0.1f, -3});
    const Seen a(folded);
    const Seen b(unfolded);
    int met = 0;
    for (int i = 0; i < 300; ++i) {
        const mir::Ray ray = fan(i, {0.1f, 0, 5});
        const mir::SeenLuxel here = a.tracer()(ray);
        const mir::SeenLuxel there = b.tracer()(ray);
        if (here.is_background || there.is_background) continue;
        ++met;
        const Vec3 p = there.point.position;
        // Facets differ where both spheres are tessellated from their poles alike, but turned.
        CHECK(glm::length(Vec3(p.z, p.y, p.x) - here.point.position) < 0.12f);
        CHECK(here.events == 1);
        CHECK(here.light == Rgb{1, 1, 1});
        CHECK(here.before + glm::length(here.point.position - here.ray.origin) ==
              Approx(glm::length(p - ray.origin)).epsilon(0.05));
    }
    CHECK(met > 50);
}

TEST_CASE("a pane that changes nothing changes no bit of what is seen") {
    mir::Scene s;
    s.place(mir::builtin::sphere("ball", s.add(mir::lambertian("b", {0.5f, 0.5f, 0.5f})), {0, 0, 0},
                                 1.0f, 20, 10));
    // The size of a scene decides how far points are lifted: the pane must not make it larger.
    for (const float y : {-3.0f, 3.0f})
        s.place(mir::builtin::quad("plate", 0, {-3, y, 2}, {6, 0, 0}, {0, 0, -5}));
    s.environment = mirtest::constant_sky({1, 1, 1});
    mir::Scene behind_pane = s;
    behind_pane.place(mir::builtin::quad("pane", behind_pane.add(glass(true, 1.0f)), {-3, -3, 2},
                                         {6, 0, 0}, {0, 6, 0}));
    const Seen a(s);
    const Seen b(behind_pane);
    for (int i = 0; i < 300; ++i) {
        const mir::SeenLuxel here = a.tracer()(fan(i, {0, 0.2f, 4}));
        const mir::SeenLuxel there = b.tracer()(fan(i, {0, 0.2f, 4}));
        REQUIRE(here.is_background == there.is_background);
        REQUIRE(there.events == 0);
        REQUIRE(here.point.position == there.point.position);
        const Vec3 lamp(1, 3, 5);
        REQUIRE(a.tree.visibility().visible(lamp, here.point.position + here.point.offset) ==
                b.tree.visibility().visible(lamp, here.point.position + here.point.offset));
    }
}

TEST_CASE("between two mirrors each bounce has its reflectance") {
    mir::Scene s;
    mir::Material m = mirror();
    m.base_color = {0.5f, 0.5f, 0.5f};
    const std::uint32_t grey = s.add(m);
    s.place(mir::builtin::quad("left", grey, {-1, -9, 9}, {0, 0, -18}, {0, 18, 0}));
    s.place(mir::builtin::quad("right", grey, {1, -9, -9}, {0, 0, 18}, {0, 18, 0}));
    s.environment = mirtest::constant_sky({1, 1, 1});
    const Seen seen(s);
    // Up by a quarter a bounce: out of 9 m after some 18 of them; Schlick's term is 0.5 to a
    // little.
    const mir::Ray steep{{0, 7.4f, 0}, glm::normalize(Vec3(1, 0.5f, 0))};
    const float cosine = steep.direction.x;
    const float reflectance = 0.5f + 0.5f * std::pow(1.0f - cosine, 5.0f);
    CHECK(seen.tracer()(steep).events == 2);
    CHECK(seen.radiance(steep).g == Approx(reflectance * reflectance).epsilon(1e-4));
}

TEST_CASE("models that know no chains see glass and mirrors as surfaces") {
    mir::Scene s;
    s.place(mir::builtin::quad("mirror", s.add(mirror()), {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}));
    const Seen<CookTorrance> chained(s);
    CHECK(chained.tracer()(fan(1, {0, 0, 4})).is_background);
    const Seen<Lambert> matte(s);
    CHECK_FALSE(matte.tracer()(fan(1, {0, 0, 4})).is_background);
}

TEST_CASE("decay is the exponential function") {
    for (float x = 0.0f; x < 87.0f; x += 0.0371f)
        REQUIRE(mir::decay(x) == Approx(std::exp(-static_cast<double>(x))).epsilon(1.2e-7));
    CHECK(mir::decay(0.0f) == 1.0f);
    CHECK(mir::decay(1e30f) == 0.0f);
    CHECK(mir::decay(NAN) == 0.0f);
}
