// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/resident/backend_gbuffer.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "mir/resident/wait_at_end.hpp"
#include "mir/sampling/light_path_luminance.hpp"

#include <span>
#include <vector>

namespace mir {

/// What kernels read of an ImageProbe, with its bits: luxels that see a surface which reflects, in
/// groups of sixteen. A value of views.
template <Bsdf B, Visibility V>
struct ProbeView {
    static constexpr std::uint32_t width = 16;  ///< luxels of a part

    LuxelImageView<typename B::Params> luxels;  ///< of the probe's grid
    const std::uint32_t* receivers = nullptr;   ///< luxels that reflect, row by row
    std::uint32_t receiver_count = 0;           ///< of them
    V visibility;                               ///< asked for each pair of luxel and VPL
    VplShading<B> shading;                      ///< holds the bound

    /// ImageProbe::parts().
    [[nodiscard]] MIR_HD std::size_t parts() const { return (receiver_count + width - 1) / width; }
    /// ImageProbe::flux().
    [[nodiscard]] MIR_HD float flux(const Vpl& place, Rgb j) const {
        if (receiver_count == 0) return luminance(Rgb{} * j);
        return luminance(mean_of(place, 0, receiver_count) * j);
    }
    /// ImageProbe::response_of_part().
    [[nodiscard]] MIR_HD Rgb response_of_part(const Vpl& place, std::uint64_t turn) const {
        if (receiver_count == 0) return {};
        const auto first = static_cast<std::uint32_t>(turn % parts()) * width;
        const std::uint32_t left = receiver_count - first;
        return mean_of(place, first, first + (left < width ? left : width));
    }

 private:
    [[nodiscard]] MIR_HD Rgb mean_of(const Vpl& place, std::uint32_t first,
                                     std::uint32_t end) const {
        const Vpl unit{place.position, place.normal, {1.0f, 1.0f, 1.0f}};
        const Extent grid = luxels.tiles.image;
        LitSum sum;
        for (std::uint32_t i = first; i < end; ++i) {
            const std::uint32_t x = receivers[i] % grid.width;
            const std::uint32_t y = receivers[i] / grid.width;
            const Hit hit = luxels.hit(x, y);
            if (!faces(hit, unit)) continue;
            const Rgb light = shading(hit, luxels.surface(x, y), unit);
            if (!is_black(light) && visibility.visible(unit.position, hit.position)) sum.add(light);
        }
        return sum.mean(grid.width * grid.height, parts(), (end - first + width - 1) / width);
    }
};

/// Kernel over the luxels of a probe, row by row: whether each sees a surface that reflects.
template <Bsdf B>
struct FindReceivers {
    LuxelImageView<typename B::Params> luxels;  ///< of the probe's grid
    VplShading<B> shading;                      ///< that of the probe
    std::uint32_t* reflects = nullptr;          ///< written: 1 or 0

    /// Luxel i.
    MIR_HD void operator()(std::uint32_t i) const {
        const std::uint32_t x = i % luxels.tiles.image.width;
        const std::uint32_t y = i / luxels.tiles.image.width;
        reflects[i] = !is_empty(luxels.hit(x, y)) && shading.reflects(luxels.surface(x, y)) ? 1 : 0;
    }
};

/// A VPL of a light path, and where its looks begin.
struct LookedAtVpl {
    Vpl vpl;                       ///< with its final intensity
    std::uint32_t first_part = 0;  ///< of the probe
};

/// Kernel over light paths: what each gives to the image, W m^-2 sr^-1.
template <class Probe>
struct LightOfPaths {
    Probe probe;                            ///< a ProbeView
    const LookedAtVpl* vpls = nullptr;      ///< of all paths, one path after the other
    const std::uint32_t* starts = nullptr;  ///< of each path in `vpls`, and the end of the last
    std::uint32_t looks = 1;                ///< parts of the probe for each VPL
    double* light = nullptr;                ///< written

    /// Path i.
    MIR_HD void operator()(std::uint32_t i) const {
        double sum = 0.0;
        for (std::uint32_t r = starts[i]; r < starts[i + 1]; ++r)
            sum += flux_by_looks(probe, vpls[r].vpl, vpls[r].first_part, looks);
        light[i] = sum;
    }
};

/// light_path_luminance() on a backend, in every bit, where its luxels have the bits of the host.
/// `luxels` are those of the probe's rays, in whole blocks, and `sight` is what their visibility
/// is asked of. All work is done when it returns.
/// @throws What the backend throws.
template <Backend M, Bsdf B, Visibility V>
[[nodiscard]] PathLuminance backend_path_luminance(
    const M& backend, typename M::Queue& queue, const VplRecords& sampled,
    const BackendGBuffer<M, typename B::Params>& luxels, const V& sight,
    const VplShading<B>& shading, std::size_t most = 1024) {
    const auto count = static_cast<std::uint32_t>(luxels.extent().area());
    const WaitAtEnd wait(queue);
    auto flags = backend.template buffer<std::uint32_t>(count);
    std::vector<std::uint32_t> flags_here(count);
    queue.for_each(count, FindReceivers<B>{luxels.image(), shading, flags.data()});
    queue.download(flags, std::span(flags_here));
    queue.record().sync();
    std::vector<std::uint32_t> receivers;
    for (std::uint32_t i = 0; i < count; ++i)
        if (flags_here[i] != 0) receivers.push_back(i);

    const UploadedArray<M, std::uint32_t> receivers_there(backend, queue, receivers);
    const ProbeView<B, V> probe{luxels.image(), receivers_there.data(),
                                static_cast<std::uint32_t>(receivers.size()), sight, shading};
    const LightPathLooks looks(sampled, probe.parts(), most);
    std::vector<LookedAtVpl> vpls;
    std::vector<std::uint32_t> starts{0};
    const std::size_t parts = std::max<std::size_t>(probe.parts(), 1);
    for (std::size_t i = 0; i < looks.lit(); ++i) {
        for (std::size_t r = looks.first(i); r < looks.end(i); ++r)
            vpls.push_back({sampled.records[r].vpl, static_cast<std::uint32_t>(r % parts)});
        starts.push_back(static_cast<std::uint32_t>(vpls.size()));
    }
    std::vector<double> light(looks.lit());
    if (!light.empty()) {
        const UploadedArray<M, LookedAtVpl> vpls_there(backend, queue, vpls);
        const UploadedArray<M, std::uint32_t> starts_there(backend, queue, starts);
        auto light_there = backend.template buffer<double>(light.size());
        queue.for_each(static_cast<std::uint32_t>(light.size()),
                       LightOfPaths<ProbeView<B, V>>{probe, vpls_there.data(), starts_there.data(),
                                                     static_cast<std::uint32_t>(looks.looks()),
                                                     light_there.data()});
        queue.download(light_there, std::span(light));
        queue.record().sync();
    }
    return looks.estimate(light);
}

}  // namespace mir
