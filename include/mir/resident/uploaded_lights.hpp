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
        : triangles_(backend, queue, lights.lamps().triangles()),
          lamp_triangles_(backend, queue, lights.lamps().lamp_triangles()),
          lamps_(backend, queue, lights.lamps().entries()),
          cumulative_lamps_(backend, queue, lights.lamps().by_power().cumulative()),
          listed_(backend, queue, lights.listed()),
          cumulative_(backend, queue, lights.by_power().cumulative()),
          textures_(backend, queue, lights.lamps().textures()),
          environment_(backend, queue, lights.environment()),
          values_(lights.view()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] LightTableView<B::space> view() const {
        const LampView<Space::host>& lamps = values_.lamps;
        return {{triangles_.data(),
                 lamp_triangles_.data(),
                 lamps.count,
                 lamps_.data(),
                 {cumulative_lamps_.data(), lamps.by_power.size, lamps.by_power.total},
                 textures_.view()},
                listed_.data(),
                values_.listed_count,
                {cumulative_.data(), values_.by_power.size, values_.by_power.total},
                values_.sphere,
                environment_.view()};
    }

 private:
    UploadedArray<B, std::uint32_t> triangles_;
    UploadedArray<B, LampTriangle> lamp_triangles_;
    UploadedArray<B, LampEntry> lamps_;
    UploadedArray<B, double> cumulative_lamps_;
    UploadedArray<B, ListedSource> listed_;
    UploadedArray<B, double> cumulative_;
    UploadedTextures<B> textures_;
    UploadedEnvironment<B> environment_;
    LightTableView<Space::host> values_;  ///< of which only the values are used
};

}  // namespace mir
