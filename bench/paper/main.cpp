// SPDX-License-Identifier: MIT
//
// The measurements of section 6 of the 2009 paper: docs/decisions/021.
#include "mir/core/error.hpp"
#include "options.hpp"
#include "report.hpp"
#include "study.hpp"

#include <cstdio>

namespace {

int fail(const std::exception& e, int exit_code) {
    std::fprintf(stderr, "bench_paper: %s\n", e.what());
    return exit_code;
}

}  // namespace

int main(int argc, char** argv) {
    const mirpaper::ParsedOptions parsed = mirpaper::parse(argc, argv);
    if (parsed.help) {
        std::fputs(mirpaper::usage().c_str(), stdout);
        return 0;
    }
    if (!parsed.error.empty()) {
        std::fprintf(stderr, "bench_paper: %s\n", parsed.error.c_str());
        return 2;
    }
    try {
        const std::string& out = parsed.options.out;
        const auto keep = [&](const mirpaper::Results& results) {
            if (!out.empty()) mirpaper::write_reports(results, out);
        };
        const mirpaper::Results results = mirpaper::run_study(parsed.options, keep);
        std::fputs(mirpaper::markdown_of(results).c_str(), stdout);
    } catch (const mir::Error& e) {
        return fail(e, e.code() == mir::ErrorCode::no_device ? 4 : 1);
    } catch (const std::exception& e) {
        return fail(e, 1);
    }
    return 0;
}
