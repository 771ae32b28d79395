// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/shard_manifest.hpp"
#include "options.hpp"

#include <string>

namespace mirtool {

/// The build of this program, as far as pictures depend on it. Instruction sets change no bit.
std::string program_build();

/// Tells a shard how its picture is to be written.
void put_words(const RenderOptions& options, mir::ShardManifest& manifest);

/// The options of the picture of a shard, without those that name files.
/// @throws mir::Error(invalid_input) for words that this program cannot read.
RenderOptions options_of(const mir::ShardManifest& manifest);

}  // namespace mirtool
