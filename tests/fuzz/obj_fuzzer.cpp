// SPDX-License-Identifier: MIT
#include "fuzz/input_file.hpp"
#include "mir/io/obj_reader.hpp"

/// An OBJ file; what follows a line "%" is its material library, a.mtl.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::string_view border = "\n%\n";
    const std::string_view all = mirfuzz::text_of(data, size);
    const std::size_t cut = std::min(all.find(border), all.size());
    const std::size_t rest = std::min(cut + border.size(), all.size());
    const auto path = mirfuzz::input_file("a.obj", all.substr(0, cut));
    mirfuzz::input_file("a.mtl", all.substr(rest));
    mirfuzz::read_and_place([&] { return mir::read_obj(path).scene; });
    return 0;
}
