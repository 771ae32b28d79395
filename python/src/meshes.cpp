// SPDX-License-Identifier: MIT
#include "arrays.hpp"
#include "errors.hpp"
#include "scene.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>

namespace nb = nanobind;

namespace mirpy {
namespace {

/// Rows of three floats as values of T; one copy where the rows lie as the values do.
template <class T>
std::vector<T> triples(const FloatArray& rows) {
    static_assert(sizeof(T) == 3 * sizeof(float));
    std::vector<T> all(rows.size(0));
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = {rows.at(i, 0), rows.at(i, 1), rows.at(i, 2)};
    return all;
}

std::vector<mir::Vec3> unit_normals(nb::handle value, long vertices) {
    const FloatArray rows(value, "normals", {vertices, 3});
    std::vector<mir::Vec3> normals = triples<mir::Vec3>(rows);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const float length = glm::length(normals[i]);
        if (!(length > 0.0f))
            throw ArgumentError("normals", "number " + std::to_string(i) +
                                               " has no length; leave normals out of flat meshes");
        if (std::fabs(length - 1.0f) > 1e-6f) normals[i] /= length;
    }
    return normals;
}

std::vector<mir::Rgb> colors_of(nb::handle value, long vertices) {
    const FloatArray rows(value, "colors", {vertices, 3});
    std::vector<mir::Rgb> colors = triples<mir::Rgb>(rows);
    for (const mir::Rgb& c : colors)
        for (const float share : {c.r, c.g, c.b})
            if (share < 0.0f || share > 1.0f)
                throw ArgumentError("colors", "a colour lies outside of 0 to 1; give shares");
    return colors;
}

std::vector<mir::TriangleIndices> triangles_of(nb::handle value, std::size_t vertices) {
    const std::vector<std::uint32_t> flat = index_rows(value, "indices", 3, vertices);
    std::vector<mir::TriangleIndices> all(flat.size() / 3);
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) all[i][k] = flat[3 * i + k];
    return all;
}

mir::Mat4 transform_of(nb::handle value) {
    const FloatArray rows(value, "transform", {4, 4});
    mir::Mat4 m(1.0f);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            m[column][row] =
                rows.at(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    if (m[0][3] != 0.0f || m[1][3] != 0.0f || m[2][3] != 0.0f || m[3][3] != 1.0f)
        throw ArgumentError("transform", "its last row is not 0, 0, 0, 1; give an affine one");
    return m;
}

void check_index(std::size_t index, std::size_t count, const char* place) {
    if (index >= count)
        throw ArgumentError(place, "there is no number " + std::to_string(index) + " of " +
                                       std::to_string(count) + "; give what add_" + place +
                                       "() returned");
}

std::uint32_t add_mesh(PyScene& self, nb::handle vertices, nb::handle indices, nb::handle normals,
                       nb::handle uv, nb::handle colors, std::uint32_t material,
                       nb::handle transform, bool place, const std::string& name) {
    check_index(material, self.scene().materials.size(), "material");
    mir::Mesh mesh;
    mesh.name = name;
    mesh.material = material;
    const FloatArray positions(vertices, "vertices", {any_size, 3});
    const auto count = static_cast<long>(positions.size(0));
    mesh.positions = triples<mir::Vec3>(positions);
    mesh.triangles = triangles_of(indices, mesh.positions.size());
    if (!normals.is_none()) mesh.normals = unit_normals(normals, count);
    if (!colors.is_none()) mesh.colors = colors_of(colors, count);
    if (!uv.is_none()) {
        const FloatArray rows(uv, "uv", {count, 2});
        for (std::size_t i = 0; i < rows.size(0); ++i)
            mesh.texture_coordinates.emplace_back(rows.at(i, 0), rows.at(i, 1));
    }
    const mir::Mat4 to_world = transform.is_none() ? mir::Mat4(1.0f) : transform_of(transform);
    mir::Scene& scene = self.edit();
    if (place) return scene.place(std::move(mesh), to_world);
    scene.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

std::uint32_t add_instance(PyScene& self, std::uint32_t mesh, nb::handle transform) {
    check_index(mesh, self.scene().meshes.size(), "mesh");
    const mir::Mat4 to_world = transform_of(transform);
    mir::Scene& scene = self.edit();
    scene.instances.push_back({mesh, to_world});
    return static_cast<std::uint32_t>(scene.instances.size() - 1);
}

}  // namespace

void bind_meshes(nb::class_<PyScene>& scene) {
    scene
        .def("add_mesh", add_mesh, nb::arg("vertices").none(), nb::arg("indices").none(),
             nb::kw_only(), nb::arg("normals") = nb::none(), nb::arg("uv") = nb::none(),
             nb::arg("colors") = nb::none(), nb::arg("material") = 0,
             nb::arg("transform") = nb::none(), nb::arg("place") = true, nb::arg("name") = "",
             "Adds triangles of one material; returns the index of the mesh.\n\n"
             "vertices: (n, 3), metres. indices: (m, 3) whole numbers, counter-clockwise seen\n"
             "from the front. normals: (n, 3), of any length; without, triangles are flat.\n"
             "uv: (n, 2), (0, 0) is the top left of an image. colors: (n, 3) of 0..1, linear;\n"
             "they multiply the base colour. transform: (4, 4), affine, world = transform @\n"
             "(x, y, z, 1). place=False: it is not seen before add_instance().")
        .def("add_instance", add_instance, nb::arg("mesh"), nb::arg("transform").none(),
             "Places a mesh once more; returns the index of the instance.\n\n"
             "transform: (4, 4), affine.");
}

}  // namespace mirpy
