// SPDX-License-Identifier: MIT
#include "cuda/device_rows.hpp"
#include "cuda/response.hpp"
#include "mir/cuda/backend.cuh"
#include "mir/normalise/response.hpp"
#include "mir/resident/backend_response.hpp"

namespace mirtest {

using mir::cuda::Backend;
using HostSight = BruteForceView<mir::Space::host>;
using HostVpls = mir::VplSpan<mir::Space::host>;
using Responses = std::vector<mir::ImageResponse>;

template <mir::Shading F>
Responses responses_on_gpu(const Backend& backend,
                           const mir::BlockedGBuffer<decltype(F::Surface::bsdf)>& here,
                           HostVpls vpls, HostSight visibility, const F& shading,
                           std::uint32_t partial_sums) {
    const DeviceRows rows(backend, visibility);
    auto queue = backend.queue();
    const mir::UploadedArray<Backend, mir::Vpl> vpls_there(backend, queue,
                                                           {vpls.first, vpls.size()});
    const mir::VplSpan<mir::Space::device> there{vpls_there.data(), vpls.size()};
    const mir::Tile& first = here.tiles().front();
    mir::BackendGBuffer<Backend, decltype(F::Surface::bsdf)> luxels(backend, here.extent(),
                                                                    {first.width, first.height});
    luxels.upload(queue, here);
    mir::BackendVisibility<Backend> seen(backend, luxels.grid(), vpls.size());
    seen.find(queue, luxels, there, rows.visibility());
    mir::BackendResponse<Backend> sums_there(backend, here.extent(), vpls.size(), partial_sums);
    mir::ResponseSum sum(here.extent(), vpls.size());
    sums_there.sum_rows(queue, luxels, there, seen, shading);
    sum.add_by(here.extent(), [&](auto totals) { sums_there.add_rows(queue, totals); });
    return sum.mean();
}

template Responses responses_on_gpu(const Backend&,
                                    const mir::BlockedGBuffer<mir::Lambert::Params>&, HostVpls,
                                    HostSight, const mir::VplShading<mir::Lambert>&, std::uint32_t);
template Responses responses_on_gpu(const Backend&,
                                    const mir::BlockedGBuffer<mir::CookTorrance::Params>&, HostVpls,
                                    HostSight, const mir::VplShading<mir::CookTorrance>&,
                                    std::uint32_t);
template Responses responses_on_gpu(const Backend&,
                                    const mir::BlockedGBuffer<mir::Lambert::Params>&, HostVpls,
                                    HostSight, const NoNumberBehind&, std::uint32_t);

}  // namespace mirtest
