// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/core/limits.hpp"
#include "mir/core/raw_allocator.hpp"
#include "mir/scene/bounds.hpp"
#include "mir/scene/detail/check_mesh.hpp"
#include "mir/scene/detail/lifted_corners.hpp"
#include "mir/scene/detail/mesh_parts.hpp"
#include "mir/scene/geometry_view.hpp"
#include "mir/scene/opacity_table.hpp"
#include "mir/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// All instances of a scene as triangles in world space. Ray engines are built from it, and it
/// turns their answers (triangle, barycentrics) into surface points. Immutable once made; const use
/// from any thread.
class WorldGeometry {
 public:
    /// Places every instance. Triangles without area are left out and counted. A lamp that lies in
    /// one place with a wall is lifted off it on every side from which it shines, and a lamp in one
    /// place with later lamps off those: what is seen there is the first lamp.
    /// @throws Error(invalid_input) on an index out of range, a coordinate that is not finite and
    ///         what OpacityTable refuses; Error(limit_exceeded) before memory is taken.
    template <Executor E>
    WorldGeometry(const Scene& scene, const Limits& limits, E& executor);

    /// The same on the calling thread.
    explicit WorldGeometry(const Scene& scene, const Limits& limits = {})
        : WorldGeometry(scene, limits, own_thread()) {}

    /// What kernels on the host read; valid until the geometry is moved or ends.
    [[nodiscard]] GeometryView<Space::host> view() const {
        return {positions_.data(),
                normals_.data(),
                triangles_.data(),
                materials_.data(),
                ray_offset_,
                texture_coordinates_.empty() ? nullptr : texture_coordinates_.data(),
                colors_.empty() ? nullptr : colors_.data()};
    }

    /// Says which triangles stop which segments. Ray engines ask it before they say that two points
    /// do not see each other. Valid until the geometry is moved or ends.
    [[nodiscard]] OpacityView<Space::host> opacity() const { return opacity_->view(view()); }
    /// Says which points of the triangles are there. Ray engines ask it before they accept a hit.
    /// Valid as long.
    [[nodiscard]] AlphaMaskView<Space::host> alpha_masks() const { return opacity().masks(); }
    /// True when every triangle stops all light: none has holes or is seen through.
    [[nodiscard]] bool is_opaque() const { return masks().empty() && see_through().empty(); }
    /// Of the materials; empty when none is masked.
    [[nodiscard]] std::span<const AlphaMask> masks() const { return opacity_->masks(); }
    /// Of the materials; empty when none is seen through.
    [[nodiscard]] std::span<const SeeThrough> see_through() const {
        return opacity_->see_through();
    }

    /// Vertices of all instances, one instance behind the other, metres.
    [[nodiscard]] std::span<const Vec3> positions() const { return positions_; }
    /// Unit normals of the vertices, zero where their mesh has none.
    [[nodiscard]] std::span<const Vec3> normals() const { return normals_; }
    /// Of the vertices, zero where their mesh has none; empty when no mesh has any.
    [[nodiscard]] std::span<const Vec2> texture_coordinates() const { return texture_coordinates_; }
    /// Of the vertices, white where their mesh has none; empty when no mesh has any.
    [[nodiscard]] std::span<const Rgb> colors() const { return colors_; }
    /// Indices into positions(), in the order of instances and their meshes. The backs of lamps
    /// that are split (is_split()) follow.
    [[nodiscard]] std::span<const TriangleIndices> triangles() const { return triangles_; }
    /// Material of each triangle.
    [[nodiscard]] std::span<const std::uint32_t> materials() const { return materials_; }
    /// Index into Scene::materials.
    [[nodiscard]] std::uint32_t material_of(std::uint32_t triangle) const {
        return materials_[triangle];
    }
    /// Of all vertices, those that no triangle uses included; metres.
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    /// Number of triangles that were left out, because they have no area.
    [[nodiscard]] std::uint64_t dropped_triangles() const { return dropped_; }
    /// Number of triangles that coincide with a lamp's, and of those lamps' own.
    [[nodiscard]] std::uint64_t coinciding_triangles() const { return coinciding_; }
    /// True for one half of a two-sided lamp that coincides with another surface. Each of its sides
    /// is a triangle that shines from its front only.
    [[nodiscard]] bool is_split(std::uint32_t triangle) const {
        return std::binary_search(split_.begin(), split_.end(), triangle);
    }

    /// Corner `k` (0..2) of a triangle, metres.
    [[nodiscard]] Vec3 corner(std::uint32_t triangle, std::uint32_t k) const {
        return view().corner(triangle, k);
    }

    /// Unit normal of the front of a triangle.
    [[nodiscard]] Vec3 front_normal(std::uint32_t triangle) const {
        return view().front_normal(triangle);
    }

    /// m^2.
    [[nodiscard]] float area(std::uint32_t triangle) const { return view().area(triangle); }

