// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/obj_text.hpp"
#include "io/detail/polygon.hpp"
#include "io/detail/unit_direction.hpp"
#include "io/detail/unknown_surface.hpp"
#include "mir/scene/scene.hpp"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mir::detail {

/// Turns the faces of one OBJ file into meshes, one for every group and material.
class ObjMeshes {
 public:
    ObjMeshes(const ObjText& text, const Limits& limits, Scene& scene, SceneReport& report)
        : text_(text), limits_(limits), scene_(scene), report_(report) {}

    /// What faces that follow belong to.
    void begin_group(std::string name) {
        group_ = std::move(name);
        part_ = nullptr;
    }
    void use_material(std::optional<std::uint32_t> material) {
        material_ = material;
        part_ = nullptr;
    }

    /// What use_material() was given last.
    [[nodiscard]] std::optional<std::uint32_t> given_material() const { return material_; }

    /// True when a face of so many corners is one. Others are left out and counted.
    [[nodiscard]] static bool is_face(std::size_t corners) { return corners >= 3; }

    /// @throws Error(invalid_input), Error(limit_exceeded)
    void add_face(const tinyobj::index_t* corners, std::size_t count);

    /// Places the meshes, in the order in which their first faces came.
    void finish();

 private:
    /// Counted from zero; -1: none.
    struct Corner {
        std::int64_t vertex = 0;
        std::int64_t normal = -1;
        std::int64_t coordinate = -1;
        friend bool operator==(const Corner&, const Corner&) = default;
    };
    struct CornerHash {
        std::size_t operator()(const Corner& c) const {
            constexpr std::uint64_t prime = 1'000'003;
            const auto word = [](std::int64_t n) { return static_cast<std::uint64_t>(n); };
            return std::hash<std::uint64_t>()(
                (word(c.coordinate) * prime + word(c.normal)) * prime + word(c.vertex));
        }
    };
    struct Part {
        Mesh mesh;
        bool is_textured = false;  ///< others have no texture coordinates
        std::unordered_map<Corner, std::uint32_t, CornerHash> vertices;
    };

    [[nodiscard]] std::int64_t resolve(int index, std::size_t count, const char* what) const;
    [[nodiscard]] Corner corner_of(const tinyobj::index_t& index, const Part& part) const;
    void settle_normals();
    Part& part();
    std::uint32_t vertex_of(Part& part, const Corner& corner);
    [[nodiscard]] std::uint32_t material();

    const ObjText& text_;
    const Limits& limits_;
    Scene& scene_;
    SceneReport& report_;
    std::string group_;
    std::optional<std::uint32_t> material_;
    std::optional<std::uint32_t> default_material_;
    std::map<std::pair<std::string, std::uint32_t>, std::size_t> known_;
    std::vector<Part> parts_;
    Part* part_ = nullptr;  ///< of the group and material that are set; nullptr: not looked up yet
    PolygonCutter cutter_;
    std::vector<Corner> corners_;
    std::vector<std::uint32_t> face_;
    std::vector<Vec3> outline_;
    std::uint64_t triangles_ = 0;
    std::uint64_t vertices_ = 0;
    bool counted_smooth_ = false;
};

/// Place in a list of `count`: OBJ counts from 1, and backwards from -1.
inline std::int64_t ObjMeshes::resolve(int index, std::size_t count, const char* what) const {
    const auto n = static_cast<std::int64_t>(count);
    const std::int64_t at = index > 0 ? index - std::int64_t{1} : n + index;
    if (index == 0 || at < 0 || at >= n)
        fail_at(text_.place(), "a face names " + std::string(what) + " " + std::to_string(index) +
                                   ", but " + std::to_string(count) +
                                   " come before it (counted from 1, or from -1 backwards); repair "
                                   "the face");
    return at;
}

inline ObjMeshes::Corner ObjMeshes::corner_of(const tinyobj::index_t& index,
                                              const Part& part) const {
    Corner corner;
    corner.vertex = resolve(index.vertex_index, text_.positions().size(), "vertex");
    // Zero stands for "not given" here.
    if (index.normal_index != 0)
        corner.normal = resolve(index.normal_index, text_.normals().size(), "normal");
    if (index.texcoord_index == 0) {
        if (part.is_textured) ++report_.ignored["textured corner without texture coordinates"];
        return corner;
    }
    const std::int64_t coordinate =
        resolve(index.texcoord_index, text_.texture_coordinates().size(), "texture coordinate");
    // Elsewhere corners that differ in them alone stay one vertex.
    if (part.is_textured) corner.coordinate = coordinate;
    return corner;
}

