// SPDX-License-Identifier: MIT
#include "array_gbuffer.hpp"
#include "errors.hpp"
#include "gpu/call.hpp"
#include "gpu/kernels.hpp"
#include "gpu/outputs.hpp"
#include "gpu_parts.hpp"
#include "mir/core/limits.hpp"
#include "mir/resident/uploaded_trees.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "packed_bits.hpp"

namespace nb = nanobind;

namespace mirpy::gpu {
namespace {

using Backend = mir::cuda::Backend;
using TreeThere = mir::UploadedKdTree<Backend>;
using GpuGBuffer = GBufferArrays<Floats>;

/// Kernels count in 32 bits.
void check_count(std::size_t count, const char* place) {
    if (count >= 0xFFFFFFFFu)
        throw ArgumentError(
            place, "it has " + std::to_string(count) + " elements; give fewer than 4294967295");
}

/// The tree of a scene in the memory of a GPU, copied when it is first asked for.
Tree tree_of(const Tracing& tracing, Call& call) {
    if (!tracing.geometry.is_opaque())
        throw mir::Error(mir::ErrorCode::unsupported,
                         "scene: arrays of a GPU were given (rays there do not know materials that "
                         "are seen through); give arrays of the processor");
    std::shared_ptr<const void>& there = tracing.on_gpus[call.backend().device()];
    if (!there) {
        // Others see it once it is copied: another thread may ask while this one waits. The tree of
        // the first stays, since views of it may be out.
        auto made =
            std::make_shared<const TreeThere>(call.backend(), call.queue(), tracing.tree.tree());
        call.finish();
        if (!there) there = std::move(made);
    }
    return static_cast<const TreeThere*>(there.get())->view();
}

/// Where the light of VPLs is read: the caller's arrays, or a copy of a Vpls.
class VplsThere {
 public:
    VplsThere(Call& call, nb::handle vpls, const std::optional<float>& bound) {
        if (nb::isinstance<nb::dict>(vpls)) {
            lend(call, vpls, bound);
            return;
        }
        const PyVpls& host = vpls_in(vpls);
        bound_ = bound_of(host, bound);
        copy_ = call.backend().buffer<mir::Vpl>(host.vpls.size());
        call.queue().upload(std::span<const mir::Vpl>(host.vpls), copy_);
        const auto* first = reinterpret_cast<const float*>(copy_.data());
        const auto column = [&](std::size_t k) {
            return StridedFloats{first == nullptr ? nullptr : first + k, {9, 1, 0}};
        };
        arrays_ = {column(0), column(3), column(6), static_cast<std::uint32_t>(host.vpls.size())};
    }

    [[nodiscard]] const VplArrays& arrays() const { return arrays_; }
    [[nodiscard]] float bound() const { return bound_; }

 private:
    void lend(Call& call, nb::handle vpls, const std::optional<float>& bound) {
        const auto array = [&](const char* name, long count) {
            const nb::handle found = PyDict_GetItemString(vpls.ptr(), name);
            const std::string place = "vpls." + std::string(name);
            if (!found.is_valid()) throw ArgumentError(place, "it is missing; give (n, 3) floats");
            return Floats(call, found, place, {count, 3});
        };
        const Floats positions = array("positions", any_size);
        const auto count = static_cast<long>(positions.size(0));
        check_count(positions.size(0), "vpls.positions");
        arrays_ = {positions.view(), array("normals", count).view(),
                   array("intensities", count).view(), static_cast<std::uint32_t>(count)};
        PyVpls usual;
        const nb::handle given = PyDict_GetItemString(vpls.ptr(), "bound");
        if (given.is_valid() && !nb::try_cast(given, usual.bound))
            throw ArgumentError("vpls.bound", "it is no number; give one, per square metre");
        bound_ = bound_of(usual, bound);
    }

