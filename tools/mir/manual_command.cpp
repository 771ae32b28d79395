// SPDX-License-Identifier: MIT
#include "command_line.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "manual/pages.hpp"

#include <cstdio>

namespace mirtool {

namespace {

std::string text_in(ManualOptions::Language language) {
    const CommandFacts program = program_facts();
    switch (language) {
        case ManualOptions::Language::bash:
            return bash_completion(program);
        case ManualOptions::Language::zsh:
            return zsh_completion(program);
        case ManualOptions::Language::fish:
            return fish_completion(program);
        default:
            return man_page(program);
    }
}

}  // namespace

int run(const ManualOptions& options) {
    std::fputs(text_in(options.language).c_str(), stdout);
    return exit_done;
}

}  // namespace mirtool
