// SPDX-License-Identifier: MIT
//
// first_render SCENE OUTPUT.exr   renders a file under a sun, with the compiled renderers
#include <mir/io/exr.hpp>
#include <mir/io/scene_reader.hpp>
#include <mir/render.hpp>
#include <mir/runtime/frame_scene.hpp>

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: first_render SCENE OUTPUT.exr\n";
        return 2;
    }
    try {
        auto [scene, report] = mir::read_scene(argv[1]);
        mir::RenderSettings settings;
        settings.image = {320, 240};
        if (scene.cameras.empty())
            scene.cameras.push_back(mir::frame_scene(scene, settings.aspect()).camera);
        scene.directional_lights.push_back({"sun", {0.0f, -0.6f, -0.8f}, {3.0f, 3.0f, 3.0f}});

        const mir::RenderResult result = mir::render(scene, settings);
        mir::write_exr(argv[2], settings.image, {{"", &result.beauty}});
        for (const std::string& warning : result.warnings) std::cerr << warning << '\n';
    } catch (const std::exception& e) {
        std::cerr << "first_render: " << e.what() << '\n';
        return 1;
    }
}
