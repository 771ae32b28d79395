// SPDX-License-Identifier: MIT
#pragma once

#include "mir/direct_light.hpp"
#include "mir/micro/buffer_gather.hpp"
#include "mir/micro/check_gather.hpp"
#include "mir/micro/ray_gather.hpp"

namespace mir {

/// Default progress callback of gather_light(): does nothing.
inline constexpr auto no_progress = [](std::uint64_t) {};

/// Indirect light of an image. What `gather`, a RayGather or a BufferGather, finds at every luxel;
/// towards the viewer, W m^-2 sr^-1. Calls done(n) after every n luxels, from any thread.
template <TiledGBuffer G, class Gather, Executor E, class Done = decltype(no_progress)>
Image<Rgb> gather_light(const G& gbuffer, const Gather& gather, LuxelBand band, E& executor,
                        const Done& done = no_progress) {
    Image<Rgb> image(gbuffer.extent());
    for_each_luxel(
        gbuffer, executor, [&](std::uint32_t x, std::uint32_t y, const auto& luxels, LuxelIndex i) {
            const Hit hit = luxels.hit(i);
            if (!is_empty(hit))
                image(x, y) =
                    gather(hit, luxels.surface(i), band.luxel_numbers(x, y, Stream::gather));
            done(1);
        });
    return image;
}

/// The same by rays, from the discs of a tree whose nodes send out `radiance`.
/// @throws Error(invalid_argument) on options out of range.
template <Bsdf B, TiledGBuffer G, Executor E, class Done = decltype(no_progress)>
Image<Rgb> gather_light(const G& gbuffer, const SurfelTree& tree,
                        std::span<const SurfelRadiance> radiance, const GatherOptions& options,
                        LuxelBand band, E& executor, const Done& done = no_progress) {
    check(options);
    const RayGather<Space::host, B> gather{tree.view(), radiance.data(), options};
    return gather_light(gbuffer, gather, band, executor, done);
}

/// The same by micro-buffers.
/// @throws Error(invalid_argument) on options out of range.
template <Bsdf B, TiledGBuffer G, Executor E, class Done = decltype(no_progress)>
Image<Rgb> gather_light(const G& gbuffer, const SurfelTree& tree,
                        std::span<const SurfelRadiance> radiance,
                        const BufferGatherOptions& options, LuxelBand band, E& executor,
                        const Done& done = no_progress) {
    check(options);
    const BufferGather<Space::host, B> gather{tree.view(), radiance.data(), options};
    return gather_light(gbuffer, gather, band, executor, done);
}

}  // namespace mir
