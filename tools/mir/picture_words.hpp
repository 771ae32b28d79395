// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "options.hpp"

#include <string>
#include <utility>
#include <vector>

namespace mirtool {

/// A setting that cannot be used: the error says which.
struct SettingError : mir::Error {
    /// `name` as the command line has it, such as "--vpls"; empty where none is to blame.
    SettingError(const std::string& what, std::string name)
        : mir::Error(mir::ErrorCode::invalid_argument, what), setting(std::move(name)) {}

    std::string setting;  ///< as the command line calls it
};

/// Reads what a picture is to be from words of the command line, such as "--vpls=256".
/// @throws SettingError in the words of the command line.
RenderOptions read_picture_words(const std::vector<std::string>& words);

}  // namespace mirtool
