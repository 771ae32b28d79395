// SPDX-License-Identifier: MIT
#include "mir/io/ply_reader.hpp"

#include "io/detail/ply_mesh.hpp"
#include "io/detail/read_file.hpp"
#include "io/detail/unknown_surface.hpp"
#include "mir/scene/recentre.hpp"

#include <string_view>
#include <utility>

namespace mir {

namespace detail {
namespace {

LoadedScene load_ply(const std::filesystem::path& path, const Limits& limits) {
    FileBudget budget(limits);
    const Bytes bytes = read_whole_file(path, budget);
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const PlyHeader header = PlyHeaderReader(file).read();
    check_ply_counts(header, bytes.size());
    LoadedScene loaded;
    loaded.scene.name = path.stem().string();
    Mesh mesh = PlyMesh(file, header, limits, loaded.report).convert();
    mesh.name = loaded.scene.name;
    mesh.material = loaded.scene.add(unknown_surface("PLY default", !mesh.colors.empty()));
    if (!mesh.triangles.empty()) loaded.scene.place(std::move(mesh));
    loaded.report.remarks = recentre(loaded.scene);
    count_scene(loaded.scene, loaded.report);
    return loaded;
}

}  // namespace
}  // namespace detail

LoadedScene read_ply(const std::filesystem::path& path, const Limits& limits) {
    return detail::naming_file(path, "PLY", [&] { return detail::load_ply(path, limits); });
}

}  // namespace mir
