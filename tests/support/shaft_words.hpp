// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/wide/wide_rays.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/shaft/device/backend_shafts.hpp"
#include "support/uploaded_wide_bvh.hpp"

#include <vector>

namespace mirtest {

/// Luxels, VPLs and a hierarchy in host memory, for backends to fill words from.
struct ShaftInput {
    mir::SoaView<const mir::Hit> hits;
    std::vector<mir::Vpl> vpls;
    const mir::WideBvh* bvh = nullptr;
    float sigma = 0.0f;
    std::optional<mir::BlockedLayout> layout = std::nullopt;  ///< of the hits, if they have one
};

/// Sees everything: what its answers reach is wrong wherever something is hidden.
template <mir::Space S>
struct SeesAll {
    static constexpr mir::Space space = S;
    [[nodiscard]] MIR_HD bool visible(mir::Vec3 /*a*/, mir::Vec3 /*b*/) const { return true; }
};

/// Words by the shafts of a backend, twice with the same memory: the second ones. They start as
/// ones, which no forgotten word may keep. Segments that are left are traced, or believed to be
/// free.
template <mir::Backend B>
[[nodiscard]] std::vector<std::uint32_t> shaft_words(const B& backend, const ShaftInput& in,
                                                     const mir::BackendShaftOptions& options,
                                                     bool trace = true) {
    const auto count = static_cast<std::uint32_t>(in.vpls.size());
    std::vector<std::uint32_t> words(mir::VisibilityWords<B::space>::count(in.hits.stride, count),
                                     ~0u);
    auto queue = backend.queue();
    const UploadedWideBvh<B> bvh(backend, queue, *in.bvh);
    const mir::UploadedArray<B, std::uint32_t> hits(
        backend, queue,
        {in.hits.planes, std::size_t{mir::SoaView<mir::Hit>::words} * in.hits.stride});
    const mir::UploadedArray<B, mir::Vpl> vpls(backend, queue, in.vpls);
    auto there = backend.template buffer<std::uint32_t>(words.size());
    if (!words.empty()) queue.upload(std::span<const std::uint32_t>(words), there);
    mir::BackendShafts<B> shafts(backend, in.hits.stride, count, options);
    const mir::SoaView<const mir::Hit> luxels{hits.data(), in.hits.stride};
    const mir::VplSpan<B::space> lights{vpls.data(), count};
    for (int run = 0; run < 2; ++run)
        if (trace)
            shafts.fill(queue, luxels, in.layout, lights,
                        mir::ClusterVisibility<mir::WideBvhVisibility<B::space>>{
                            bvh.quantised(), in.sigma, {bvh.view()}},
                        there.data());
        else
            shafts.fill(queue, luxels, in.layout, lights,
                        mir::ClusterVisibility<SeesAll<B::space>>{bvh.quantised(), in.sigma, {}},
                        there.data());
    queue.download(there, std::span(words));
    queue.record().sync();
    return words;
}

}  // namespace mirtest
