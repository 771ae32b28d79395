// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "mir/io/gltf_reader.hpp"

/// A .gltf or .glb without files beside it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto path = mirfuzz::input_file("scene.gltf", mirfuzz::text_of(data, size));
    mirfuzz::read_and_place([&] { return mir::read_gltf(path).scene; });
    return 0;
}