    /// Point of a triangle at barycentrics of its second and third corner. A ray that travels along
    /// `direction` sees it from far away.
    [[nodiscard]] SurfacePoint surface_point(std::uint32_t triangle, Vec2 barycentrics,
                                             Vec3 direction) const {
        return view().surface_point(triangle, barycentrics, direction);
    }
    /// The same, seen by a ray from its origin.
    [[nodiscard]] SurfacePoint surface_point(std::uint32_t triangle, Vec2 barycentrics,
                                             const Ray& ray) const {
        return view().surface_point(triangle, barycentrics, ray);
    }

    /// Largest distance by which points are lifted off surfaces, metres. It counts beyond what
    /// rounding asks for at their place (GeometryView::offset_at()): 2^-16 of the largest
    /// coordinate, eight times the sigma of accept_box.hpp. Shafts then see that a surface does not
    /// hide its own points (docs/shafts.md). Less in scenes that lie far from the origin, where
    /// that would show.
    [[nodiscard]] float ray_offset() const { return ray_offset_; }

 private:
    static InlineExecutor& own_thread() {
        static InlineExecutor executor;  // without state
        return executor;
    }

    using Part = detail::MeshPart;

    void place_attributes(const Scene& scene);
    [[nodiscard]] Bounds place_vertices(const Part& part);
    [[nodiscard]] std::uint32_t place_triangles(const Part& part);
    void close_gaps(const std::vector<Part>& parts, const std::vector<std::uint32_t>& kept);
    void lift_lamps(const Scene& scene, const detail::CoincidingLamps& lamps);
    [[nodiscard]] TriangleIndices add_corners(std::uint32_t triangle,
                                              const std::array<Vec3, 3>& places);

    template <class T>
    using Array = std::vector<T, RawAllocator<T>>;

    Array<Vec3> positions_;
    Array<Vec3> normals_;  ///< zero where the mesh has none
    std::vector<Vec2> texture_coordinates_;
    std::vector<Rgb> colors_;
    Array<TriangleIndices> triangles_;
    Array<std::uint32_t> materials_;
    std::shared_ptr<const OpacityTable> opacity_;  ///< copies share it
    Bounds bounds_;
    float ray_offset_ = 0.0f;
    std::uint64_t dropped_ = 0;
    std::uint64_t coinciding_ = 0;
    std::vector<std::uint32_t> split_;  ///< ascending
};

namespace detail {

inline float ray_offset_of(const Bounds& bounds) {
    if (bounds.empty()) return 0.0f;
    const float magnitude = larger(max_abs(bounds.low), max_abs(bounds.high));
    const float unseen = max_abs(bounds.high - bounds.low) * 0x1p-14f;
    return smaller(magnitude * 0x1p-16f, unseen);
}

/// `m` times the power of two that brings its largest element between 1 and 2. That rounds nothing,
/// and no product of two or three elements vanishes or overflows because the scale of `m` is small
/// or large.
inline Mat3 of_size_one(const Mat3& m) {
    const float size = larger(larger(max_abs(m[0]), max_abs(m[1])), max_abs(m[2]));
    if (!(size > 0.0f) || !is_finite(static_cast<double>(size))) return m;
    const int exponent = -std::ilogb(size);
    Mat3 scaled(0.0f);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            scaled[column][row] = std::ldexp(m[column][row], exponent);
    return scaled;
}

}  // namespace detail

template <Executor E>
WorldGeometry::WorldGeometry(const Scene& scene, const Limits& limits, E& executor)
    : opacity_(std::make_shared<const OpacityTable>(scene)) {
    for (const Mesh& mesh : scene.meshes) detail::check_mesh(scene, mesh);
    detail::check_instances(scene, limits);
    const detail::MeshParts parts = detail::mesh_parts(scene);
    const auto end_of = [](const std::vector<Part>& all) {
        return all.empty() ? 0u : all.back().to + all.back().count;
    };
    positions_.resize(end_of(parts.vertices));
    normals_.resize(positions_.size());
    std::vector<Bounds> bounds(parts.vertices.size());
    executor.for_each(bounds.size(),
                      [&](std::size_t i) { bounds[i] = place_vertices(parts.vertices[i]); });
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (bounds[i].empty())
            throw Error(ErrorCode::invalid_input,
                        "mesh " + detail::in_quotes(parts.vertices[i].mesh->name) +
                            ": an instance places it at infinity (its transform overflows); "
                            "repair the transform");
        bounds_.add(bounds[i].low);
        bounds_.add(bounds[i].high);
    }
    place_attributes(scene);
    triangles_.resize(end_of(parts.triangles));
    materials_.resize(triangles_.size());
    std::vector<std::uint32_t> kept(parts.triangles.size());
    executor.for_each(kept.size(),
                      [&](std::size_t i) { kept[i] = place_triangles(parts.triangles[i]); });
    close_gaps(parts.triangles, kept);
    // By way of a name: clang-tidy takes the member for one that the constructor could initialise.
    const Bounds& all = bounds_;
    ray_offset_ = detail::ray_offset_of(all);
    lift_lamps(scene, detail::LampFaceFinder(view(), static_cast<std::uint32_t>(triangles_.size()),
                                             detail::shining_of(scene))
                          .find(executor));
}

