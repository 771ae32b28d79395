// SPDX-License-Identifier: MIT
#include "mir/shading/next_surface.hpp"

#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/paths/path_world.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/surface_table.hpp"
#include "support/catch.hpp"
#include "support/kd_lab.hpp"

#include <algorithm>
#include <vector>

namespace {

using mir::CookTorrance;
using mir::Vec3;

/// Finds what a kd-tree finds, and keeps the triangles.
struct Remembering {
    decltype(std::declval<const mir::KdTreeScene&>().ray_caster()) caster;
    std::vector<std::uint32_t>* met;

    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(const mir::Ray& ray) const {
        const auto point = caster.closest_hit(ray);
        if (point) met->push_back(point->triangle);
        return point;
    }
};

/// A ball of a veil that covers next to nothing.
struct Veil : mirtest::KdLab {
    Veil() : KdLab(ball()) {}

    static mir::Scene ball() {
        mir::Scene s;
        mir::Material veil = mir::lambertian("veil", {0.5f, 0.5f, 0.5f});
        veil.is_blended = true;
        veil.alpha = 1e-4f;
        s.place(mir::builtin::sphere("ball", s.add(veil), {0, 0, 0}, 1.0f, 24, 12));
        s.cameras.push_back({});
        return s;
    }
    /// A ray that touches the middle of an edge, as good as along it or across.
    [[nodiscard]] mir::Ray touching(mir::Random& random) const {
        const auto view = geometry.view();
        const auto t = static_cast<std::uint32_t>(random.next() *
                                                  static_cast<float>(geometry.triangles().size()));
        const Vec3 a = view.corner(t, 0);
        const Vec3 b = view.corner(t, 1);
        const Vec3 place = a + random.next() * (b - a);
        const Vec3 out = glm::normalize(place);
        const Vec3 other = glm::cross(out, Vec3(random.next(), random.next(), random.next()));
        const Vec3 along = glm::normalize(other);
        return {place + 1e-6f * (random.next() - 0.5f) * out - 3.0f * along, along};
    }
};

}  // namespace

TEST_CASE("rays that touch the edge of a veiled ball pass no triangle twice") {
    const Veil veil;
    std::vector<std::uint32_t> met;
    const Remembering caster{veil.tree.ray_caster(), &met};
    const mir::SpecularTracer chain{caster, veil.surfaces.view()};
    const mir::PathWorld world{veil.geometry,          veil.lights,          veil.surfaces, caster,
                               veil.tree.visibility(), veil.scene.cameras[0]};
    const auto is_once = [&met] {
        std::sort(met.begin(), met.end());
        return std::adjacent_find(met.begin(), met.end()) == met.end();
    };
    int chains = 0;
    int paths = 0;
    int passed = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        mir::Random random(940, mir::Stream::test, i);
        mir::SpecularEnd end;
        end.ray = veil.touching(random);
        met.clear();
        end.is_background = !find_point(caster, end.ray, end.point);
        chain.follow(end, mir::Transport::radiance, random);
        passed += end.events > 0 ? 1 : 0;
        chains += is_once() ? 0 : 1;
        met.clear();
        mir::PathVertex vertex;
        (void)world.hit(veil.touching(random), vertex);
        paths += is_once() ? 0 : 1;
    }
    CHECK(chains == 0);
    CHECK(paths == 0);
    CHECK(passed > 1000);
}
