// SPDX-License-Identifier: MIT
#include "command_line.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "process.hpp"

#include <exception>

namespace {

int run_command(int argc, char** argv) {
    try {
        const mirtool::Parsed parsed = mirtool::parse(argc, argv);
        if (const int* code = std::get_if<int>(&parsed)) return *code;
        return std::visit([](const auto& options) { return mirtool::run(options); },
                          std::get<mirtool::Command>(parsed));
    } catch (const mir::Error& e) {
        mirtool::say_failure(e.what());
        return mirtool::exit_code_of(e.code());
    } catch (const std::exception& e) {
        mirtool::say_failure(mirtool::sentence_of(e));
    }
    return mirtool::exit_failure;
}

}  // namespace

int main(int argc, char** argv) {
    mirtool::prepare_process();
    return mirtool::end_results(run_command(argc, argv));
}
