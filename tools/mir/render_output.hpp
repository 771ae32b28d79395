// SPDX-License-Identifier: MIT
#pragma once

#include "convergence.hpp"
#include "denoising.hpp"
#include "mir/io/png.hpp"
#include "mir/runtime/result.hpp"
#include "options.hpp"

#include <string>

namespace mirtool {

/// Where the pictures of a render go.
struct OutputPaths {
    std::string exr;
    std::string png;  ///< empty: no preview
};

/// The journal of --resume; empty without.
std::string journal_of(const RenderOptions& options, const OutputPaths& paths);

/// Decides the names and checks that all can be written, before any work.
/// @throws mir::Error(io or invalid_argument).
OutputPaths choose_outputs(const RenderOptions& options);

/// How the preview of a picture looks.
mir::PreviewLook preview_look(const RenderOptions& options, const mir::Image<mir::Rgb>& picture);

/// Writes EXR and preview. Both appear complete or not at all.
void write_outputs(const OutputPaths& paths, const mir::RenderResult& result,
                   const RenderOptions& options);

/// Largest resident set of the process so far.
std::uint64_t peak_memory_bytes();

/// Statistics for people, on stderr, what the light is made of, and warnings.
void print_summary(const mir::RenderResult& result, const mir::RenderSettings& settings);

/// Statistics for programs, on stdout.
void print_json(const OutputPaths& paths, const mir::RenderResult& result,
                const RenderOptions& options, const Convergence& convergence,
                const Denoising& denoising);

}  // namespace mirtool
