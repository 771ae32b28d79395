// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_array.hpp"
#include "mir/scene/light_table.hpp"
#include "mir/scene/world_geometry.hpp"
#include "mir/shading/surface_table.hpp"

#include <vector>

namespace mir {

/// A WorldGeometry in a backend's memory: what kernels need to turn hits into surface points.
template <Backend B>
class UploadedGeometry {
 public:
    /// Starts the copies on `queue`; `geometry` must live until they are done.
    UploadedGeometry(const B& backend, typename B::Queue& queue, const WorldGeometry& geometry)
        : positions_(backend, queue, geometry.positions()),
          normals_(backend, queue, geometry.normals()),
          triangles_(backend, queue, geometry.triangles()),
          materials_(backend, queue, geometry.materials()),
          texture_coordinates_(backend, queue, geometry.texture_coordinates()),
          colors_(backend, queue, geometry.colors()),
          ray_offset_(geometry.ray_offset()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] GeometryView<B::space> view() const {
        return {positions_.data(),
                normals_.data(),
                triangles_.data(),
                materials_.data(),
                ray_offset_,
                texture_coordinates_.size() == 0 ? nullptr : texture_coordinates_.data(),
                colors_.size() == 0 ? nullptr : colors_.data()};
    }

 private:
    UploadedArray<B, Vec3> positions_;
    UploadedArray<B, Vec3> normals_;
    UploadedArray<B, TriangleIndices> triangles_;
    UploadedArray<B, std::uint32_t> materials_;
    UploadedArray<B, Vec2> texture_coordinates_;
    UploadedArray<B, Rgb> colors_;
    float ray_offset_;
};

/// The images of a TextureTable in a backend's memory.
template <Backend B>
class UploadedTextures {
 public:
    /// Starts the copies on `queue`. The table and its scene must live until they are done.
    UploadedTextures(const B& backend, typename B::Queue& queue, const TextureTable& textures)
        : values_(backend, queue, std::span<const float>(texel_values())),
          texels_(upload_texels(backend, queue, textures)),
          places_(places_of(textures)),
          images_(backend, queue, std::span<const TexelView>(places_)) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] TextureView<B::space> view() const { return {images_.data(), values_.data()}; }

 private:
    using Texels = UploadedArray<B, std::uint32_t>;

    static std::vector<Texels> upload_texels(const B& backend, typename B::Queue& queue,
                                             const TextureTable& textures) {
        std::vector<Texels> all;
        for (const TexelView& image : textures.images())
            all.emplace_back(backend, queue,
                             std::span(image.texels, std::size_t{image.width} * image.height));
        return all;
    }
    [[nodiscard]] std::vector<TexelView> places_of(const TextureTable& textures) const {
        std::vector<TexelView> places(textures.images().begin(), textures.images().end());
        for (std::size_t i = 0; i < places.size(); ++i) places[i].texels = texels_[i].data();
        return places;
    }

    UploadedArray<B, float> values_;
    std::vector<Texels> texels_;
    std::vector<TexelView> places_;  ///< stays until its copy is done
    UploadedArray<B, TexelView> images_;
};

/// The environment of a scene in a backend's memory.
template <Backend B>
class UploadedEnvironment {
 public:
    /// Starts the copies on `queue`; `environment` must live until they are done.
    UploadedEnvironment(const B& backend, typename B::Queue& queue,
                        const EnvironmentTable& environment)
        : texels_(backend, queue, environment.texels()),
          cells_(backend, queue, environment.by_luminance().cumulative()),
          rows_(backend, queue, environment.by_luminance().rows().cumulative()),
          values_(environment.view()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] EnvironmentView<B::space> view() const {
        const DiscreteDistributionView<Space::host>& rows = values_.by_luminance.rows;
        return {texels_.data(),
                values_.width,
                values_.height,
                values_.turns,
                values_.light_group,
                {cells_.data(), values_.width, {rows_.data(), rows.size, rows.total}}};
    }

 private:
    UploadedArray<B, Rgb> texels_;
    UploadedArray<B, double> cells_;
    UploadedArray<B, double> rows_;
    EnvironmentView<Space::host> values_;  ///< only the values are used
};

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
          tree_(backend, queue, lights.tree().nodes()),
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
                environment_.view(),
                {tree_.data(), values_.tree.size},
                values_.is_listed_in_tree};
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
    UploadedArray<B, LightNode> tree_;
    LightTableView<Space::host> values_;  ///< only the values are used
};

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
