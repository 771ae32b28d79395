// SPDX-License-Identifier: MIT
#include "command_line.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "text.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

int main(int argc, char** argv) {
    try {
        const mirtool::Parsed parsed = mirtool::parse(argc, argv);
        if (const int* code = std::get_if<int>(&parsed)) return *code;
        const int code = std::visit([](const auto& options) { return mirtool::run(options); },
                                    std::get<mirtool::Command>(parsed));
        if (std::fflush(stdout) == 0) return code;
        std::fprintf(stderr, "mir: standard output cannot be written (%s); free space there\n",
                     std::strerror(errno));
    } catch (const mir::Error& e) {
        std::fprintf(stderr, "mir: %s\n", e.what());
        return mirtool::exit_code_of(e.code());
    } catch (const std::bad_alloc&) {
        std::fputs(
            "mir: out of memory (the picture or scene is too large for this machine); ask "
            "for fewer pixels, luxels or VPLs\n",
            stderr);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "mir: unexpected failure: %s\n", mirtool::shown(e.what()).c_str());
    }
    return mirtool::exit_failure;
}
