// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/settings.hpp"

#include <string>
#include <vector>

namespace mirconvergence {

/// A sampler and its name in tables.
struct NamedSampler {
    std::string name;
    mir::SamplerKind kind;
};

/// What to render and compare.
struct Options {
    std::vector<std::string> scenes;  ///< builtin:NAME or glTF files
    mir::Extent size{128, 96};        ///< pixels
    std::vector<NamedSampler> samplers{{"ir", mir::SamplerKind::instant_radiosity},
                                       {"bir", mir::SamplerKind::bidirectional},
                                       {"mir", mir::SamplerKind::metropolis}};
    std::vector<std::uint32_t> vpls{64, 256, 1024};
    std::uint32_t seeds = 8;       ///< seeds 0 .. seeds - 1
    std::uint32_t samples = 4096;  ///< paths per pixel of the reference
    bool bounded = true;           ///< the default bound of the geometry term, else none
    mir::MetropolisTuning chains;  ///< how they run
    std::string cache;             ///< folder of references; empty: none is kept
    std::string images;            ///< folder of pictures; empty: none is written
    std::string montage;           ///< PNG of the pictures of seed 0; empty: none
    unsigned threads = 0;          ///< 0: every core
};

/// Reads the command line. Help and errors end in an exit code, and their text is already written.
struct ParsedOptions {
    Options options;
    int exit_code = -1;  ///< -1: go on
};
ParsedOptions parse(int argc, char** argv);

}  // namespace mirconvergence
