// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "exit_code.hpp"
#include "load_scene.hpp"
#include "mir/io/gltf_writer.hpp"
#include "print_result.hpp"

namespace mirtool {

int run(const ExportOptions& options) {
    const SceneAndReport loaded = load_scene(options.scene, options.limits);
    mir::write_glb(loaded.scene, options.output);
    print_result(options.output);
    return exit_done;
}

}  // namespace mirtool
