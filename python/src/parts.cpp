// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include "array_gbuffer.hpp"
#include "errors.hpp"
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

NumpyArray<std::uint8_t> visibility(PyScene& scene, nb::handle points, nb::handle normals,
                                    nb::handle targets, nb::handle target_normals,
                                    unsigned threads) {
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
    return array_from(std::move(bits), {places.size(0), row});
}

float bound_of(const PyVpls& vpls, const std::optional<float>& bound) {
    if (bound && !(*bound > 0.0f))
        throw ArgumentError("bound", "it is no positive number; give one, per square metre");
    return bound.value_or(vpls.bound);
}

/// Light of VPLs through arrays of luxels, by what find(gbuffer) says of who sees whom.
template <class Find>
NumpyArray<float> gathered(const GBufferArrays& arrays, const PyVpls& vpls, float bound,
                           float ray_offset, unsigned threads, const Find& find) {
    mir::Image<mir::Rgb> light;
    mir::Monitor monitor;
    watched(monitor, nb::none(), [&] {
        Threads pool(threads, monitor);
        const ArrayGBuffer gbuffer(arrays, ray_offset);
        light = mir::reconstruct(mir::sched::Cpu{pool.watched}, gbuffer, vpls.span(), find(gbuffer),
                                 Shading{bound});
    });
    return array_from(std::move(light));
}

NumpyArray<float> reconstruct(PyScene& scene, nb::handle gbuffer, const PyVpls& vpls,
                              const std::optional<float>& bound, unsigned threads) {
    const GBufferArrays arrays(gbuffer);
    const float limit = bound_of(vpls, bound);
    const std::shared_ptr<const Tracing> tracing = scene.tracing();
    return gathered(arrays, vpls, limit, tracing->geometry.ray_offset(), threads,
                    [&](const ArrayGBuffer&) { return tracing->tree.visibility(); });
}

NumpyArray<float> reshade(nb::handle gbuffer, const PyVpls& vpls, nb::handle bits,
                          const std::optional<float>& bound, float ray_offset, unsigned threads) {
    const GBufferArrays arrays(gbuffer);
    const auto luxels = static_cast<long>(arrays.position.size(0) * arrays.position.size(1));
    const std::size_t row = bytes_of_row(vpls.vpls.size());
    const auto rows = byte_array(bits, "bits", {luxels, static_cast<long>(row)});
    const auto* first = static_cast<const std::uint8_t*>(rows.data());
    return gathered(arrays, vpls, bound_of(vpls, bound), ray_offset, threads,
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
          "(m, 3); with them a target is seen from its front alone, as a VPL is.");
    m.def("reconstruct", reconstruct, nb::arg("scene"), nb::arg("gbuffer").none(), nb::arg("vpls"),
          nb::kw_only(), nb::arg("bound") = nb::none(), nb::arg("threads") = 0,
          "Light of VPLs at the pixels of a G-buffer: (h, w, 3), W m^-2 sr^-1, towards the\n"
          "viewer. The scene hides what lies behind it.\n\n"
          "gbuffer: dictionary of float32 arrays, read where they lie: position (h, w, 3),\n"
          "metres; normal (h, w, 3), unit, geometric, zero where nothing is seen; albedo\n"
          "(h, w, 3); view (h, w, 3), unit, towards the viewer, or eye (3,), its place; if there:\n"
          "shading_normal (h, w, 3), roughness, metallic, specular (h, w), 0..1. Without these\n"
          "surfaces are Lambertian. bound: largest geometry term, m^-2; None: that of the VPLs.");
    m.def("reshade", reshade, nb::arg("gbuffer").none(), nb::arg("vpls"), nb::arg("bits").none(),
          nb::kw_only(), nb::arg("bound") = nb::none(), nb::arg("ray_offset") = 0.0f,
          nb::arg("threads") = 0,
          "reconstruct() from bits of visibility(), without a ray: intensities, bound and\n"
          "materials may be others than when the bits were found.\n\n"
          "bits: (h * w, ceil(n / 8)) of uint8, of the pixels in row order and the n VPLs, with\n"
          "target_normals. ray_offset: metres by which surfaces are lifted, Scene.ray_offset;\n"
          "with it the light is that of reconstruct() in every bit.");
}

}  // namespace mirpy