inline std::uint32_t ObjMeshes::material() {
    if (material_) return *material_;
    if (!default_material_)
        default_material_ = scene_.add(unknown_surface("OBJ default", text_.has_colors()));
    return *default_material_;
}

inline ObjMeshes::Part& ObjMeshes::part() {
    if (part_ != nullptr) return *part_;
    const auto [at, is_new] = known_.try_emplace({group_, material()}, parts_.size());
    if (is_new) {
        parts_.emplace_back();
        parts_.back().mesh.name = group_;
        parts_.back().mesh.material = material();
        const MaterialTextures& t = scene_.materials[material()].textures;
        parts_.back().is_textured =
            t.base_color.is_set() || t.emission.is_set() || t.normal.is_set();
    }
    return *(part_ = &parts_[at->second]);
}

inline std::uint32_t ObjMeshes::vertex_of(Part& part, const Corner& corner) {
    Mesh& mesh = part.mesh;
    const auto next = static_cast<std::uint32_t>(mesh.positions.size());
    const auto [at, is_new] = part.vertices.try_emplace(corner, next);
    if (!is_new) return at->second;
    check_limit(++vertices_, limits_.vertices, "vertices");
    mesh.positions.push_back(text_.positions()[static_cast<std::size_t>(corner.vertex)]);
    mesh.colors.push_back(text_.colors()[static_cast<std::size_t>(corner.vertex)]);
    mesh.normals.push_back(
        corner.normal < 0
            ? Vec3(0.0f)
            : unit_direction(text_.normals()[static_cast<std::size_t>(corner.normal)]));
    // Rows of images count from the top here.
    if (corner.coordinate >= 0) {
        const Vec2 uv = text_.texture_coordinates()[static_cast<std::size_t>(corner.coordinate)];
        mesh.texture_coordinates.emplace_back(uv.x, 1.0f - uv.y);
    } else if (part.is_textured) {
        mesh.texture_coordinates.emplace_back(0.0f);
    }
    return next;
}

/// A face is smooth when all of its corners have normals. With some alone it would be bent towards
/// no direction at the others.
inline void ObjMeshes::settle_normals() {
    const auto has_none = [](const Corner& corner) { return corner.normal < 0; };
    const auto without = std::count_if(corners_.begin(), corners_.end(), has_none);
    if (without == 0) return;
    if (static_cast<std::size_t>(without) < corners_.size()) {
        ++report_.ignored["face with normals at some corners alone (shaded flat)"];
        for (Corner& corner : corners_) corner.normal = -1;
    } else if (text_.is_smooth() && !counted_smooth_) {
        ++report_.ignored["smoothing groups without normals (shaded flat)"];
        counted_smooth_ = true;
    }
}

inline void ObjMeshes::add_face(const tinyobj::index_t* corners, std::size_t count) {
    if (!is_face(count)) {
        ++report_.ignored["face of fewer than three corners"];
        return;
    }
    Part& to = part();
    corners_.clear();
    face_.clear();
    outline_.clear();
    for (std::size_t i = 0; i < count; ++i) corners_.push_back(corner_of(corners[i], to));
    settle_normals();
    for (const Corner& corner : corners_) {
        face_.push_back(vertex_of(to, corner));
        outline_.push_back(to.mesh.positions[face_.back()]);
    }
    check_limit(triangles_ += count - 2, limits_.triangles, "triangles");
    for (const TriangleIndices& t : cut_polygon(cutter_, outline_, text_.place()))
        to.mesh.triangles.push_back({face_[t[0]], face_[t[1]], face_[t[2]]});
}

inline void ObjMeshes::finish() {
    std::map<std::string, int> uses;
    for (const Part& part : parts_) ++uses[part.mesh.name];
    for (Part& part : parts_) {
        Mesh& mesh = part.mesh;
        const bool shared = uses[mesh.name] > 1;
        if (mesh.name.empty()) mesh.name = "mesh";
        if (shared) mesh.name += "/" + scene_.materials[mesh.material].name;
        bool has_normals = false;
        for (Vec3 n : mesh.normals) has_normals = has_normals || n != Vec3(0.0f);
        if (!has_normals) mesh.normals.clear();
        if (!text_.has_colors()) mesh.colors.clear();
        scene_.place(std::move(mesh));
    }
    parts_.clear();
}

}  // namespace mir::detail
