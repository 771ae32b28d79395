// SPDX-License-Identifier: MIT
#include "reference.hpp"

#include "mir/cpu/embree_scene.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/io/exr.hpp"
#include "mir/reference/trace_reference.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"

#include <cstdio>

namespace mirconvergence {
namespace {

/// Independent images of which the variance of their mean is computed.
constexpr std::uint32_t replicates = 16;

constexpr const char* variance_layer = "variance";

/// Indirect light of an image of one replicate at a pixel.
mir::RgbSum indirect_at(const mir::ReferenceImage& image, std::uint32_t x, std::uint32_t y) {
    mir::RgbSum sum = image.beauty_moments(x, y).mean;
    for (std::uint8_t b = 0; b <= image.last_bounce(); ++b)
        sum += image.bounce_moments(x, y, b).mean * -1.0;
    return sum;
}

/// Mean colour and moments of the luminance of each pixel over replicates.
class ReplicateMean {
 public:
    explicit ReplicateMean(mir::Extent size) : sums_(size), luminance_(size) {}

    void add(const mir::ReferenceImage& image) {
        for (std::uint32_t y = 0; y < sums_.height(); ++y)
            for (std::uint32_t x = 0; x < sums_.width(); ++x) {
                const mir::RgbSum light = indirect_at(image, x, y);
                const double grey = mir::luminance(light.rgb());
                sums_(x, y) += light;
                luminance_(x, y).add({{grey, grey, grey}}, count_);
            }
        ++count_;
    }

    [[nodiscard]] Reference reference() const {
        Reference out{mir::Image<mir::Rgb>(sums_.extent()), mir::Image<float>(sums_.extent())};
        for (std::size_t i = 0; i < sums_.pixels().size(); ++i) {
            out.indirect.pixels()[i] = (sums_.pixels()[i] * (1.0 / count_)).rgb();
            out.variance.pixels()[i] = luminance_.pixels()[i].variance_of_mean(count_).rgb().r;
        }
        return out;
    }

 private:
    mir::Image<mir::RgbSum> sums_;
    mir::Image<mir::RgbMoments> luminance_;
    std::uint32_t count_ = 0;
};

template <mir::Bsdf B>
Reference trace(const mir::Scene& scene, const ReferenceSettings& settings) {
    const mir::WorldGeometry geometry(scene);
    const mir::cpu::EmbreeScene engine(geometry);
    const mir::LightTable lights(scene, geometry);
    const mir::SurfaceTable<B> surfaces(scene);
    using Tracer = mir::PathTracer<B, mir::cpu::EmbreeRayCaster, mir::cpu::EmbreeVisibility>;
    const Tracer tracer({geometry, lights, surfaces, engine.ray_caster(), engine.visibility()}, {});
    const mir::CameraRays rays{scene.cameras.front(), mir::luxel_grid(settings.size, 1), 0};
    mir::ReferenceOptions options;
    options.samples = (settings.samples + replicates - 1) / replicates;
    options.replicates = 1;
    options.last_bounce = 1;
    mir::TbbExecutor executor(settings.threads);
    ReplicateMean mean(settings.size);
    for (std::uint32_t r = 0; r < replicates; ++r) {
        std::fprintf(stderr, "%s: reference, part %u of %u\n", scene.name.c_str(), r + 1,
                     replicates);
        options.first_replicate = r;
        mean.add(mir::trace_reference(tracer, rays, options, executor));
    }
    return mean.reference();
}

std::filesystem::path file_of(const mir::Scene& scene, const ReferenceSettings& settings) {
    return mir::SceneHash(scene).hex() + "-" + std::to_string(settings.size.width) + "x" +
           std::to_string(settings.size.height) + "-" + std::to_string(settings.samples) + ".exr";
}

Reference read(const std::filesystem::path& path) {
    Reference r{mir::read_exr(path).image, {}};
    const mir::Image<mir::Rgb> variance = mir::read_exr(path, variance_layer).image;
    r.variance = mir::Image<float>(variance.extent());
    for (std::size_t i = 0; i < variance.pixels().size(); ++i)
        r.variance.pixels()[i] = variance.pixels()[i].r;
    return r;
}

void write(const std::filesystem::path& path, const Reference& r) {
    std::error_code failure;
    std::filesystem::create_directories(path.parent_path(), failure);
    if (failure)
        throw mir::Error(mir::ErrorCode::io,
                         path.parent_path().string() + ": the folder cannot be made (" +
                             failure.message() + "); choose another for --cache");
    mir::write_exr(
        path, r.indirect.extent(),
        {{"", &r.indirect},
         {variance_layer, &r.variance, mir::ExrPrecision::single, mir::ExrScalar::luminance}});
}

}  // namespace

Reference trace_reference(const mir::Scene& scene, const ReferenceSettings& settings) {
    return mir::is_lambertian(scene) ? trace<mir::Lambert>(scene, settings)
                                     : trace<mir::CookTorrance>(scene, settings);
}

Reference cached_reference(const mir::Scene& scene, const ReferenceSettings& settings,
                           const std::filesystem::path& folder) {
    if (folder.empty()) return trace_reference(scene, settings);
    const std::filesystem::path path = folder / file_of(scene, settings);
    if (std::filesystem::exists(path)) return read(path);
    Reference made = trace_reference(scene, settings);
    write(path, made);
    return made;
}

}  // namespace mirconvergence
