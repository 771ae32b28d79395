// SPDX-License-Identifier: MIT
#include "scenes/car.hpp"

#include "mir/core/random.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/scene/world_geometry.hpp"
#include "scenes/car_panels.hpp"
#include "support/catch.hpp"
#include "support/mesh_measures.hpp"

#include <map>
#include <set>

namespace {

using mir::Mat4;
using mir::Mesh;
using mir::Scene;
using mir::Vec2;
using mir::Vec3;
using mirtest::Approx;
using namespace mir::builtin;

const Scene& car() {
    static const Scene scene = [] {
        Scene s;
        s.name = "car alone";
        place_car(s, Mat4(1.0f));
        return s;
    }();
    return scene;
}

template <class Hull>
void check_core(const Core& core, const Hull& hull, float low, float high) {
    mir::Random random(5, mir::Stream::test, 0);
    for (int i = 0; i < 2000; ++i) {
        const Vec2 u = random.next_2d();
        const Vec2 ab(core.nose() + u.x * 2.0f * (core.tail() - core.nose()),
                      low + u.y * (high - low));
        const auto [origin, direction] = core.ray(ab);
        CAPTURE(ab.x, ab.y);
        REQUIRE(glm::length(direction) == Approx(1.0f).epsilon(1e-5));
        REQUIRE(hull(origin) < 0.0f);
        REQUIRE(std::fabs(hull(surface_along(hull, origin, direction))) < 1e-5f);
    }
}

}  // namespace

TEST_CASE("every ray of a core starts inside its hull and ends on it") {
    check_core(lower_core, LowerHull{}, 0.15f, lower_core.above());
    check_core(cabin_core, CabinHull{}, 0.86f, cabin_core.above());
}

TEST_CASE("rays of a core turn without jumps, all the way round") {
    const Core& core = lower_core;
    const float step = 1e-3f;
    for (float a = core.nose(); a < 2.0f * core.tail() - core.nose() - step; a += step)
        for (const float b : {0.3f, core.top, core.above() - 0.1f}) {
            const auto here = core.ray({a, b});
            const auto next = core.ray({a + step, b});
            REQUIRE(glm::length(next[0] - here[0]) < 2.0f * step);
            REQUIRE(glm::length(next[1] - here[1]) < 4.0f * step);
        }
    const auto first = core.ray({core.nose(), 0.4f});
    const auto last = core.ray({2.0f * core.tail() - core.nose(), 0.4f});
    CHECK(glm::length(first[0] - last[0]) < 1e-5f);
}

TEST_CASE("the panel around a wheel arch keeps the arch free and fills its rectangle") {
    const float axle = 1.3f;
    const float height = car_wheel_height;
    for (const Rib& rib : around_arch(axle, 0.5f, 1.9f, 0.2f, 1.1f)) {
        const Vec2 low = rib.low - Vec2(axle, height);
        CHECK((rib.low.y < height ? std::fabs(low.x) : glm::length(low)) ==
              Approx(0.372f).epsilon(1e-4));
        const bool upright =
            std::fabs(rib.high.x - 0.5f) < 1e-4f || std::fabs(rib.high.x - 1.9f) < 1e-4f;
        CHECK((upright || std::fabs(rib.high.y - 1.1f) < 1e-4f));
    }
}

TEST_CASE("every part of the car is closed and turned outwards") {
    std::set<std::string> seen;
    for (const Mesh& m : car().meshes) {
        CAPTURE(m.name);
        CHECK(mirtest::volume(m) > 0.0);
        if (seen.insert(m.name).second) CHECK(mirtest::is_closed(m));
        CHECK((m.normals.empty() || m.normals.size() == m.positions.size()));
        bool unit = true;
        for (const Vec3 n : m.normals) unit = unit && std::fabs(glm::length(n) - 1.0f) < 1e-4f;
        CHECK(unit);
    }
    CHECK(seen.size() > 35);
}

TEST_CASE("the car has no triangle without area and stands on its wheels") {
    const mir::WorldGeometry geometry(car());
    CHECK(geometry.dropped_triangles() == 0);
    CHECK(std::fabs(geometry.bounds().low.y) < 2e-3f);
    const Vec3 size = geometry.bounds().high - geometry.bounds().low;
    CHECK(size.x > 1.8f);
    CHECK(size.x < 2.3f);
    CHECK(size.y > 1.3f);
    CHECK(size.y < 1.45f);
    CHECK(size.z > 4.3f);
    CHECK(size.z < 4.6f);
}

TEST_CASE("panels of the car lie on its hull and wheels stay inside their arches") {
    for (const Mesh& m : car().meshes) {
        CAPTURE(m.name);
        float nearest = 0.0f;
        if (m.name == "door" || m.name == "bonnet" || m.name == "front wing")
            for (const Vec3 p : m.positions) nearest = mir::larger(nearest, LowerHull{}(p));
        CHECK(nearest < 1e-5f);
        if (m.name != "tyre") continue;
        for (const Vec3 p : m.positions)
            REQUIRE(std::hypot(p.y - car_wheel_height, std::fabs(p.z) - car_axle) < 0.34f);
    }
}

TEST_CASE("the car is the same each time it is made") {
    Scene again;
    place_car(again, Mat4(1.0f));
    CHECK(mir::SceneHash(again).hex() == mir::SceneHash(car()).hex());
}
