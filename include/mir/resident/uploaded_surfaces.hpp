// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_textures.hpp"
#include "mir/shading/surface_table.hpp"

namespace mir {

/// The materials and images of a scene in a backend's memory.
template <Backend B, Bsdf F>
class UploadedSurfaces {
 public:
    /// Starts the copy on `queue`; `surfaces` must live until it is done.
    UploadedSurfaces(const B& backend, typename B::Queue& queue, const SurfaceTable<F>& surfaces)
        : textures_(backend, queue, surfaces.textures()),
          entries_(backend, queue, surfaces.entries()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] SurfaceTableView<B::space, F> view() const {
        return {entries_.data(), textures_.view()};
    }

 private:
    UploadedTextures<B> textures_;
    UploadedArray<B, SurfaceEntry<F>> entries_;
};

}  // namespace mir
