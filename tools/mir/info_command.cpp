// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "exit_code.hpp"
#include "load_scene.hpp"
#include "mir/scene/scene_hash.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

Json counts_of(const mir::SceneReport& r) {
    return {{"triangles", r.triangles},
            {"stored_triangles", r.stored_triangles},
            {"vertices", r.vertices},
            {"meshes", r.meshes},
            {"instances", r.instances},
            {"materials", r.materials},
            {"emitting_materials", r.emitting_materials},
            {"emitting_triangles", r.emitting_triangles},
            {"point_lights", r.point_lights},
            {"spot_lights", r.spot_lights},
            {"directional_lights", r.directional_lights}};
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

Json vector_of(mir::Vec3 v) { return {v.x, v.y, v.z}; }

void print_json(const std::string& name, const SceneAndReport& loaded) {
    const mir::SceneReport& r = loaded.report;
    Json out{{"scene", name}, {"scene_hash", mir::SceneHash(loaded.scene).hex()}};
    out["counts"] = counts_of(r);
    if (!r.bounds.empty())
        out["bounds"] = {{"low", vector_of(r.bounds.low)}, {"high", vector_of(r.bounds.high)}};
    out["cameras"] = cameras_of(r);
    out["ignored"] = r.ignored;
    out["notes"] = r.notes;
    // Names in files need not be UTF-8; JSON must be.
    std::printf("%s\n", out.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

void print_text(const std::string& name, const SceneAndReport& loaded) {
    const mir::SceneReport& r = loaded.report;
    std::printf("%s\n", name.c_str());
    const Json counts = counts_of(r);
    for (const auto& [key, value] : counts.items()) {
        std::string label = key;
        std::replace(label.begin(), label.end(), '_', ' ');
        std::printf("  %-20s %llu\n", label.c_str(), value.get<unsigned long long>());
    }
    if (!r.bounds.empty())
        std::printf("  %-20s (%g, %g, %g) to (%g, %g, %g) m\n", "bounds", r.bounds.low.x,
                    r.bounds.low.y, r.bounds.low.z, r.bounds.high.x, r.bounds.high.y,
                    r.bounds.high.z);
    for (const mir::CameraReport& c : r.cameras) {
        std::printf("  camera '%s': %s", c.name.c_str(), c.kind.c_str());
        if (c.width > 0) std::printf(", %u x %u", c.width, c.height);
        std::printf("%s\n", c.index ? "" : " (not supported)");
    }
    for (const auto& [what, times] : r.ignored)
        std::printf("  ignored: %s (%llu)\n", what.c_str(), static_cast<unsigned long long>(times));
    for (const std::string& note : r.notes) std::printf("  note: %s\n", note.c_str());
}

}  // namespace

int run(const InfoOptions& options) {
    const SceneAndReport loaded = load_scene(options.scene);
    if (options.json)
        print_json(options.scene, loaded);
    else
        print_text(options.scene, loaded);
    return exit_done;
}

}  // namespace mirtool
