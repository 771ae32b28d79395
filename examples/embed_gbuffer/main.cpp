// SPDX-License-Identifier: MIT
//
// embed_gbuffer [PICTURE.png]
//
// A rasteriser gets indirect light from mir: its triangles once, virtual point lights once, then
// for each frame its G-buffer where it lies. It keeps its direct light. Writes the second frame.
#include "gbuffer_view.hpp"

#include <mir/accel/kd/kd_tree_scene.hpp>
#include <mir/fill_gbuffer.hpp>
#include <mir/io/png.hpp>
#include <mir/reconstruct.hpp>
#include <mir/sampling/instant_radiosity_sampler.hpp>
#include <mir/sched/cpu.hpp>
#include <mir/shading/vpl_shading.hpp>
#include <mir/validation/gbuffer.hpp>

#include <exception>
#include <iostream>
#include <stdexcept>

namespace {

using Bsdf = mir::CookTorrance;

constexpr std::uint32_t width = 132;  // tiles and blocks do not divide it
constexpr std::uint32_t height = 99;
constexpr glm::vec3 lamp{0.3f, 1.7f, 0.2f};
constexpr float lamp_intensity = 3.0f;  ///< W sr^-1

/// A room without front wall, a red and a green side, and a block of rough metal.
engine::World make_world() {
    engine::World w;
    w.materials = {{{0.7f, 0.7f, 0.7f}, 0.9f, 0.0f},
                   {{0.6f, 0.1f, 0.1f}, 0.9f, 0.0f},
                   {{0.1f, 0.5f, 0.1f}, 0.9f, 0.0f},
                   {{0.9f, 0.7f, 0.4f}, 0.5f, 1.0f}};
    w.add_quad(0, {-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    w.add_quad(0, {-1, 2, -1}, {2, 0, 0}, {0, 0, 2});
    w.add_quad(0, {-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
    w.add_quad(1, {-1, 0, 1}, {0, 0, -2}, {0, 2, 0});
    w.add_quad(2, {1, 0, -1}, {0, 0, 2}, {0, 2, 0});
    const glm::vec3 p(-0.5f, 0, -0.2f);
    const glm::vec3 a(0.6f, 0, 0.2f);
    const glm::vec3 b(0, 0.8f, 0);
    const glm::vec3 c(0.2f, 0, -0.6f);
    w.add_quad(3, p, a, b);
    w.add_quad(3, p + a, c, b);
    w.add_quad(3, p + a + c, -a, b);
    w.add_quad(3, p + c, -c, b);
    w.add_quad(3, p + b, a, c);
    return w;
}

// region: hand over
/// The engine's triangles, materials and lamp: handed over once.
mir::Scene to_mir(const engine::World& world) {
    mir::Scene scene;
    for (const engine::Material& m : world.materials) {
        mir::Material to;
        to.base_color = {m.albedo.x, m.albedo.y, m.albedo.z};
        to.roughness = m.roughness;
        to.metallic = m.metallic;
        mir::Mesh mesh;
        mesh.material = scene.add(to);
        scene.place(mesh);
    }
    for (const engine::Triangle& t : world.triangles) {
        mir::Mesh& mesh = scene.meshes[t.material];
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), t.corner, t.corner + 3);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    scene.point_lights.push_back({"lamp", lamp, {lamp_intensity, lamp_intensity, lamp_intensity}});
    return scene;
}
// endregion: hand over

/// What stays as long as the geometry does.
struct Light {
    explicit Light(const engine::World& world)
        : scene(to_mir(world)),
          geometry(scene),
          lights(scene, geometry),
          surfaces(scene),
          tree(geometry) {}

    mir::Scene scene;
    mir::WorldGeometry geometry;
    mir::LightTable lights;
    mir::SurfaceTable<Bsdf> surfaces;
    mir::KdTreeScene tree;
};

constexpr mir::VplShading<Bsdf> shading{.bound = 10.0f};

// region: sample
/// Without VPLs on lamps, light that was reflected once or more is all there is.
mir::VplList sample_once(const Light& light) {
    mir::InlineExecutor executor;
    using Caster = decltype(light.tree.ray_caster());
    const mir::InstantRadiositySampler<Bsdf, Caster> sampler(
        {light.geometry, light.lights, light.surfaces, light.tree.ray_caster()},
        {.vpls = 192, .emitter_vpls = false, .seed = 3});
    return aggregate(sampler.sample(executor));
}
// endregion: sample

// region: frame
/// Indirect light of a frame, W m^-2 sr^-1, from the engine's own G-buffer.
mir::Image<mir::Rgb> indirect_light(const Light& light, const mir::VplList& vpls,
                                    const engine::GBuffer& image, const engine::Camera& camera) {
    mir::InlineExecutor executor;
    const engine::ImageView luxels(image, camera.eye, light.geometry.ray_offset());
    return reconstruct(mir::sched::Cpu{executor}, luxels, vpls.span(), light.tree.visibility(),
                       shading);
}
// endregion: frame

/// mir's checks of the view: luxels are where the engine has them, row by row.
void check_view(const engine::World& world) {
    const auto camera = engine::Camera::look_at({0, 1, 3.4f}, {0, 0.9f, 0}, 0.45f);
    const engine::GBuffer image = draw(world, camera, width, height);
    const auto expected = [&](std::uint32_t x, std::uint32_t y) {
        engine::GeometryPixel g;
        std::memcpy(&g, image.geometry.pixel(x, y), sizeof g);
        if (g.normal == 0) return mir::Hit{};
        return mir::Hit{{g.position[0], g.position[1], g.position[2]},
                        engine::unpack_normal(g.normal)};
    };
    const mir::validation::Report report =
        mir::validation::check_gbuffer(engine::ImageView(image, camera.eye, 0.0f), expected);
    if (!report.passed()) throw std::runtime_error(report.text());
    std::cout << report.checks() << " checks of the G-buffer passed\n";
}

/// The engine's direct light; its shadows are segments through the tree that mir has anyway.
mir::Image<mir::Rgb> direct_light(const Light& light, const engine::GBuffer& image,
                                  const engine::Camera& camera) {
    const engine::ImageView luxels(image, camera.eye, light.geometry.ray_offset());
    mir::Image<mir::Rgb> out(luxels.extent());
    for (mir::TileIndex t = 0; t < luxels.tiles().size(); ++t) {
        const mir::Tile tile = luxels.tiles()[t];
        for (mir::LuxelIndex i = 0; i < luxels.view(t).size(); ++i) {
            const mir::Hit hit = luxels.view(t).hit(i);
            const mir::Vec3 d = lamp - hit.position;
            const float cosine = glm::dot(glm::normalize(d), hit.normal);
            if (mir::is_empty(hit) || cosine <= 0.0f) continue;
            if (!light.tree.visibility().visible(lamp, hit.position)) continue;
            const auto s = luxels.view(t).surface(i);
            const auto at = mir::BlockedLayout::of(tile).place(i);
            out(tile.x + at.x, tile.y + at.y) =
                Bsdf::eval(s.bsdf, s.normal, glm::normalize(d), s.wo) *
                (lamp_intensity * cosine / mir::length_squared(d));
        }
    }
    return out;
}

/// The same light by mir alone: camera rays in place of the rasteriser, no number packed.
mir::Image<mir::Rgb> by_mir_alone(const Light& light, const mir::VplList& vpls,
                                  const engine::GBuffer& image, const engine::Camera& camera) {
    mir::InlineExecutor executor;
    mir::BlockedGBuffer<Bsdf::Params> luxels({width, height}, {64, 64});
    const auto rays = [&](std::uint32_t x, std::uint32_t y) {
        return mir::Ray{camera.eye, glm::normalize(through_pixel(camera, image, x, y))};
    };
    fill_gbuffer(luxels, 0, rays, light.tree.ray_caster(), light.surfaces, executor);
    return reconstruct(mir::sched::Cpu{executor}, luxels, vpls.span(), light.tree.visibility(),
                       shading);
}

double mean(const mir::Image<mir::Rgb>& image) {
    double sum = 0.0;
    for (const mir::Rgb& c : image.pixels()) sum += static_cast<double>(luminance(c));
    return sum / static_cast<double>(image.pixels().size());
}

double mean_difference(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        sum += std::fabs(static_cast<double>(luminance(a.pixels()[i])) -
                         static_cast<double>(luminance(b.pixels()[i])));
    return sum / static_cast<double>(a.pixels().size());
}

/// Draws, lights and puts a frame together; checks that what came back is right.
mir::Image<mir::Rgb> frame(const engine::World& world, const Light& light, const mir::VplList& vpls,
                           const engine::Camera& camera) {
    const engine::GBuffer image = draw(world, camera, width, height);
    const mir::Image<mir::Rgb> direct = direct_light(light, image, camera);
    const mir::Image<mir::Rgb> indirect = indirect_light(light, vpls, image, camera);
    const mir::Image<mir::Rgb> wanted = by_mir_alone(light, vpls, image, camera);
    const double error = mean_difference(indirect, wanted) / mean(wanted);
    std::cout << "direct " << mean(direct) << ", indirect " << mean(indirect)
              << " W/(m^2 sr); off by " << 100.0 * error << " % from mir alone\n";
    if (!(error < 0.01)) throw std::runtime_error("the indirect light is wrong");

    mir::Image<mir::Rgb> sum = direct;
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += indirect.pixels()[i];
    return sum;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const engine::World world = make_world();
        check_view(world);
        const Light light(world);
        const mir::VplList vpls = sample_once(light);
        for (const mir::PathVpl& p : vpls.path_vpls())
            if (p.bounce < 2) throw std::runtime_error("a VPL brings direct light");
        std::cout << vpls.size() << " VPLs for two frames\n";

        frame(world, light, vpls, engine::Camera::look_at({0, 1, 3.4f}, {0, 0.9f, 0}, 0.45f));
        const mir::Image<mir::Rgb> second = frame(
            world, light, vpls, engine::Camera::look_at({0.7f, 1.3f, 3.0f}, {0, 0.8f, 0}, 0.5f));
        if (argc > 1) mir::write_png(argv[1], second);
    } catch (const std::exception& e) {
        std::cerr << "embed_gbuffer: " << e.what() << '\n';
        return 1;
    }
}
