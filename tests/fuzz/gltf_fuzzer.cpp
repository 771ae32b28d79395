// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "fuzz/json_mutator.hpp"
#include "mir/io/gltf_reader.hpp"

#include <cstring>

/// libFuzzer's own changes of bytes.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t longest);

/// A .gltf or .glb without files beside it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto path = mirfuzz::input_file("scene.gltf", mirfuzz::text_of(data, size));
    mirfuzz::read_and_place([&] { return mir::read_gltf(path).scene; });
    return 0;
}

/// Half of the changes go by the structure of the JSON, where an input is JSON.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t longest, unsigned seed) {
    if (seed % 2 == 0) return LLVMFuzzerMutate(data, size, longest);
    const std::string changed = mirfuzz::JsonMutator(seed)(mirfuzz::text_of(data, size));
    if (changed.empty() || changed.size() > longest) return LLVMFuzzerMutate(data, size, longest);
    std::memcpy(data, changed.data(), changed.size());
    return changed.size();
}
