// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/shading.hpp"
#include "mir/cuda/backend.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/data/image_response.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/brute_force_view.hpp"

#include <cmath>
#include <vector>

// What the tests start on the GPU: declared for files with assertions, defined in response.cu.

namespace mirtest {

/// No number for luxels behind a VPL, none of which sees it. Asked unprepared.
struct NoNumberBehind {
    using Surface = mir::Surface<mir::Lambert::Params>;

    mir::VplShading<mir::Lambert> shading;

    [[nodiscard]] MIR_HD mir::Rgb operator()(const mir::Hit& hit, const Surface& surface,
                                             const mir::Vpl& vpl) const {
        const bool is_behind = glm::dot(vpl.normal, hit.position - vpl.position) < -1e-3f;
        return is_behind ? mir::Rgb{NAN, NAN, NAN} : shading(hit, surface, vpl);
    }
};

/// BackendResponse on the GPU; sums of `partial_sums` at a time. Instantiated for VplShading of
/// Lambert and CookTorrance and for NoNumberBehind.
template <mir::Shading F>
std::vector<mir::ImageResponse> responses_on_gpu(
    const mir::cuda::Backend& backend, const mir::BlockedGBuffer<decltype(F::Surface::bsdf)>& here,
    mir::VplSpan<mir::Space::host> vpls, BruteForceView<mir::Space::host> visibility,
    const F& shading, std::uint32_t partial_sums);

}  // namespace mirtest
