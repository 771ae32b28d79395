// SPDX-License-Identifier: MIT
#pragma once

#include "io/features/feature.hpp"
#include "io/gltf_everything.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace mirtest::features {

using nlohmann::json;

/// 2 x 2 pixels of 8 bits: red, green above blue, white of alpha 128.
inline const std::string png8 =
    "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAE0lEQVR42mP4z8DwHwyBNAg0AABJSQl4"
    "nFEXkgAAAABJRU5ErkJggg==";
/// One pixel of 16 bits.
inline const std::string png16 =
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABEAYAAABPhRjKAAAAEUlEQVR42mP4/7+hgZHx/38AF34E/8QD"
    "V3UAAAAASUVORK5CYII=";
/// One grey pixel.
inline const std::string jpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAP////////////////////////////////////////////////////////////"
    "//////////////////////////wAALCAABAAEBAREA/8QAFAABAAAAAAAAAAAAAAAAAAAAAP/EABQQAQAAAAAAAAAAAAAA"
    "AAAAAAD/2gAIAQEAAD8AP//Z";

/// Kinds of numbers that accessors hold.
enum class Component { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };

/// A glTF file in the making: one triangle of one material in the plane z = 0, of floats. Features
/// are added to it.
class Gltf {
 public:
    Gltf() {
        file = json::parse(R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{},"material":0}]}],
"materials":[{}],"accessors":[],"bufferViews":[]})");
        attributes()["POSITION"] = floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    }

    json file;
    std::map<std::string, std::string> beside;  ///< files beside the scene, by name

    json& node() { return file["nodes"][0]; }
    json& primitive() { return file["meshes"][0]["primitives"][0]; }
    json& attributes() { return primitive()["attributes"]; }
    json& material() { return file["materials"][0]; }
    json& surface() { return material()["pbrMetallicRoughness"]; }

    /// An accessor of numbers as they lie in a buffer.
    template <class T>
    std::size_t numbers(const std::vector<T>& values, Component component, const char* type) {
        static const std::map<std::string, std::size_t> sizes{
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
        file["accessors"].push_back({{"bufferView", view(bytes_of(values))},
                                     {"componentType", static_cast<int>(component)},
                                     {"count", values.size() / sizes.at(type)},
                                     {"type", type}});
        return file["accessors"].size() - 1;
    }
    std::size_t floats(const std::vector<float>& values, const char* type) {
        return numbers(values, Component::float32, type);
    }
    /// Whole numbers that stand for shares.
    template <class T>
    std::size_t shares(const std::vector<T>& values, Component component, const char* type) {
        const std::size_t at = numbers(values, component, type);
        file["accessors"][at]["normalized"] = true;
        return at;
    }

    /// A view of bytes, which begin at a multiple of four.
    std::size_t view(const std::string& bytes) {
        bytes_.append((4 - bytes_.size() % 4) % 4, '\0');
        file["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", bytes.size()}});
        bytes_ += bytes;
        return file["bufferViews"].size() - 1;
    }

    /// Texture 0 with an image, and coordinates for it; returns its use.
    json texture(const json& image = {{"uri", "data:image/png;base64," + png8}}) {
        file["images"] = json::array({image});
        file["textures"] = json::array({{{"source", 0}}});
        attributes()["TEXCOORD_0"] = floats({0, 1, 1, 1, 0, 0}, "VEC2");
        return {{"index", 0}};
    }

    void use(const std::string& extension) { file["extensionsUsed"].push_back(extension); }

    /// A copy of `values` under an extension of `object`.
    void extend(json& object, const std::string& extension, const json& values = json::object()) {
        object["extensions"][extension] = values;
        use(extension);
    }

    /// As .gltf with the file data.bin.
    [[nodiscard]] Files files() const {
        json whole = file;
        if (!whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", bytes_.size()}, {"uri", "data.bin"}}};
        Files to{beside, "scene.gltf"};
        to.bytes_of["scene.gltf"] = whole.dump();
        to.bytes_of.try_emplace("data.bin", bytes_);
        return to;
    }

    /// The bytes of its buffer.
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
    std::string bytes_;
};

using Build = std::function<void(Gltf&)>;

inline Files gltf(const Build& build) {
    Gltf made;
    build(made);
    return made.files();
}

/// A camera in the triangle's node.
inline Build with_camera(const json& camera) {
    return [=](Gltf& g) {
        g.file["cameras"] = json::array({camera});
        g.node()["camera"] = 0;
    };
}

/// A file of the material's base colour texture whose image is `image`.
inline Files image_file(const json& image) {
    return gltf([&](Gltf& g) { g.surface()["baseColorTexture"] = g.texture(image); });
}

inline Feature feature(std::string name, std::string says, const std::vector<Build>& builds,
                       Outcome outcome, std::string words = "") {
    Feature to{std::move(name), std::move(says), {}, std::move(outcome), std::move(words)};
    for (const Build& build : builds) to.variants.push_back(gltf(build));
    return to;
}

}  // namespace mirtest::features
