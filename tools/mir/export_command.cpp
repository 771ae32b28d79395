// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "exit_code.hpp"
#include "load_scene.hpp"
#include "mir/io/gltf_writer.hpp"
#include "output_places.hpp"
#include "print_result.hpp"

namespace mirtool {

int run(const ExportOptions& options) {
    check_output_places({options.scene}, {options.output}, "export");
    const SceneAndReport loaded = load_scene(options.scene, options.limits);
    mir::write_glb(loaded.scene, options.output);
    print_result(options.output);
    return exit_done;
}

}  // namespace mirtool
