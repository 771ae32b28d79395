// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/masked_soup.hpp"
#include "conformance/packet_suite.hpp"
#include "conformance/passes.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "mir/validation/visibility.hpp"

// Surfaces that are seen through hide what crossing_number() says, from every engine, and are there
// for every closest hit.

namespace mirtest {

/// The same materials, all of what holes leave opaque.
inline std::vector<mir::Material> without_see_through(std::vector<mir::Material> materials) {
    for (mir::Material& m : materials) {
        m.transmission = 0.0f;
        m.is_blended = false;
    }
    return materials;
}

/// A pane that lets all light through, whatever the angle.
inline mir::Material clear_pane() {
    mir::Material pane = mir::lambertian("pane", {1, 1, 1});
    pane.specular = 1.0f;
    pane.roughness = 0.0f;
    pane.ior = 1.0f;
    pane.transmission = 1.0f;
    return pane;
}

/// Segments of which the engines of two worlds say different things.
template <class Engine>
std::size_t differences(const World& first, const World& second, std::size_t count) {
    const Engine one(first.geometry);
    const Engine other(second.geometry);
    std::size_t different = 0;
    for (const auto& s : mir::validation::random_segments(first.geometry, count, 90))
        different +=
            one.visibility().visible(s.a, s.b) != other.visibility().visible(s.a, s.b) ? 1 : 0;
    return different;
}

/// triangle_soup() whose first half is opaque, the second of `material`, or missing.
inline World soup_behind(const mir::Material* material) {
    World whole = masked_soup(120, 91, {masked(1.0f, 0.0f), masked(1.0f, 0.0f)});
    mir::Scene scene = whole.scene;
    if (material != nullptr)
        scene.materials[1] = *material;
    else
        // Triangles without area are left out, and the bounds stay as they are.
        for (mir::Mesh& mesh : scene.meshes)
            if (mesh.material == 1) mesh.triangles[0] = {0, 0, 0};
    return World(std::move(scene));
}

template <class Engine>
void see_through_suite() {
    const World world = masked_soup(200, 88, see_through_materials());
    const Engine engine(world.geometry);
    SECTION("segments and packets meet what brute force meets") {
        passes(mir::validation::check_visibility(engine.visibility(), world.geometry));
        const Referee referee(world.geometry);
        const PacketCount far = scattered_packets(engine.visibility(), referee, 500);
        const PacketCount near = coherent_packets(engine.visibility(), referee, 500);
        CHECK(far.sure_and_different == 0);
        CHECK(near.sure_and_different == 0);
        CHECK((far.different + near.different) * 10000 <= far.lanes + near.lanes);
    }
    SECTION("closest hits do not look through") {
        const World whole = masked_soup(200, 88, without_see_through(see_through_materials()));
        const Engine opaque(whole.geometry);
        std::size_t met = 0;
        for (const mir::Ray& ray : random_rays(4000, 89)) {
            const auto a = engine.ray_caster().closest_hit(ray);
            const auto b = opaque.ray_caster().closest_hit(ray);
            REQUIRE(a.has_value() == b.has_value());
            if (!a) continue;
            ++met;
            REQUIRE(a->triangle == b->triangle);
            REQUIRE(a->position == b->position);
        }
        CHECK(met > 500);
    }
    SECTION("a clear pane hides nothing, an opaque one all") {
        const World missing = soup_behind(nullptr);
        const World opaque = soup_behind(world.scene.materials.data());
        CHECK(differences<Engine>(missing, opaque, 4000) > 200);
        const mir::Material pane = clear_pane();
        CHECK(differences<Engine>(missing, soup_behind(&pane), 4000) == 0);
        mir::Material covered = world.scene.materials[0];
        covered.is_blended = true;
        CHECK(differences<Engine>(opaque, soup_behind(&covered), 4000) == 0);
        mir::Material none = pane;
        none.transmission = 0x1p-30f;
        CHECK(differences<Engine>(opaque, soup_behind(&none), 4000) == 0);
    }
}

}  // namespace mirtest
