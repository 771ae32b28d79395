// SPDX-License-Identifier: MIT
//
// mir's checks, run on the renderer's own types.
#pragma once

#include "mir_adapter.hpp"
#include "spectral_renderer.hpp"

#include <mir/concepts/bsdf.hpp>
#include <mir/core/frame.hpp>
#include <mir/core/warp.hpp>
#include <mir/cpu/embree_visibility.hpp>
#include <mir/validation/bsdf.hpp>
#include <mir/validation/bsdf_samples.hpp>
#include <mir/validation/shading.hpp>
#include <mir/validation/visibility.hpp>

namespace offline {

/// The first three wavelengths of a Material as a model of mir::Bsdf: the three are alike.
struct ThreeWavelengths {
    using Params = Material;

    static mir::Rgb eval(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        if (!reflects(p, n, wo)) return {};
        const float factor = lobe_factor(p.lobe, glm::dot(n, wi), glm::dot(n, wo)) / pi;
        return albedo(p, n, wo) * factor;
    }
    /// Below the normal only what has no lobe does.
    static bool reflects(const Params& p, mir::Vec3 n, mir::Vec3 wo) {
        return p.lobe == 0.0f || glm::dot(n, wo) > 0.0f;
    }
    static float pdf(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        return reflects(p, n, wo) ? mir::cosine_hemisphere_pdf(glm::dot(n, wi)) : 0.0f;
    }
    static mir::BsdfSample sample(const Params& p, mir::Vec3 n, mir::Vec3 wo, mir::Vec2 u, float) {
        const mir::Vec3 wi = mir::Frame::around(n).to_world(mir::square_to_cosine_hemisphere(u));
        return {wi, eval(p, n, wi, wo) * pi, pdf(p, n, wi, wo)};
    }
    static mir::Rgb albedo(const Params& p, mir::Vec3, mir::Vec3) {
        return {p.reflectance[0], p.reflectance[1], p.reflectance[2]};
    }
    static bool is_black(const Params& p) { return mir::is_black(albedo(p, {}, {})); }
};
static_assert(mir::Bsdf<ThreeWavelengths>);

/// Materials with the strongest lobes that stay positive, either way, and with none.
inline mir::validation::Report check_reflection() {
    const std::vector<Material> materials{
        {{1, 1, 1}, 4.5f}, {{0.2f, 0.5f, 1.0f}, -2.2f}, {{0.5f, 0.5f, 0.5f}, 0}, {{0, 0, 0}, 1}};
    mir::validation::Report report = mir::validation::check_bsdf<ThreeWavelengths>(materials);
    report.add("samples",
               mir::validation::check_bsdf_samples<ThreeWavelengths>(materials[1], 0.5f));
    return report;
}

// region: shading
/// What a light adds to a surface against J f cos cos / d^2, three wavelengths at a time.
inline mir::validation::Report check_shading() {
    const Material material{{0.2f, 0.5f, 1.0f, 0.9f, 0.4f, 0.1f}, -1.5f};
    return mir::validation::check_shading(
        SpectralShading{0},
        [&](mir::Vec3 normal, mir::Vec3 wo) {
            return SpectralShading::Surface{normal, wo, {}, {material.reflectance, material.lobe}};
        },
        [&](mir::Vec3 normal, mir::Vec3 wi, mir::Vec3 wo) {
            return ThreeWavelengths::eval(material, normal, wi, wo);
        });
}
// endregion: shading

/// Embree's answers against brute force over the triangles of the quads.
inline mir::validation::Report check_embree(const World& world) {
    mir::Mesh mesh;
    for (const Quad& q : world.quads()) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {q.p, q.p + q.a, q.p + q.a + q.b, q.p + q.b});
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 2, first + 3});
    }
    mir::Scene scene;
    mesh.material = scene.add(mir::lambertian("any", {0.5f, 0.5f, 0.5f}));
    scene.place(mesh);
    return mir::validation::check_visibility(mir::cpu::EmbreeVisibility{world.scene()},
                                             mir::WorldGeometry(scene));
}

}  // namespace offline
