// SPDX-License-Identifier: MIT
#pragma once

#include "mir/kernels/visibility_pass.hpp"
#include "mir/shaft/device/backend_shafts.hpp"

#include <optional>

namespace mir {

/// Fills words of visibility (VisibilityWords) on a backend in the fastest way. By shafts if the
/// visibility brings what they need, else by a segment for each luxel and VPL that face each other.
/// The bits are the same. Keeps what shafts work in. One queue at a time, and it must outlive the
/// work.
template <Backend B>
class WordFinder {
 public:
    /// For runs of up to `luxels` luxels and sets of `vpls` VPLs. Padding counts.
    WordFinder(const B& backend, std::uint32_t luxels, std::uint32_t vpls)
        : backend_(backend), luxels_(luxels), vpls_(vpls) {}

    /// Starts to fill the words of `luxels`, in the order of `layout`. They lie in planes if shafts
    /// are to be used; `layout` is that of their tile.
    /// @throws What the backend throws when it has no memory left.
    template <GBuffer G, VplSet P, Visibility V>
        requires AccessibleFrom<V, B::space>
    void find(typename B::Queue& queue, const G& luxels, const BlockedLayout& layout, P vpls,
              const V& visibility, std::uint32_t* words) {
        if constexpr (ShaftableVisibility<V> && requires { luxels.hits.planes; }) {
            if (!shafts_) shafts_.emplace(backend_, luxels_, vpls_);
            shafts_->fill(queue, luxels.hits, layout, vpls, visibility, words);
        } else {
            queue.fill_bits(luxels.size(), vpls.size(), VisibilityPass{luxels, vpls, visibility},
                            words);
        }
    }

 private:
    B backend_;
    std::uint32_t luxels_;
    std::uint32_t vpls_;
    std::optional<BackendShafts<B>> shafts_;
};

}  // namespace mir
