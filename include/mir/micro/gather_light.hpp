// SPDX-License-Identifier: MIT
#pragma once

#include "mir/direct_light.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "mir/micro/ray_gather.hpp"

namespace mir {

/// Indirect light of an image: what `gather`, a RayGather or a BufferGather, finds at every luxel;
/// towards the viewer, W m^-2 sr^-1.
template <TiledGBuffer G, class Gather, Executor E>
Image<Rgb> gather_light(const G& gbuffer, const Gather& gather, LuxelBand band, E& executor) {
    Image<Rgb> image(gbuffer.extent());
    for_each_luxel(
        gbuffer, executor, [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
            const Hit hit = luxels.hit(i);
            if (is_empty(hit)) return;
            image(x, y) = gather(hit, luxels.surface(i), band.luxel_numbers(x, y, Stream::gather));
        });
    return image;
}

/// The same by rays, from the discs of a tree whose nodes send out `radiance`.
/// @throws Error(invalid_argument) on options out of range.
template <Bsdf B, TiledGBuffer G, Executor E>
Image<Rgb> gather_light(const G& gbuffer, const SurfelTree& tree,
                        std::span<const SurfelRadiance> radiance, const GatherOptions& options,
                        LuxelBand band, E& executor) {
    check(options);
    const RayGather<Space::host, B> gather{tree.view(), radiance.data(), options};
    return gather_light(gbuffer, gather, band, executor);
}

/// The same by micro-buffers.
/// @throws Error(invalid_argument) on options out of range.
template <Bsdf B, TiledGBuffer G, Executor E>
Image<Rgb> gather_light(const G& gbuffer, const SurfelTree& tree,
                        std::span<const SurfelRadiance> radiance,
                        const BufferGatherOptions& options, LuxelBand band, E& executor) {
    check(options);
    const BufferGather<Space::host, B> gather{tree.view(), radiance.data(), options};
    return gather_light(gbuffer, gather, band, executor);
}

}  // namespace mir
