// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>

namespace mirconvergence {
namespace {

mir::Extent read_size(const std::string& text) {
    const char* const end = text.data() + text.size();
    mir::Extent size;
    const auto width = std::from_chars(text.data(), end, size.width);
    if (width.ec == std::errc() && width.ptr != end && *width.ptr == 'x') {
        const auto height = std::from_chars(width.ptr + 1, end, size.height);
        const bool good = height.ec == std::errc() && height.ptr == end;
        if (good && size.width - 1 < 65536 && size.height - 1 < 65536) return size;
    }
    throw CLI::ValidationError("--size",
                               "'" + text + "' is no size; give WIDTHxHEIGHT, such as 128x96");
}

std::vector<NamedSampler> choose_samplers(const std::vector<std::string>& names) {
    const std::vector<NamedSampler> known = Options().samplers;
    std::vector<NamedSampler> chosen;
    for (const std::string& name : names) {
        const auto found = std::find_if(known.begin(), known.end(),
                                        [&](const NamedSampler& s) { return s.name == name; });
        if (found == known.end())
            throw CLI::ValidationError("--samplers",
                                       "'" + name + "' is unknown; choose of ir,bir,mir");
        chosen.push_back(*found);
    }
    return chosen;
}

void add_options(CLI::App& app, Options& o) {
    app.add_option("--scene", o.scenes, "builtin:NAME or a glTF file; several are done in turn")
        ->required();
    app.add_option_function<std::string>(
           "--size", [&o](const std::string& text) { o.size = read_size(text); },
           "Pixels (default 128x96)")
        ->type_name("WIDTHxHEIGHT");
    app.add_option_function<std::vector<std::string>>(
           "--samplers",
           [&o](const std::vector<std::string>& names) { o.samplers = choose_samplers(names); },
           "Of ir, bir and mir (default all)")
        ->delimiter(',');
    app.add_option("--vpls", o.vpls, "Numbers of VPLs (default 64,256,1024)")
        ->delimiter(',')
        ->check(CLI::Range(1, 4000000));
    app.add_option("--seeds", o.seeds, "Renders of each kind (default 8)")
        ->check(CLI::Range(1, 1000000));
    app.add_option("--samples", o.samples, "Paths per pixel of the reference (default 4096)")
        ->check(CLI::Range(1, 1 << 24));
    app.add_option_function<std::string>(
           "--bound", [&o](const std::string& text) { o.bounded = text == "auto"; },
           "Bound of the geometry term: auto (default) or none")
        ->check(CLI::IsMember({"auto", "none"}));
    app.add_option("--chains", o.chains.chains, "Markov chains (default as mir render)")
        ->check(CLI::Range(1, 65536));
    app.add_option("--bootstrap-error", o.chains.bootstrap.relative_error,
                   "Relative standard error wanted of P_c (default as mir render)")
        ->check(CLI::Range(1e-4, 1.0));
    app.add_option("--cache", o.cache, "Folder that keeps references for the next run");
    app.add_option("--images", o.images, "Folder for the indirect light of every render, EXR");
    app.add_option("--montage", o.montage,
                   "PNG with the renders of seed 0 in the order of the table, the reference last; "
                   "of one scene");
    app.add_option("--threads", o.threads, "Threads (default: every core)");
}

}  // namespace

ParsedOptions parse(int argc, char** argv) {
    ParsedOptions parsed;
    CLI::App app("Error of the indirect light against the number of VPLs, as CSV on stdout.");
    add_options(app, parsed.options);
    try {
        app.parse(argc, argv);
        if (!parsed.options.montage.empty() && parsed.options.scenes.size() > 1)
            throw CLI::ValidationError("--montage", "shows one scene; give one --scene");
    } catch (const CLI::ParseError& e) {
        parsed.exit_code = app.exit(e) == 0 ? 0 : 2;
    }
    return parsed;
}

}  // namespace mirconvergence
