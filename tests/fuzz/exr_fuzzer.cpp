// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "mir/core/limits.hpp"
#include "mir/io/exr.hpp"

/// An OpenEXR file of which the beauty is wanted.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto path = mirfuzz::input_file("a.exr", mirfuzz::text_of(data, size));
    try {
        // A kilobyte may hold 67 million flat pixels, which are read unless the caller forbids it.
        mir::Limits limits;
        limits.pixels = 1u << 22;
        const mir::ExrImage read = mir::read_exr(path, "", limits);
        mirfuzz::require(read.image.extent().area() > 0);
        mirfuzz::require(read.image.pixels().size() == read.image.extent().area());
    } catch (const mir::Error& refused) {
        mirfuzz::require(refused.code() != mir::ErrorCode::internal);
    }
    return 0;
}
