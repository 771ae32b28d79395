// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include "array_gbuffer.hpp"
#include "errors.hpp"
#include "gpu_parts.hpp"
#include "mir/core/limits.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/reconstruct.hpp"
#include "mir/runtime/any_executor.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "packed_bits.hpp"
#include "scene.hpp"
#include "segments.hpp"
#include "views.hpp"
#include "vpls.hpp"
#include "watch.hpp"

#include <nanobind/stl/optional.h>

#include <optional>

namespace nb = nanobind;

namespace mirpy {
namespace {

using Shading = mir::VplShading<mir::CookTorrance>;

/// Threads that a monitor stops.
struct Threads {
    Threads(unsigned count, mir::Monitor& monitor)
        : all(count), plain(all), watched(plain, &monitor) {}

    mir::TbbExecutor all;
    mir::AnyExecutor plain;
    mir::CancellableExecutor<mir::AnyExecutor> watched;
};

using HostGBuffer = GBufferArrays<FloatArray>;

HostGBuffer host_gbuffer(nb::handle mapping) {
    return {mapping,
            [](nb::handle value, const std::string& place, std::initializer_list<long> shape) {
                return FloatArray(value, place, shape, Numbers::single_floats);
            }};
}

nb::object visibility(PyScene& scene, nb::handle points, nb::handle normals, nb::handle targets,
                      nb::handle target_normals, unsigned threads) {
    if (gpu::holds(points)) return gpu::visibility(scene, points, normals, targets, target_normals);
    const FloatArray places(points, "points", {any_size, 3});
    const FloatArray sides(normals, "normals", {static_cast<long>(places.size(0)), 3});
    const FloatArray ends(targets, "targets", {any_size, 3});
    std::optional<FloatArray> end_sides;
    if (!target_normals.is_none())
        end_sides.emplace(target_normals, "target_normals",
                          std::initializer_list<long>{static_cast<long>(ends.size(0)), 3});
    const std::size_t row = bytes_of_row(ends.size(0));
    mir::check_limit(mir::saturating_mul(places.size(0), row), mir::Limits{}.visibility_bytes,
                     "visibility_bytes");
    const std::shared_ptr<const Tracing> tracing = scene.tracing();
    std::vector<std::uint8_t> bits(places.size(0) * row);
    mir::Monitor monitor;
    watched(monitor, nb::none(), [&] {
        Threads pool(threads, monitor);
        const Segments segments{places, sides, ends, end_sides ? &*end_sides : nullptr,
                                tracing->geometry.ray_offset()};
        find_visible(segments, tracing->tree.visibility(), bits.data(), pool.watched);
    });
    return nb::cast(array_from(std::move(bits), {places.size(0), row}));
}

/// Light of VPLs through arrays of luxels, by what find(gbuffer) says of who sees whom.
template <class Find>
nb::object gathered(const HostGBuffer& arrays, const PyVpls& vpls, float bound, float ray_offset,
                    unsigned threads, const Find& find) {
    const mir::Extent size{static_cast<std::uint32_t>(arrays.width()),
                           static_cast<std::uint32_t>(arrays.height())};
    mir::Image<mir::Rgb> light;
    mir::Monitor monitor;
    watched(monitor, nb::none(), [&] {
        Threads pool(threads, monitor);
        const ArrayGBuffer gbuffer(arrays.view(ray_offset), size);
        light = mir::reconstruct(mir::sched::Cpu{pool.watched}, gbuffer, vpls.span(), find(gbuffer),
                                 Shading{bound});
    });
    return nb::cast(array_from(std::move(light)));
}

nb::object reconstruct(PyScene& scene, nb::handle gbuffer, nb::handle vpls,
                       const std::optional<float>& bound, unsigned threads) {
    if (gpu::holds(gbuffer_array(gbuffer, "position")))
        return gpu::reconstruct(scene, gbuffer, vpls, bound);
    const HostGBuffer arrays = host_gbuffer(gbuffer);
    const PyVpls& lights = vpls_in(vpls);
    const float limit = bound_of(lights, bound);
    const std::shared_ptr<const Tracing> tracing = scene.tracing();
    return gathered(arrays, lights, limit, tracing->geometry.ray_offset(), threads,
                    [&](const ArrayGBuffer&) { return tracing->tree.visibility(); });
}

nb::object reshade(nb::handle gbuffer, nb::handle vpls, nb::handle bits,
                   const std::optional<float>& bound, float ray_offset, unsigned threads) {
    if (gpu::holds(gbuffer_array(gbuffer, "position")))
        return gpu::reshade(gbuffer, vpls, bits, bound, ray_offset);
    const HostGBuffer arrays = host_gbuffer(gbuffer);
    const PyVpls& lights = vpls_in(vpls);
    const auto luxels = static_cast<long>(arrays.height() * arrays.width());
    const std::size_t row = bytes_of_row(lights.vpls.size());
    const auto rows = byte_array(bits, "bits", {luxels, static_cast<long>(row)});
    const auto* first = static_cast<const std::uint8_t*>(rows.data());
    return gathered(arrays, lights, bound_of(lights, bound), ray_offset, threads,
                    [&](const ArrayGBuffer& image) {
                        return PackedBits{first, row, image.extent().width, image.tiles().data()};
                    });
}

}  // namespace

void bind_parts(nb::module_& m) {
    m.def("visibility", visibility, nb::arg("scene"), nb::arg("points").none(),
          nb::arg("normals").none(), nb::arg("targets").none(),
          nb::arg("target_normals") = nb::none(), nb::kw_only(), nb::arg("threads") = 0,
          "Which points of surfaces see which targets: (n, ceil(m / 8)) of uint8, bit j % 8 of\n"
          "byte j // 8 for target j; numpy.unpackbits(bits, axis=1, count=m,\n"
          "bitorder=\"little\") makes (n, m) of them.\n\n"
          "points: (n, 3), metres, on surfaces. normals: (n, 3), unit, of the side that is asked\n"
          "about; zero: sees nothing. targets: (m, 3), metres, off surfaces. target_normals:\n"
          "(m, 3); with them a target is seen from its front alone, as a VPL is.\n\n"
          "Arrays of float32 on a GPU are read where they lie; the bits then lie there too.");
    m.def("reconstruct", reconstruct, nb::arg("scene"), nb::arg("gbuffer").none(),
          nb::arg("vpls").none(), nb::kw_only(), nb::arg("bound") = nb::none(),
          nb::arg("threads") = 0,
          "Light of VPLs at the pixels of a G-buffer: (h, w, 3), W m^-2 sr^-1, towards the\n"
          "viewer. The scene hides what lies behind it.\n\n"
          "gbuffer: dictionary of float32 arrays, read where they lie: position (h, w, 3),\n"
          "metres; normal (h, w, 3), unit, geometric, zero where nothing is seen; albedo\n"
          "(h, w, 3); view (h, w, 3), unit, towards the viewer, or eye (3,), its place; if there:\n"
          "shading_normal (h, w, 3), roughness, metallic, specular (h, w), 0..1. Without these\n"
          "surfaces are Lambertian. bound: largest geometry term, m^-2; None: that of the VPLs.\n\n"
          "With arrays on a GPU the light is found and lies there; vpls may then be a dictionary\n"
          "of arrays there, as Vpls.on_gpu() gives it.");
    m.def("reshade", reshade, nb::arg("gbuffer").none(), nb::arg("vpls").none(),
          nb::arg("bits").none(), nb::kw_only(), nb::arg("bound") = nb::none(),
          nb::arg("ray_offset") = 0.0f, nb::arg("threads") = 0,
          "reconstruct() from bits of visibility(), without a ray: intensities, bound and\n"
          "materials may be others than when the bits were found.\n\n"
          "bits: (h * w, ceil(n / 8)) of uint8, of the pixels in row order and the n VPLs, with\n"
          "target_normals. ray_offset: metres by which surfaces are lifted, Scene.ray_offset;\n"
          "with it the light is that of reconstruct() in every bit.");
}

}  // namespace mirpy
