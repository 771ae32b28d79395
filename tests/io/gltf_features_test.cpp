// SPDX-License-Identifier: MIT
#include "io/features/gltf_extensions.hpp"
#include "io/features/gltf_geometry.hpp"
#include "io/features/gltf_materials.hpp"
#include "io/features/gltf_scene.hpp"

using namespace mirtest;

TEST_CASE("every feature of glTF files, scenes, nodes and cameras has its outcome") {
    features::check_all(features::gltf_scenes());
}

TEST_CASE("every feature of glTF geometry has its outcome") {
    features::check_all(features::gltf_geometry());
}

TEST_CASE("every feature of glTF materials and images has its outcome") {
    features::check_all(features::gltf_appearance());
}

TEST_CASE("every extension of glTF has its outcome where it is used and where it is required") {
    for (const features::Extension& extension : features::gltf_extensions()) {
        INFO(extension.name << " " << extension.about);
        {
            INFO("used");
            features::check_outcome(extension.used, extension.when_used);
        }
        INFO("required");
        features::check_outcome(extension.required, extension.when_required);
    }
}
