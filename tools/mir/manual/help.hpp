// SPDX-License-Identifier: MIT
#pragma once

#include "manual/command_facts.hpp"

#include <CLI/CLI.hpp>

#include <string>
#include <utility>
#include <vector>

namespace mirtool {

/// What --help and --help-all print, in lines of at most 80 columns.
class Help : public CLI::FormatterBase {
 public:
    Help() = default;
    /// `first`: long names of the options that --help shows; --help-all shows all.
    explicit Help(std::vector<std::string> first) : first_(std::move(first)) {}

    [[nodiscard]] std::string make_help(const CLI::App* app, std::string name,
                                        CLI::AppFormatMode mode) const override;

 private:
    std::vector<std::string> first_;
};

}  // namespace mirtool
