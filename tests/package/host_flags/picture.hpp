// SPDX-License-Identifier: MIT
#pragma once

#include <string>

// What a library of the host offers, whatever it hides of mir.
#pragma GCC visibility push(default)

/// A fingerprint of each picture that the core renders by itself: kd-tree and shafts, chains,
/// gathering luxel by luxel and in blocks, film.
std::string fingerprints();

/// Values that are no numbers and that the library takes without an error, a line each.
std::string accepted_values();

/// @throws mir::Error(unsupported)
void fail();

#pragma GCC visibility pop
