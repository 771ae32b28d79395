// SPDX-License-Identifier: MIT
#include "mir/io/gltf_writer.hpp"

#include "io/detail/gltf_build.hpp"
#include "io/detail/write_glb_model.hpp"
#include "mir/core/error.hpp"
#include "mir/io/detail/shown_path.hpp"

namespace mir {

void write_glb(const Scene& scene, const std::filesystem::path& path) {
    if (scene.environment)
        throw Error(ErrorCode::unsupported,
                    detail::shown_path(path) +
                        ": the scene cannot be written (glTF has no environment, and "
                        "the scene would lose its light); take it out of the scene");
    detail::write_glb_model(detail::GltfBuilder().build(scene), path);
}

}  // namespace mir
