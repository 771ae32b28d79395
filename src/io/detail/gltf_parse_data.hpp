// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_buffers.hpp"
#include "io/detail/gltf_document.hpp"
#include "io/detail/gltf_parse_materials.hpp"
#include "io/detail/gltf_parse_meshes.hpp"

#include <tiny_gltf.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace mir::detail {

/// Fills what meshes are made of: materials with their textures, accessors with their bytes. Each
/// when it is asked for, once, and with all that it needs.
class GltfData {
 public:
    /// The lists of `model` have their lengths.
    GltfData(const GltfDocument& document, GltfBuffers& buffers, tinygltf::Model& model)
        : document_(document),
          buffers_(buffers),
          model_(model),
          materials_(model.materials.size()),
          textures_(model.textures.size()),
          images_(model.images.size()),
          accessors_(model.accessors.size()),
          views_(model.bufferViews.size()),
          data_(model.buffers.size()) {}

    void material(std::size_t i);
    void accessor(int index);

    [[nodiscard]] bool has_material(std::size_t i) const { return materials_[i] != 0; }

 private:
    void texture(int index);
    void image(int index);
    void view(int index);

    const GltfDocument& document_;
    GltfBuffers& buffers_;
    tinygltf::Model& model_;
    // What is there, for each element of a list. What is broken stays away: the next who asks for
    // it hears of it as well.
    std::vector<char> materials_;
    std::vector<char> textures_;
    std::vector<char> images_;
    std::vector<char> accessors_;
    std::vector<char> views_;
    std::vector<char> data_;  ///< of buffers
};

inline void GltfData::material(std::size_t i) {
    if (materials_[i] != 0) return;
    tinygltf::Material to = model_.materials[i];
    parse_material(document_, document_.element("material", i), to);
    texture(to.pbrMetallicRoughness.baseColorTexture.index);
    texture(to.pbrMetallicRoughness.metallicRoughnessTexture.index);
    texture(to.normalTexture.index);
    texture(to.emissiveTexture.index);
    for (const GltfExtensionTexture& t : gltf_extension_textures)
        texture(texture_under(to.extensions, t).index);
    model_.materials[i] = std::move(to);
    materials_[i] = 1;
}

inline void GltfData::texture(int index) {
    if (index < 0 || textures_[static_cast<std::size_t>(index)] != 0) return;
    const auto i = static_cast<std::size_t>(index);
    model_.textures[i] = parse_texture(document_, document_.element("texture", i));
    if (const int sampler = model_.textures[i].sampler; sampler >= 0) {
        const auto at = static_cast<std::size_t>(sampler);
        model_.samplers[at] = parse_sampler(document_.element("sampler", at));
    }
    image(model_.textures[i].source);
    textures_[i] = 1;
}

inline void GltfData::image(int index) {
    if (index < 0 || images_[static_cast<std::size_t>(index)] != 0) return;
    const auto i = static_cast<std::size_t>(index);
    model_.images[i] = parse_image(document_, document_.element("image", i), i);
    view(model_.images[i].bufferView);
    images_[i] = 1;
}

inline void GltfData::accessor(int index) {
    const auto i = static_cast<std::size_t>(index);
    if (accessors_[i] != 0) return;
    model_.accessors[i] = parse_accessor(document_, document_.element("accessor", i));
    const tinygltf::Accessor& to = model_.accessors[i];
    view(to.bufferView);
    if (to.sparse.isSparse) {
        view(to.sparse.indices.bufferView);
        view(to.sparse.values.bufferView);
    }
    accessors_[i] = 1;
}

inline void GltfData::view(int index) {
    if (index < 0 || views_[static_cast<std::size_t>(index)] != 0) return;
    const auto i = static_cast<std::size_t>(index);
    model_.bufferViews[i] = parse_buffer_view(document_, document_.element("bufferView", i));
    const auto buffer = static_cast<std::size_t>(model_.bufferViews[i].buffer);
    if (data_[buffer] == 0)
        model_.buffers[buffer].data = buffers_.load(document_.element("buffer", buffer), buffer);
    data_[buffer] = views_[i] = 1;
}

}  // namespace mir::detail