/// Bounds of what was placed; none when some of it lies at infinity.
inline Bounds WorldGeometry::place_vertices(const Part& part) {
    const Mesh& mesh = *part.mesh;
    const Mat4& to_world = part.instance->to_world;
    // Cofactors instead of the inverse transpose: they exist for flattened instances too. Their
    // sign does not matter, surface_point() turns normals to the geometric side.
    const Mat3 m = detail::of_size_one(Mat3(to_world));
    const Mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    Bounds bounds;
    for (std::uint32_t i = 0; i < part.count; ++i) {
        const std::uint32_t from = part.first + i;
        const Vec3 world = Vec3(to_world * Vec4(mesh.positions[from], 1.0f));
        if (!is_finite(world)) return {};
        positions_[part.to + i] = world;
        bounds.add(world);
        const Vec3 n = mesh.normals.empty() ? Vec3(0.0f) : cofactors * mesh.normals[from];
        const float length = glm::length(n);
        normals_[part.to + i] = length > 0.0f ? n / length : Vec3(0.0f);
    }
    return bounds;
}

/// Arrays that some mesh needs, as long as the positions.
inline void WorldGeometry::place_attributes(const Scene& scene) {
    const auto place = [&]<class T>(std::vector<T> Mesh::*from, std::vector<T>& to, T otherwise) {
        std::size_t first = 0;
        for (const Instance& instance : scene.instances) {
            const Mesh& mesh = scene.meshes[instance.mesh];
            const std::vector<T>& values = mesh.*from;
            if (!values.empty() && to.empty()) to.assign(positions_.size(), otherwise);
            if (!values.empty())
                std::copy(values.begin(), values.end(),
                          to.begin() + static_cast<std::ptrdiff_t>(first));
            first += mesh.positions.size();
        }
    };
    place(&Mesh::texture_coordinates, texture_coordinates_, Vec2(0.0f));
    place(&Mesh::colors, colors_, Rgb{1.0f, 1.0f, 1.0f});
}

/// Number of triangles with an area. They lie at the front of the part's place.
inline std::uint32_t WorldGeometry::place_triangles(const Part& part) {
    const bool mirrored =
        glm::determinant(detail::of_size_one(Mat3(part.instance->to_world))) < 0.0f;
    std::uint32_t to = part.to;
    for (std::uint32_t i = 0; i < part.count; ++i) {
        TriangleIndices t = part.mesh->triangles[part.first + i];
        if (mirrored) std::swap(t[1], t[2]);
        for (std::uint32_t& v : t) v += part.first_vertex;
        const Vec3 a = positions_[t[0]];
        const Vec3 cross = glm::cross(positions_[t[1]] - a, positions_[t[2]] - a);
        if (!(max_abs(cross) > 0.0f)) continue;
        triangles_[to] = t;
        materials_[to++] = part.mesh->material;
    }
    return to - part.to;
}

/// Moves the triangles that each part kept together, in their order.
inline void WorldGeometry::close_gaps(const std::vector<Part>& parts,
                                      const std::vector<std::uint32_t>& kept) {
    std::uint32_t end = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::uint32_t from = parts[i].to;
        if (from != end) {
            std::copy_n(triangles_.begin() + from, kept[i], triangles_.begin() + end);
            std::copy_n(materials_.begin() + from, kept[i], materials_.begin() + end);
        }
        end += kept[i];
    }
    dropped_ = triangles_.size() - end;
    triangles_.resize(end);
    materials_.resize(end);
}

/// Four times the distance at which surfaces coincide. What leaves a wall, or the lamp below, then
/// stays below the lamp before it.
inline void WorldGeometry::lift_lamps(const Scene& scene, const detail::CoincidingLamps& lamps) {
    coinciding_ = lamps.triangles;
    const std::vector<std::array<Vec3, 3>> corners =
        detail::lifted_corners(view(), lamps.faces, 4.0f * lamps.reach);
    std::vector<std::uint32_t> backs;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto& [triangle, front, level] = lamps.faces[i];
        TriangleIndices t = add_corners(triangle, corners[i]);
        if (front) {
            triangles_[triangle] = t;
            if (scene.materials[materials_[triangle]].emits_from_both_sides)
                split_.push_back(triangle);
            continue;
        }
        std::swap(t[1], t[2]);
        backs.push_back(static_cast<std::uint32_t>(triangles_.size()));
        triangles_.push_back(t);
        materials_.push_back(materials_[triangle]);
    }
    split_.insert(split_.end(), backs.begin(), backs.end());
}

/// Vertices with the attributes of those of `triangle`, at other places.
inline TriangleIndices WorldGeometry::add_corners(std::uint32_t triangle,
                                                  const std::array<Vec3, 3>& places) {
    TriangleIndices t = triangles_[triangle];
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto repeat = [v = t[k]](auto& values) {
            if (!values.empty()) values.push_back(values[v]);
        };
        repeat(normals_);
        repeat(texture_coordinates_);
        repeat(colors_);
        t[k] = static_cast<std::uint32_t>(positions_.size());
        positions_.push_back(places[k]);
        bounds_.add(places[k]);
    }
    return t;
}

}  // namespace mir
