// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/ply_values.hpp"
#include "io/detail/polygon.hpp"
#include "io/detail/unit_direction.hpp"
#include "mir/scene/mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// The code of a full channel. Colours are whole numbers of 8 or 16 bits, or shares.
constexpr double ply_white(PlyType type) {
    if (type == PlyType::float32 || type == PlyType::float64) return 1.0;
    return ply_size(type) == 2 ? 65535.0 : 255.0;
}

/// Converts the elements of one PLY file to a mesh.
class PlyMesh {
 public:
    /// @pre check_ply_counts() was content.
    PlyMesh(std::string_view file, const PlyHeader& header, const Limits& limits,
            SceneReport& report)
        : values_(file, header), header_(header), limits_(limits), report_(report) {}

    /// @throws Error(invalid_input), Error(limit_exceeded)
    [[nodiscard]] Mesh convert() {
        bool has_vertices = false;
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                has_vertices = true;
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else {
                if (element.count > 0) ignore("PLY element " + in_quotes(element.name));
                for_each(element, [&] {
                    for (const PlyProperty& p : element.properties) skip(p);
                });
            }
        }
        if (!has_vertices)
            fail_at("header", "it has no element 'vertex' (so there is no mesh); export it again");
        return std::move(mesh_);
    }

 private:
    /// What the numbers of a vertex mean, in the order of Slots.
    static constexpr std::array<std::string_view, 9> slot_names = {
        "x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"};
    using Slots = std::array<double, slot_names.size()>;
    static constexpr std::size_t no_slot = slot_names.size();

    void ignore(const std::string& what) { ++report_.ignored[what]; }

    /// Calls `read` for each, and names the one at which it fails.
    template <class Read>
    void for_each(const PlyElement& element, const Read& read) {
        std::uint64_t i = 0;
        try {
            for (; i < element.count; ++i) read();
        } catch (const Error& error) {
            throw Error(error.code(),
                        "element " + in_quotes(element.name) + ", number " + std::to_string(i) +
                            error.what(),
                        error.where());
        }
    }
    void skip(const PlyProperty& property) {
        if (property.count_type)
            values_.next_list(property, list_);
        else
            (void)values_.next(property.type);
    }

    [[nodiscard]] std::vector<std::size_t> slots_of(const PlyElement& vertex);
    void read_vertices(const PlyElement& element);
    void read_faces(const PlyElement& element);
    void add_face();

    PlyValues values_;
    const PlyHeader& header_;
    const Limits& limits_;
    SceneReport& report_;
    Mesh mesh_;
    PolygonCutter cutter_;
    std::vector<double> list_;
    std::vector<Vec3> outline_;
};

/// Slot of each property; others are counted.
inline std::vector<std::size_t> PlyMesh::slots_of(const PlyElement& vertex) {
    std::vector<std::size_t> slots;
    std::array<bool, no_slot> has{};
    for (const PlyProperty& p : vertex.properties) {
        std::size_t slot = 0;
        while (slot < no_slot && (p.count_type || p.name != slot_names[slot])) ++slot;
        if (slot < no_slot && has[slot])
            fail_at("header", "element 'vertex' has property " + in_quotes(p.name) +
                                  " twice; repair the header");
        if (slot < no_slot)
            has[slot] = true;
        else
            ignore("PLY vertex property " + in_quotes(p.name));
        slots.push_back(slot);
    }
    if (!has[0] || !has[1] || !has[2])
        fail_at("header",
                "element 'vertex' lacks one of the properties x, y and z (so there is no "
                "place); export it again");
    // A direction or a colour is whole or none.
    const auto is_whole = [&](std::size_t first) {
        if (has[first] && has[first + 1] && has[first + 2]) return true;
        for (std::size_t k = first; k < first + 3; ++k)
            if (has[k]) ignore("PLY vertex property " + in_quotes(slot_names[k]));
        return false;
    };
    if (is_whole(3)) mesh_.normals.reserve(vertex.count);
    if (is_whole(6)) mesh_.colors.reserve(vertex.count);
    return slots;
}

inline void PlyMesh::read_vertices(const PlyElement& element) {
    check_limit(element.count, limits_.vertices, "vertices");
    const std::vector<std::size_t> slots = slots_of(element);
    const bool has_normals = mesh_.normals.capacity() > 0;
    const bool has_colors = mesh_.colors.capacity() > 0;
    mesh_.positions.reserve(element.count);
    for_each(element, [&] {
        Slots v{};
        for (std::size_t k = 0; k < slots.size(); ++k) {
            const PlyProperty& p = element.properties[k];
            if (slots[k] == no_slot)
                skip(p);
            else
                v[slots[k]] = checked_float(values_.next(p.type), p.name.c_str(), "") /
                              (slots[k] >= 6 ? ply_white(p.type) : 1.0);
        }
        mesh_.positions.emplace_back(v[0], v[1], v[2]);
        if (has_normals) mesh_.normals.push_back(unit_direction(Vec3(v[3], v[4], v[5])));
        if (has_colors)
            mesh_.colors.push_back(linear_color(v[6], v[7], v[8], "vertex colour", "", report_));
    });
}

inline void PlyMesh::read_faces(const PlyElement& element) {
    for (const PlyProperty& p : element.properties)
        if (p.name != "vertex_indices" && p.name != "vertex_index")
            ignore("PLY face property " + in_quotes(p.name));
    for_each(element, [&] {
        for (const PlyProperty& p : element.properties) {
            skip(p);
            if (p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index"))
                add_face();
        }
    });
}

/// Adds the face whose vertices are in `list_`.
inline void PlyMesh::add_face() {
    if (list_.size() < 3) return ignore("face of fewer than three corners");
    outline_.clear();
    for (double index : list_) {
        const auto n = static_cast<double>(mesh_.positions.size());
        if (!(index >= 0.0 && index < n) || index != std::floor(index))
            fail_here("it names vertex " + shortest_text(index) + ", but there are " +
                      std::to_string(mesh_.positions.size()) +
                      " (counted from 0); repair or export the file again");
        outline_.push_back(mesh_.positions[static_cast<std::size_t>(index)]);
    }
    if (mesh_.triangles.size() + list_.size() - 2 > limits_.triangles)
        fail_at("",
                "more than " + std::to_string(limits_.triangles) +
                    " triangles (Limits::triangles allows no more); use a smaller mesh",
                ErrorCode::limit_exceeded);
    const auto vertex = [&](std::uint32_t corner) {
        return static_cast<std::uint32_t>(list_[corner]);
    };
    for (const TriangleIndices& t : cut_polygon(cutter_, outline_, ""))
        mesh_.triangles.push_back({vertex(t[0]), vertex(t[1]), vertex(t[2])});
}

}  // namespace mir::detail
