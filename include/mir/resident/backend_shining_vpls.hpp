// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/cuts/shining_parts.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "mir/resident/wait_at_end.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace mir {

/// The VPLs of a list that shine, in a backend's memory: what ShiningVpls finds on the host. Move
/// only if the backend's buffers are.
template <Backend B>
class BackendShiningVpls {
 public:
    /// Most VPLs of a tree on a backend, which can add up the weights of so many.
    static constexpr std::uint32_t most_count = (1u << 22) - 1;

    /// Copies all VPLs and keeps those that shine. All work is done when it returns.
    /// @throws Error(invalid_argument) for an intensity, place or normal that is not finite;
    ///         Error(limit_exceeded) for more than most_count that shine; what the backend throws.
    BackendShiningVpls(const B& backend, typename B::Queue& queue, VplSpan<Space::host> vpls)
        : shining_(backend.template buffer<Vpl>(0)) {
        if (vpls.size() == 0) return;
        const UploadedArray<B, Vpl> all(backend, queue, std::span(vpls.first, vpls.size()));
        const WaitAtEnd wait(queue);
        const VplSpan<B::space> there{all.data(), vpls.size()};
        const std::vector<std::uint32_t> before = count(backend, queue, there);
        shining_ = backend.template buffer<Vpl>(checked(count_));
        if (count_ == 0) return;
        const UploadedArray<B, std::uint32_t> starts(backend, queue, before);
        const WaitAtEnd wait_for_starts(queue);
        queue.for_each_group(static_cast<std::uint32_t>(before.size()),
                             KeepShining<B::space>{there, starts.data(), shining_.data()});
        queue.record().sync();
    }

    /// For kernels on any queue; valid until this is moved or ends.
    [[nodiscard]] VplSpan<B::space> span() const { return {shining_.data(), count_}; }
    /// See ShiningVpls.
    [[nodiscard]] float most() const { return most_; }
    /// See ShiningVpls.
    [[nodiscard]] float normal_scale() const { return normal_scale_; }

 private:
    static std::uint32_t checked(std::uint32_t count) {
        if (count > most_count)
            throw Error(ErrorCode::limit_exceeded,
                        "there are " + std::to_string(count) +
                            " VPLs in a tree on a backend (it can add up the weights of " +
                            std::to_string(most_count) +
                            "); ask for fewer, or sum all of them without a tree");
        return count;
    }

    /// Finds everything but the VPLs themselves. Returns how many shine before each part.
    [[nodiscard]] std::vector<std::uint32_t> count(const B& backend, typename B::Queue& queue,
                                                   VplSpan<B::space> vpls) {
        std::vector<ShiningPart> parts((vpls.size() - 1) / ShiningPart::size + 1);
        auto found = backend.template buffer<ShiningPart>(parts.size());
        const WaitAtEnd wait(queue);
        queue.for_each_group(static_cast<std::uint32_t>(parts.size()),
                             CountShining<B::space>{vpls, found.data()});
        queue.download(found, std::span(parts));
        queue.record().sync();
        std::vector<std::uint32_t> before;
        VplBounds all;
        for (const ShiningPart& part : parts) {
            expect_bounded(part.broken == 0);
            before.push_back(count_);
            count_ += part.shining;
            all = all.with({{part.low[0], part.low[1], part.low[2]},
                            {part.high[0], part.high[1], part.high[2]},
                            part.most});
        }
        most_ = std::sqrt(all.most);
        normal_scale_ = normal_scale_of(all);
        return before;
    }

    typename B::template Buffer<Vpl> shining_;
    std::uint32_t count_ = 0;
    float most_ = 0.0f;
    float normal_scale_ = 0.0f;
};

}  // namespace mir
