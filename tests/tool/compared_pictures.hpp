// SPDX-License-Identifier: MIT
#pragma once

#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace mirtest::compared {

using Picture = mir::Image<mir::Rgb>;

inline constexpr mir::Extent size{24, 16};

/// A picture of one grey.
inline Picture plain(float light) { return Picture(size, mir::Rgb{light, light, light}); }

/// Writes a picture, and its half as layer "half".
inline std::string store(const std::filesystem::path& path, const Picture& picture) {
    Picture half = picture;
    for (mir::Rgb& pixel : half.pixels()) pixel = pixel * 0.5f;
    mir::write_exr(path, picture.extent(), {{"", &picture}, {"half", &half}});
    return path.string();
}

/// Two pictures in a folder of their own: b is 0.5 everywhere, a is 0.6 except in one pixel.
struct Pictures {
    TemporaryFolder folder{"compare"};
    std::string a;
    std::string b;

    Pictures() {
        Picture image = plain(0.6f);
        image(5, 7).g = 2.5f;
        a = store(folder / "a.exr", image);
        b = store(folder / "b.exr", plain(0.5f));
    }
};

/// Runs `mir compare`.
inline Outcome compare(const Words& arguments) { return run_mir(Words{"compare"} + arguments); }

/// What `mir compare --json` prints of pictures that can be compared.
inline nlohmann::json metrics(const Words& arguments) {
    const Outcome outcome = compare(arguments + Words{"--json"});
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    return nlohmann::json::parse(outcome.out);
}

}  // namespace mirtest::compared
