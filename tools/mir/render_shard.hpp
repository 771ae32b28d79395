// SPDX-License-Identifier: MIT
#pragma once

#include "load_scene.hpp"
#include "mir/core/monitor.hpp"
#include "mir/runtime/renderer.hpp"
#include "options.hpp"

#include <string>

namespace mirtool {

/// Decides the name of a shard, and checks that it can be written, before any work.
/// @throws mir::Error(io), or mir::Error(invalid_argument) for options that shards do not have.
std::string choose_shard(const RenderOptions& options);

/// Renders a shard into its file, or what --resume finds missing in it. Returns the exit code.
int render_shard(const std::string& name, const mir::Registry::Choice& choice,
                 const RenderOptions& options, const SceneAndReport& loaded, mir::Monitor& monitor);

}  // namespace mirtool
