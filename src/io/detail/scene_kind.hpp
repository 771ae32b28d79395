// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/read_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace mir::detail {

enum class SceneKind { gltf, obj, ply };

struct OtherFormat {
    std::string_view ending;
    const char* name;
};

/// Formats of other programs, which people try with good reason.
inline constexpr std::array<OtherFormat, 19> other_formats = {{
    {".fbx", "FBX"},     {".blend", "Blender"}, {".dae", "COLLADA"}, {".3ds", "3D Studio"},
    {".max", "3ds Max"}, {".usd", "USD"},       {".usda", "USD"},    {".usdc", "USD"},
    {".usdz", "USD"},    {".abc", "Alembic"},   {".stl", "STL"},     {".ma", "Maya"},
    {".mb", "Maya"},     {".c4d", "Cinema 4D"}, {".step", "STEP"},   {".stp", "STEP"},
    {".ifc", "IFC"},     {".pbrt", "pbrt"},     {".x3d", "X3D"},
}};

inline constexpr std::array<std::string_view, 5> pictures = {".exr", ".png", ".hdr", ".jpg",
                                                             ".jpeg"};

/// @throws Error(unsupported) when the name ends as that of a picture or another program's file.
inline void refuse_other_formats(const std::filesystem::path& path, std::string_view ending) {
    if (std::find(pictures.begin(), pictures.end(), ending) != pictures.end())
        throw Error(ErrorCode::unsupported,
                    path.string() +
                        ": it is a picture, not a scene (glTF, OBJ and PLY are read); "
                        "name the file of a scene");
    for (const OtherFormat& other : other_formats)
        if (ending == other.ending)
            throw Error(ErrorCode::unsupported,
                        path.string() + ": it is a file of " + other.name +
                            " (glTF, OBJ and PLY are read); open it in a program that knows it "
                            "and export it as .glb");
}

/// The first bytes of a regular file, none of anything else.
inline std::string first_bytes(const std::filesystem::path& path) {
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure)) return {};
    std::string bytes(64, '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return bytes;
}

/// The reader for the ending of a file's name, or its first bytes. Bytes decide where the name says
/// nothing. What is neither is left to the reader of glTF, which says what is wrong.
/// @throws Error(unsupported) for files of other programs.
inline SceneKind scene_kind(const std::filesystem::path& path) {
    const std::string ending = lower_case_extension(path);
    if (ending == ".obj") return SceneKind::obj;
    if (ending == ".ply") return SceneKind::ply;
    if (ending == ".gltf" || ending == ".glb" || ending == ".vrm") return SceneKind::gltf;
    refuse_other_formats(path, ending);
    const std::string bytes = first_bytes(path);
    const bool is_ply = bytes.rfind("ply\n", 0) == 0 || bytes.rfind("ply\r", 0) == 0;
    return is_ply ? SceneKind::ply : SceneKind::gltf;
}

}  // namespace mir::detail
