// SPDX-License-Identifier: MIT
#include "command_line.hpp"
#include "fuzz/input_file.hpp"
#include "mir/runtime/all_renderers.hpp"

#include <string>
#include <vector>

// The renderers are left out of this program; --version asks for this sentence alone.
std::string mir::cpu_description() { return "no renderer"; }

/// Words between line ends are arguments. Parsing either gives a command or an exit code.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> words{"mir", ""};
    for (const char c : mirfuzz::text_of(data, size)) {
        if (c == '\n')
            words.emplace_back();
        else if (c != '\0')
            words.back() += c;
    }
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const mirtool::Parsed parsed = mirtool::parse(static_cast<int>(words.size()), arguments.data());
    if (const int* code = std::get_if<int>(&parsed)) mirfuzz::require(*code >= 0 && *code < 128);
    return 0;
}
