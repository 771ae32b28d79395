// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <string>
#include <utility>

namespace mirpy {

/// An argument that cannot be used: the error says which.
struct ArgumentError : mir::Error {
    /// `reason` says what is wrong with the argument, and what to do.
    ArgumentError(std::string argument, const std::string& reason)
        : mir::Error(mir::ErrorCode::invalid_argument, argument + ": " + reason),
          place(std::move(argument)) {}

    std::string place;  ///< name of the argument
};

/// The code that Python calls so; `internal` where there is none.
[[nodiscard]] mir::ErrorCode code_named(const std::string& name);

/// Lets errors of the library arrive in Python as mir.Error.
void register_errors();

}  // namespace mirpy
