// SPDX-License-Identifier: MIT
#include "load_scene.hpp"

#include "mir/io/exr.hpp"
#include "mir/io/scene_reader.hpp"
#include "mir/scene/environment_table.hpp"
#include "mir/scenes.hpp"

#include <filesystem>

namespace mirtool {
namespace {

constexpr std::string_view builtin_prefix = "builtin:";

SceneAndReport load_builtin(const std::string& name) {
    SceneAndReport loaded;
    loaded.scene = mir::builtin::make(name);
    mir::count_scene(loaded.scene, loaded.report);
    for (std::uint32_t i = 0; i < loaded.scene.cameras.size(); ++i)
        loaded.report.cameras.push_back({loaded.scene.cameras[i].name, "perspective", i});
    return loaded;
}

SceneAndReport load_file(const std::string& name, const mir::Limits& limits) {
    mir::LoadedScene loaded = mir::read_scene(name, limits);
    return {std::move(loaded.scene), std::move(loaded.report)};
}

/// The surroundings of the scene, checked while the file's name is known.
mir::Environment read_environment(const EnvironmentOptions& o, const mir::Limits& limits) {
    mir::Environment environment;
    environment.name = o.file;
    environment.radiance = mir::read_exr(o.file, "", limits).image;
    environment.scale = o.scale;
    environment.rotation = o.rotation;
    static_cast<void>(mir::EnvironmentTable(environment));
    return environment;
}

}  // namespace

void put_environment(SceneAndReport& loaded, const EnvironmentOptions& environment,
                     const mir::Limits& limits) {
    mir::put_around(loaded.scene, read_environment(environment, limits), loaded.report);
}

SceneAndReport load_scene(const std::string& name, const mir::Limits& limits,
                          const EnvironmentOptions& environment) {
    try {
        SceneAndReport loaded = name.starts_with(builtin_prefix)
                                    ? load_builtin(name.substr(builtin_prefix.size()))
                                    : load_file(name, limits);
        if (!environment.file.empty()) put_environment(loaded, environment, limits);
        return loaded;
    } catch (const mir::Error& e) {
        // Whatever a scene does wrong is the input's fault here, not that of the command line.
        if (e.code() == mir::ErrorCode::limit_exceeded ||
            e.code() == mir::ErrorCode::invalid_argument)
            throw mir::Error(mir::ErrorCode::invalid_input, e.what(), e.where());
        throw;
    }
}

std::string stem_of(const std::string& name) {
    if (name.starts_with(builtin_prefix)) return name.substr(builtin_prefix.size());
    return std::filesystem::path(name).stem().string();
}

}  // namespace mirtool
