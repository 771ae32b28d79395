// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_options.hpp"
#include "mir/accel/wide/wide_options.hpp"
#include "mir/data/tile.hpp"

#include <string>
#include <vector>

namespace mirpaper {

/// What the command line asks for.
struct Options {
    std::vector<std::string> figures;   ///< in the order in which they are made
    std::vector<std::string> backends;  ///< empty: all that exist
    std::vector<std::string> scenes;    ///< empty: those of each figure
    std::vector<std::uint32_t> vpls;    ///< empty: those of each figure
    mir::Extent size{1600, 1200};
    unsigned repeat = 20;
    unsigned host_repeat = 3;  ///< where rays are traced on the host
    unsigned threads = 0;      ///< 0: every core
    mir::KdTreeOptions tree = mir::KdTreeOptions::for_gpu();
    mir::WideBvhOptions wide;
    std::string out;  ///< folder; empty: tables on stdout alone

    [[nodiscard]] bool wants(const std::string& figure) const;
};

struct ParsedOptions {
    Options options;
    bool help = false;
    std::string error;  ///< one line, empty when all is well
};

ParsedOptions parse(int argc, const char* const* argv);

/// What --help prints.
std::string usage();

}  // namespace mirpaper
