// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "exit_code.hpp"
#include "load_scene.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/scene/environment_table.hpp"
#include "mir/scene/scene_hash.hpp"
#include "text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

/// "point_lights" of "point light".
std::string plural_key(std::string kind) {
    std::replace(kind.begin(), kind.end(), ' ', '_');
    return kind + "s";
}

Json counts_of(const mir::SceneReport& r) {
    Json counts{{"triangles", r.triangles},
                {"stored_triangles", r.stored_triangles},
                {"vertices", r.vertices},
                {"meshes", r.meshes},
                {"instances", r.instances},
                {"materials", r.materials},
                {"emitting_materials", r.emitting_materials},
                {"emitting_triangles", r.emitting_triangles}};
    for (std::size_t i = 0; i < r.listed_lights.size(); ++i)
        counts[plural_key(mir::ListedLights::names[i])] = r.listed_lights[i];
    counts["environments"] = r.environments;
    return counts;
}

Json cameras_of(const mir::SceneReport& r) {
    Json cameras = Json::array();
    for (const mir::CameraReport& c : r.cameras) {
        Json camera{{"name", c.name}, {"kind", c.kind}, {"usable", c.index.has_value()}};
        if (c.index) camera["index"] = *c.index;
        if (c.width > 0) camera["resolution"] = {c.width, c.height};
        cameras.push_back(camera);
    }
    return cameras;
}

Json vector_of(mir::DVec3 v) { return {v.x, v.y, v.z}; }

/// Size of the image around the scene, and mean radiance over all directions.
Json environment_of(const mir::Environment& e) {
    const mir::Extent size = e.radiance.extent();
    double sum[3] = {};
    for (std::uint32_t y = 0; y < size.height; ++y) {
        const double share = mir::detail::texel_solid_angle(size, y) / (4.0 * std::numbers::pi);
        for (std::uint32_t x = 0; x < size.width; ++x) {
            const mir::Rgb light = e.radiance(x, y) * e.scale;
            const float channels[3] = {light.r, light.g, light.b};
            for (int k = 0; k < 3; ++k) sum[k] += share * static_cast<double>(channels[k]);
        }
    }
    return {{"file", e.name},         {"width", size.width},
            {"height", size.height},  {"scale", e.scale},
            {"rotation", e.rotation}, {"mean_radiance", {sum[0], sum[1], sum[2]}}};
}

/// What the kd-tree of the scene looks like; takes as long as building it.
Json kd_tree_of(const mir::Scene& scene) {
    const mir::WorldGeometry geometry(scene);
    mir::TbbExecutor executor;
    const mir::KdTree tree(geometry, {}, executor);
    const mir::KdTreeStatistics& s = tree.statistics();
    return {{"triangles", s.triangles},
            {"nodes", s.nodes},
            {"leaves", s.leaves},
            {"empty_leaves", s.empty_leaves},
            {"references", s.references},
            {"depth", s.depth},
            {"largest_leaf", s.largest_leaf},
            {"triangles_per_leaf", s.triangles_per_leaf()},
            {"references_per_triangle", s.references_per_triangle()},
            {"bytes", s.bytes},
            {"bytes_per_triangle", s.bytes_per_triangle()},
            {"sah_cost", s.sah_cost},
            {"build_seconds", s.seconds()}};
}

void print_json(const std::string& name, const SceneAndReport& loaded, bool accel) {
    const mir::SceneReport& r = loaded.report;
    Json out{{"scene", name}, {"scene_hash", mir::SceneHash(loaded.scene).hex()}};
    out["counts"] = counts_of(r);
    const mir::DVec3 origin = loaded.scene.origin;
    if (!r.bounds.empty())
        out["bounds"] = {{"low", vector_of(origin + mir::DVec3(r.bounds.low))},
                         {"high", vector_of(origin + mir::DVec3(r.bounds.high))}};
    if (origin != mir::DVec3(0.0)) out["origin"] = vector_of(origin);
    out["cameras"] = cameras_of(r);
    if (loaded.scene.environment) out["environment"] = environment_of(*loaded.scene.environment);
    out["ignored"] = r.ignored;
    out["visible_effects"] = Json::object();
    for (const auto& [what, times] : r.ignored)
        out["visible_effects"][what] = mir::visible_effect(what);
    out["notes"] = r.notes;
    out["remarks"] = r.remarks;
    if (accel) out["kd_tree"] = kd_tree_of(loaded.scene);
    // Names need not be UTF-8; JSON must be. In ASCII no terminal obeys what it is shown.
    std::printf("%s\n", out.dump(2, ' ', true, Json::error_handler_t::replace).c_str());
}

/// One line per number.
void print_numbers(const Json& numbers) {
    for (const auto& [key, value] : numbers.items()) {
        std::string label = key;
        std::replace(label.begin(), label.end(), '_', ' ');
        const std::string number = value.is_number_float()
                                       ? std::to_string(value.get<double>())
                                       : std::to_string(value.get<std::uint64_t>());
        std::printf("  %-24s %s\n", label.c_str(), number.c_str());
    }
}

void print_text(const std::string& name, const SceneAndReport& loaded, bool accel) {
    const mir::SceneReport& r = loaded.report;
    std::printf("%s\n", shown(name).c_str());
    print_numbers(counts_of(r));
    const mir::DVec3 origin = loaded.scene.origin;
    const bool is_far = origin != mir::DVec3(0.0);
    const int digits = is_far ? 10 : 6;
    if (!r.bounds.empty())
        std::printf("  %-24s %s to %s m\n", "bounds",
                    place(origin + mir::DVec3(r.bounds.low), digits).c_str(),
                    place(origin + mir::DVec3(r.bounds.high), digits).c_str());
    if (is_far) std::printf("  %-24s %s m\n", "origin", place(origin).c_str());
    if (loaded.scene.environment) {
        const Json e = environment_of(*loaded.scene.environment);
        const Json& mean = e["mean_radiance"];
        std::printf("  %-24s %u x %u, mean radiance %.4g, %.4g, %.4g W/(m2 sr)\n", "environment",
                    e["width"].get<unsigned>(), e["height"].get<unsigned>(), mean[0].get<double>(),
                    mean[1].get<double>(), mean[2].get<double>());
    }
    for (const mir::CameraReport& c : r.cameras) {
        std::printf("  camera '%s': %s", c.name.c_str(), c.kind.c_str());
        if (c.width > 0) std::printf(", %u x %u", c.width, c.height);
        std::printf("%s\n", c.index ? "" : " (not supported)");
    }
    for (const auto& [what, times] : r.ignored)
        std::printf("  ignored: %s\n", ignored_text(what, times).c_str());
    for (const std::string& note : r.notes) std::printf("  note: %s\n", note.c_str());
    for (const std::string& remark : r.remarks) std::printf("  remark: %s\n", remark.c_str());
    if (!accel) return;
    std::printf("kd-tree\n");
    print_numbers(kd_tree_of(loaded.scene));
}

}  // namespace

int run(const InfoOptions& options) {
    const SceneAndReport loaded = load_scene(options.scene, options.limits, options.environment);
    if (options.json)
        print_json(options.scene, loaded, options.accel);
    else
        print_text(options.scene, loaded, options.accel);
    return exit_done;
}

}  // namespace mirtool