    mir::cuda::Buffer<mir::Vpl> copy_;
    VplArrays arrays_;
    float bound_ = 0.0f;
};

GpuGBuffer lent_gbuffer(Call& call, nb::handle mapping) {
    return {mapping, [&call](nb::handle value, const std::string& place, Call::Shape shape) {
                return Floats(call, value, place, shape);
            }};
}

int device_of_gbuffer(nb::handle mapping) { return device_of(gbuffer_array(mapping, "position")); }

/// Light of luxels, by work(luxels, scratch, light).
template <class Work>
nb::object lit(Call& call, const GpuGBuffer& arrays, float ray_offset, const Work& work) {
    const std::size_t count = arrays.height() * arrays.width();
    check_count(count, "gbuffer.position");
    const Luxels luxels{arrays.view(ray_offset), static_cast<std::uint32_t>(arrays.width()),
                        static_cast<std::uint32_t>(count)};
    auto light = std::make_unique<Output<float>>(call.backend(), 3 * count);
    auto scratch = call.backend().buffer<std::uint32_t>(3 * count);
    const mir::WaitAtEnd wait(call.queue());
    work(luxels, scratch.data(), light->buffer.data());
    call.finish();
    return array_over(std::move(light), {arrays.height(), arrays.width(), 3});
}

}  // namespace

bool holds(nb::handle array) { return device_of(array) >= 0; }

nb::object visibility(PyScene& scene, nb::handle points, nb::handle normals, nb::handle targets,
                      nb::handle target_normals) {
    const std::shared_ptr<const Tracing> tracing = scene.tracing();
    Call call(device_of(points));
    const Floats places(call, points, "points", {any_size, 3});
    const Floats sides(call, normals, "normals", {static_cast<long>(places.size(0)), 3});
    const Floats ends(call, targets, "targets", {any_size, 3});
    StridedFloats fronts;
    if (!target_normals.is_none())
        fronts =
            Floats(call, target_normals, "target_normals", {static_cast<long>(ends.size(0)), 3})
                .view();
    check_count(ends.size(0), "targets");
    const std::size_t row = bytes_of_row(ends.size(0));
    mir::check_limit(mir::saturating_mul(places.size(0), row), mir::Limits{}.visibility_bytes,
                     "visibility_bytes");
    const Tree tree = tree_of(*tracing, call);
    auto bits = std::make_unique<Output<std::uint8_t>>(call.backend(), places.size(0) * row);
    const mir::WaitAtEnd wait(call.queue());
    find_visible(call.queue(),
                 {places.view(), sides.view(), ends.view(), fronts, places.size(0),
                  static_cast<std::uint32_t>(ends.size(0)), tracing->geometry.ray_offset()},
                 tree, bits->buffer.data(), row);
    call.finish();
    return array_over(std::move(bits), {places.size(0), row});
}

nb::object reconstruct(PyScene& scene, nb::handle gbuffer, nb::handle vpls,
                       const std::optional<float>& bound) {
    const std::shared_ptr<const Tracing> tracing = scene.tracing();
    Call call(device_of_gbuffer(gbuffer));
    const GpuGBuffer arrays = lent_gbuffer(call, gbuffer);
    const VplsThere there(call, vpls, bound);
    const Tree tree = tree_of(*tracing, call);
    return lit(call, arrays, tracing->geometry.ray_offset(),
               [&](const Luxels& luxels, std::uint32_t* scratch, float* light) {
                   gather(call.queue(), luxels, there.arrays(), tree, there.bound(), scratch,
                          light);
               });
}

nb::object reshade(nb::handle gbuffer, nb::handle vpls, nb::handle bits,
                   const std::optional<float>& bound, float ray_offset) {
    Call call(device_of_gbuffer(gbuffer));
    const GpuGBuffer arrays = lent_gbuffer(call, gbuffer);
    const VplsThere there(call, vpls, bound);
    const std::size_t row = bytes_of_row(there.arrays().count);
    const Call::Array& rows = call.lend(
        bits, "bits", {static_cast<long>(arrays.height() * arrays.width()), static_cast<long>(row)},
        nb::dlpack::dtype_code::UInt, 8);
    check_dense(rows, "bits");
    const ByteRows seen{static_cast<const std::uint8_t*>(rows.data()), row};
    return lit(
        call, arrays, ray_offset, [&](const Luxels& luxels, std::uint32_t* scratch, float* light) {
            gpu::reshade(call.queue(), luxels, there.arrays(), seen, there.bound(), scratch, light);
        });
}

nb::dict copy_of(const PyVpls& vpls, int device) {
    Call call(device);
    const std::size_t count = vpls.vpls.size();
    nb::dict all;
    all["bound"] = vpls.bound;
    const auto add = [&](const char* name, const auto& of) {
        std::vector<float> row;
        for (const mir::Vpl& v : vpls.vpls) {
            const auto three = of(v);
            row.insert(row.end(), {three[0], three[1], three[2]});
        }
        auto there = std::make_unique<Output<float>>(call.backend(), row.size());
        call.queue().upload(std::span<const float>(row), there->buffer);
        call.finish();
        all[name] = array_over(std::move(there), {count, 3});
    };
    add("positions", [](const mir::Vpl& v) { return v.position; });
    add("normals", [](const mir::Vpl& v) { return v.normal; });
    add("intensities",
        [](const mir::Vpl& v) { return mir::Vec3(v.intensity.r, v.intensity.g, v.intensity.b); });
    return all;
}

}  // namespace mirpy::gpu
