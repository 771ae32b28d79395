// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "mir/io/ply_reader.hpp"

/// A PLY file of any format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto path = mirfuzz::input_file("a.ply", mirfuzz::text_of(data, size));
    mirfuzz::read_and_place([&] { return mir::read_ply(path).scene; });
    return 0;
}
