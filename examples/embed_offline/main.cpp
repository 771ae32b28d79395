// SPDX-License-Identifier: MIT
//
// embed_offline [PICTURE.png]
//
// A spectral renderer on Embree lets mir gather the light of its own virtual point lights: first in
// a furnace, whose radiance is known, then in a room, of which it writes a picture.
#include "mir_adapter.hpp"
#include "self_check.hpp"

#include <mir/cpu/embree_visibility.hpp>
#include <mir/fill_visibility.hpp>
#include <mir/host/tbb_executor.hpp>
#include <mir/io/png.hpp>
#include <mir/reshade.hpp>
#include <mir/sched/cpu_blocks.hpp>

#include <exception>
#include <iostream>
#include <stdexcept>

namespace {

using offline::Quad;
using offline::Spectrum;

constexpr mir::Extent image_size{96, 72};
constexpr float lobe = 3.0f;

/// Six walls of a room of 2 m, and a block in it that hides parts of them from one another.
std::vector<Quad> room() {
    std::vector<Quad> quads{{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, {}, {}},  // floor
                            {{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, {}, {}},  // ceiling
                            {{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, {}, {}},  // back
                            {{1, 0, 1}, {-2, 0, 0}, {0, 2, 0}, {}, {}},   // front
                            {{-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, {}, {}},  // left
                            {{1, 0, -1}, {0, 0, 2}, {0, 2, 0}, {}, {}}};  // right
    const glm::vec3 p(-0.2f, 0.3f, -0.6f);
    const glm::vec3 a(0.5f, 0.1f, 0.2f);
    const glm::vec3 b(-0.1f, 0.7f, 0.0f);
    const glm::vec3 c = 0.5f * glm::normalize(glm::cross(a, b));
    for (const auto& [q, u, v] :
         {std::array{p, b, a}, {p, a, c}, {p, c, b}, {p + c, a, b}, {p + b, c, a}, {p + a, b, c}})
        quads.push_back({q, u, v, {}, {}});
    return quads;
}

/// Everything shines 1 - reflectance and reflects that much: the radiance is 1 everywhere.
std::vector<Quad> furnace() {
    std::vector<Quad> quads = room();
    for (Quad& quad : quads) {
        quad.material = {{0.7f, 0.6f, 0.5f, 0.4f, 0.3f, 0.2f}, lobe};
        for (std::size_t w = 0; w < 6; ++w) quad.radiance[w] = 1.0f - quad.material.reflectance[w];
    }
    return quads;
}

/// Grey walls, a blue and an orange one, a block with a lobe, and a lamp.
std::vector<Quad> lit_room() {
    std::vector<Quad> quads = room();
    for (std::size_t i = 0; i < quads.size(); ++i)
        quads[i].material = {{0.6f, 0.6f, 0.6f, 0.6f, 0.6f, 0.6f}, i < 6 ? 0.0f : lobe};
    quads[4].material.reflectance = {0.6f, 0.6f, 0.3f, 0.1f, 0.1f, 0.1f};
    quads[5].material.reflectance = {0.1f, 0.1f, 0.2f, 0.4f, 0.6f, 0.7f};
    quads.push_back({{-0.3f, 1.99f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}, {}, {6, 7, 8, 9, 10, 11}});
    return quads;
}

struct Camera {
    glm::vec3 eye{0.1f, 1.0f, 0.95f};

    [[nodiscard]] glm::vec3 direction(std::uint32_t x, std::uint32_t y) const {
        const auto height = static_cast<float>(image_size.height);
        const float across = static_cast<float>(x) + 0.5f - 0.5f * image_size.width;
        const float down = static_cast<float>(y) + 0.5f - 0.5f * height;
        return glm::normalize(glm::vec3(1.6f * across / height, -1.6f * down / height, -1.0f));
    }
};

using Picture = mir::Image<Spectrum>;
using Luxels = mir::BlockedGBuffer<offline::Reflection>;

/// The camera rays of the renderer: it fills the G-buffer and keeps what shines by itself.
Luxels see(const offline::World& world, Picture& emitted) {
    Luxels luxels(image_size, {32, 32});
    for (mir::TileIndex t = 0; t < luxels.tiles().size(); ++t) {
        const mir::Tile tile = luxels.tiles()[t];
        const auto layout = mir::BlockedLayout::of(tile);
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const Camera camera;
                const glm::vec3 ray = camera.direction(tile.x + x, tile.y + y);
                offline::Point at;
                if (!world.closest(camera.eye, ray, at)) continue;
                const offline::Material& m = at.quad->material;
                luxels.store(t, layout(x, y), {at.position, at.normal},
                             {at.normal, -ray, {}, {m.reflectance, m.lobe}});
                if (at.front) emitted(tile.x + x, tile.y + y) = at.quad->radiance;
            }
    }
    return luxels;
}

/// What the camera sees of `world`: rays once, then three wavelengths at a time.
Picture render(const offline::World& world, std::uint32_t paths) {
    Picture picture(image_size);
    const Luxels luxels = see(world, picture);
    const std::vector<offline::Light> lights = trace_lights(world, paths, 1);
    const auto three = [&](std::uint32_t first) {
        const auto count = static_cast<std::uint32_t>(lights.size());
        return offline::SpectralLights{lights.data(), count, first};
    };

    // region: bands
    mir::TbbExecutor cores;
    const mir::cpu::EmbreeVisibility visibility{
        world.scene()};  // reads the scene, never changes it
    mir::VisibilityMatrix bits(luxels.tiles(), three(0).size());
    fill_visibility(bits, luxels, three(0), visibility, cores);
    for (const std::uint32_t first : {0u, 3u}) {
        const mir::Image<mir::Rgb> sum = reshade(mir::sched::CpuBlocks{cores}, luxels, three(first),
                                                 bits, offline::SpectralShading{first});
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) {
            picture.pixels()[i][first] += sum.pixels()[i].r;
            picture.pixels()[i][first + 1] += sum.pixels()[i].g;
            picture.pixels()[i][first + 2] += sum.pixels()[i].b;
        }
    }
    // endregion: bands
    return picture;
}

/// Mean radiance of a wavelength over the picture.
double mean(const Picture& picture, std::size_t wavelength) {
    double sum = 0.0;
    for (const Spectrum& s : picture.pixels()) sum += static_cast<double>(s[wavelength]);
    return sum / static_cast<double>(picture.pixels().size());
}

void check_furnace() {
    const Picture picture = render(offline::World(furnace()), 1024);
    for (std::size_t w = 0; w < offline::wavelengths.size(); ++w) {
        const double found = mean(picture, w);
        std::cout << "furnace at " << offline::wavelengths[w] << " nm: " << found << " of 1\n";
        if (!(std::fabs(found - 1.0) < 0.03))
            throw std::runtime_error("the furnace has another radiance than 1");
    }
}

/// Ends the program when mir's checks find something.
void pass(const mir::validation::Report& report, const char* what) {
    if (!report.passed()) throw std::runtime_error(report.text());
    std::cout << report.checks() << " checks of " << what << " passed\n";
}

/// A preview: two wavelengths for each primary, not colorimetry.
mir::Image<mir::Rgb> preview(const Picture& picture) {
    mir::Image<mir::Rgb> out(picture.extent());
    for (std::size_t i = 0; i < out.pixels().size(); ++i) {
        const Spectrum& s = picture.pixels()[i];
        out.pixels()[i] = {0.5f * (s[4] + s[5]), 0.5f * (s[2] + s[3]), 0.5f * (s[0] + s[1])};
    }
    return out;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        pass(check_embree(offline::World(furnace())), "visibility");
        pass(offline::check_reflection(), "reflection");
        pass(offline::check_shading(), "shading");
        check_furnace();
        const auto picture = preview(render(offline::World(lit_room()), 512));
        if (argc > 1) mir::write_png(argv[1], picture);
    } catch (const std::exception& e) {
        std::cerr << "embed_offline: " << e.what() << '\n';
        return 1;
    }
}
