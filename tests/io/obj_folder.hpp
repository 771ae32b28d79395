// SPDX-License-Identifier: MIT
#pragma once

#include "io/gltf_fixture.hpp"
#include "io/obj_fixture.hpp"
#include "mir/io/obj_reader.hpp"
#include "support/catch.hpp"
#include "support/textured_scene.hpp"

#include <png.h>

#include <string>
#include <vector>

namespace mirtest {

/// RGBA of 8 bits each, rows from the top.
using Texels = std::vector<std::uint32_t>;

/// 4 x 2 texels, rows from the top: no two are equal.
inline const Texels eight_colors = {texel(255, 0, 0),  texel(0, 255, 0),    texel(0, 0, 255),
                                    texel(10, 20, 30), texel(40, 50, 60),   texel(70, 80, 90),
                                    texel(1, 2, 3),    texel(200, 210, 220)};

/// RGBA of 8 bits; a texel has the order of bytes that PNG has on this machine.
inline void write_png(const std::filesystem::path& path, std::uint32_t width, std::uint32_t height,
                      const Texels& texels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = PNG_FORMAT_RGBA;
    REQUIRE(png_image_write_to_file(&image, path.c_str(), 0, texels.data(), 0, nullptr) != 0);
}

/// A square whose texture coordinates are x and y, of a material with these lines.
inline const std::string textured_square =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl a\nf 1/1 2/2 3/3 4/4\n";

/// A folder with an image of eight colours, for an OBJ file and its material.
class ObjFolder {
 public:
    ObjFolder() { write_png(folder_ / "colors.png", 4, 2, eight_colors); }

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return folder_ / name;
    }
    [[nodiscard]] mir::LoadedScene read(const std::string& lines, const mir::Limits& limits = {},
                                        const std::string& obj = textured_square) const {
        write_file(folder_ / "a.mtl", "newmtl a\n" + lines + "\n");
        write_file(folder_ / "a.obj", obj);
        return mir::read_obj(folder_ / "a.obj", limits);
    }
    [[nodiscard]] mir::Material material(const std::string& lines) const {
        return read(lines).scene.materials.at(0);
    }

 private:
    TemporaryFolder folder_{"obj_textures"};
};

}  // namespace mirtest
