// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "mir/io/obj_reader.hpp"

#include <algorithm>

/// An OBJ file; what follows a line "%" is its material library, a.mtl, and what follows another
/// one an image, a.png.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view all = mirfuzz::text_of(data, size);
    const auto next_part = [&] {
        constexpr std::string_view border = "\n%\n";
        const std::string_view part = all.substr(0, all.find(border));
        all.remove_prefix(std::min(part.size() + border.size(), all.size()));
        return part;
    };
    const auto path = mirfuzz::input_file("a.obj", next_part());
    mirfuzz::input_file("a.mtl", next_part());
    mirfuzz::input_file("a.png", all);
    mirfuzz::read_and_place([&] { return mir::read_obj(path).scene; });
    return 0;
}
