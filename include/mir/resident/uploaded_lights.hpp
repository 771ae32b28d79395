// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_environment.hpp"
#include "mir/resident/uploaded_textures.hpp"
#include "mir/scene/light_table.hpp"

namespace mir {

/// The lights of a scene in a backend's memory.
template <Backend B>
class UploadedLights {
 public:
    /// Starts the copies on `queue`; `lights` must live until they are done.
    UploadedLights(const B& backend, typename B::Queue& queue, const LightTable& lights)
        : triangles_(backend, queue, lights.emissive_triangles()),
          lamp_triangles_(backend, queue, lights.lamp_triangles()),
          delta_sources_(backend, queue, lights.delta_sources()),
          lamps_(backend, queue, lights.lamps()),
          cumulative_(backend, queue, lights.by_power().cumulative()),
          cumulative_emitters_(backend, queue, lights.emitters().cumulative()),
          textures_(backend, queue, lights.textures()),
          environment_(backend, queue, lights.environment()),
          values_(lights.view()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] LightTableView<B::space> view() const {
        return {triangles_.data(),
                lamp_triangles_.data(),
                values_.triangle_count,
                delta_sources_.data(),
                values_.delta_count,
                lamps_.data(),
                {cumulative_.data(), values_.by_power.size, values_.by_power.total},
                {cumulative_emitters_.data(), values_.emitters.size, values_.emitters.total},
                values_.centre,
                values_.radius,
                textures_.view(),
                environment_.view()};
    }

 private:
    UploadedArray<B, std::uint32_t> triangles_;
    UploadedArray<B, LampTriangle> lamp_triangles_;
    UploadedArray<B, DeltaSource> delta_sources_;
    UploadedArray<B, LampEntry> lamps_;
    UploadedArray<B, double> cumulative_;
    UploadedArray<B, double> cumulative_emitters_;
    UploadedTextures<B> textures_;
    UploadedEnvironment<B> environment_;
    LightTableView<Space::host> values_;  ///< of which only the values are used
};

}  // namespace mir
