// SPDX-License-Identifier: MIT
#include "mir/host/tbb_executor.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/surface_table.hpp"
#include "parts.hpp"
#include "render.hpp"
#include "views.hpp"
#include "watch.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace nb = nanobind;

namespace mirpy {
namespace {

/// The model of all surfaces, as its parameters were before it made its own of them.
struct PlainFactors {
    using Params = mir::MaterialFactors;
    using Model = mir::CookTorrance;

    static mir::Rgb eval(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        return Model::eval(material_params(p, Model{}), n, wi, wo);
    }
    static float pdf(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        return Model::pdf(material_params(p, Model{}), n, wi, wo);
    }
    static mir::BsdfSample sample(const Params& p, mir::Vec3 n, mir::Vec3 wo, mir::Vec2 u,
                                  float lobe) {
        return Model::sample(material_params(p, Model{}), n, wo, u, lobe);
    }
    static mir::Rgb albedo(const Params& p, mir::Vec3 n, mir::Vec3 wo) {
        return Model::albedo(material_params(p, Model{}), n, wo);
    }
    static bool is_black(const Params& p) { return Model::is_black(material_params(p, Model{})); }
};

mir::MaterialFactors material_params(const mir::Material& m, PlainFactors) { return m.factors(); }
mir::MaterialFactors material_params(const mir::MaterialFactors& m, PlainFactors) { return m; }

/// What the middle of each pixel sees.
struct Images {
    explicit Images(mir::Extent e)
        : position(e),
          normal(e),
          shading_normal(e),
          view(e),
          albedo(e),
          emission(e),
          roughness(e),
          metallic(e),
          specular(e) {}

    mir::Image<mir::Vec3> position, normal, shading_normal, view;
    mir::Image<mir::Rgb> albedo, emission;
    mir::Image<float> roughness, metallic, specular;
};

/// Keeps what the ray of a pixel saw.
template <class Tracer>
void keep(Images& to, std::uint32_t x, std::uint32_t y, const Tracer& tracer,
          const mir::SeenLuxel& seen) {
    to.view(x, y) = -seen.ray.direction;
    if (seen.is_background) return;
    const auto surface = tracer.surface(seen);
    to.position(x, y) = seen.point.position;
    to.normal(x, y) = seen.point.geometric_normal;
    to.shading_normal(x, y) = surface.normal;
    to.albedo(x, y) = surface.bsdf.base_color;
    to.emission(x, y) = surface.emission;
    to.roughness(x, y) = surface.bsdf.roughness;
    to.metallic(x, y) = surface.bsdf.metallic;
    to.specular(x, y) = surface.bsdf.specular;
}

Images seen_by(const mir::Scene& scene, const mir::RenderSettings& settings,
               mir::Monitor& monitor) {
    const Tracing tracing(scene);
    const mir::SurfaceTable<PlainFactors> surfaces(scene);
    const mir::LuxelTracer tracer{tracing.tree.ray_caster(), surfaces.view()};
    const mir::Camera& camera = scene.cameras[settings.camera];
    const mir::Extent size = settings.image;
    Images images(size);
    mir::TbbExecutor threads(settings.threads);
    mir::CancellableExecutor executor(threads, &monitor);
    executor.for_each(size.height, [&](std::size_t row) {
        const auto y = static_cast<std::uint32_t>(row);
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const mir::Vec2 film((static_cast<float>(x) + 0.5f) / static_cast<float>(size.width),
                                 (static_cast<float>(y) + 0.5f) / static_cast<float>(size.height));
            keep(images, x, y, tracer, tracer(camera.ray(film, settings.aspect(), {0.5f, 0.5f})));
        }
    });
    return images;
}

nb::dict gbuffer(PyScene& scene, const std::vector<std::string>& words) {
    Job job(scene, words);
    Images images({0, 0});
    mir::Monitor monitor;
    watched(monitor, nb::none(), [&] {
        job.prepare();
        images = seen_by(job.scene(), job.options.settings, monitor);
    });
    nb::dict all;
    all["position"] = array_from(std::move(images.position));
    all["normal"] = array_from(std::move(images.normal));
    all["shading_normal"] = array_from(std::move(images.shading_normal));
    all["view"] = array_from(std::move(images.view));
    all["albedo"] = array_from(std::move(images.albedo));
    all["emission"] = array_from(std::move(images.emission));
    all["roughness"] = array_from(std::move(images.roughness));
    all["metallic"] = array_from(std::move(images.metallic));
    all["specular"] = array_from(std::move(images.specular));
    return all;
}

}  // namespace

void bind_gbuffer(nb::module_& m) {
    m.def("_gbuffer", gbuffer, nb::arg("scene"), nb::arg("words"));
}

}  // namespace mirpy
