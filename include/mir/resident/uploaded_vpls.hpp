// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/concepts/vpl_set.hpp"
#include "mir/data/vpl_list.hpp"

namespace mir {

/// The VPLs of an image in a backend's memory, and a copy on the host.
template <Backend B>
class UploadedVpls {
 public:
    /// Allocates the VPLs on the backend and on the host, and copies them there.
    template <VplSet P>
    UploadedVpls(const B& backend, const P& vpls)
        : host_(backend.template host_buffer<Vpl>(vpls.size())),
          there_(backend.template buffer<Vpl>(vpls.size())) {
        for (VplIndex j = 0; j < vpls.size(); ++j) host_.span()[j] = vpls[j];
    }

    /// Starts the copy; view() may be used by what follows it.
    void send(typename B::Queue& queue) {
        if (size() > 0) queue.upload(std::span<const Vpl>(host_.span()), there_);
    }

    /// Number of VPLs.
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(there_.size()); }
    /// Those on the backend; a view.
    [[nodiscard]] VplSpan<B::space> view() const { return {there_.data(), size()}; }
    /// Those on the host; a view.
    [[nodiscard]] VplSpan<Space::host> host_view() { return {host_.span().data(), size()}; }

 private:
    typename B::template HostBuffer<Vpl> host_;
    typename B::template Buffer<Vpl> there_;
};

}  // namespace mir
