// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

#include <CLI/CLI.hpp>

namespace mirtool {

/// Declares the arguments of `mir render` except for the scene. What is given goes to `options`.
void add_render(CLI::App& app, RenderOptions& options);

/// Declares those of them that say what the picture is, and not where it goes.
void add_picture(CLI::App& app, RenderOptions& options);

/// Declares the one that chooses for others.
void add_quality(CLI::App& app, RenderOptions& options);

/// Title of the options of --sampler mir.
inline constexpr const char* group_of_chains = "Markov chains (--sampler mir)";

/// Declares those of them that say how light is found.
void add_light(CLI::App& app, mir::RenderSettings& settings);

/// Declares the argument that lets a scene name any file.
void add_allow_outside(CLI::App& app, mir::Limits& limits);

/// Declares the arguments that put an environment around a scene.
void add_environment(CLI::App& app, EnvironmentOptions& options);

/// Declares the arguments of `mir compare`.
void add_compare(CLI::App& app, CompareOptions& options);

}  // namespace mirtool
