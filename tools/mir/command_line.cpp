// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "arguments.hpp"
#include "exit_code.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/version.hpp"
#include "nearest.hpp"
#include "text.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

namespace mirtool {
namespace {

/// The word to complain about: an option rather than the value behind it.
std::string worst_of(const std::vector<std::string>& strangers) {
    for (const std::string& word : strangers)
        if (word.starts_with('-')) return word;
    return strangers.back();
}

int complain(const CLI::App& app, const CLI::ParseError& e) {
    const CLI::App* used = &app;
    for (const CLI::App* sub : app.get_subcommands()) used = sub;
    // What no command knows may stand before the command that is used.
    const std::vector<std::string> strangers = app.remaining(true);
    const bool unknown = dynamic_cast<const CLI::ExtrasError*>(&e) != nullptr;
    std::cerr << "mir: "
              << shown(unknown ? "unknown argument '" + worst_of(strangers) + "'" : e.what());
    std::vector<std::string> known;
    for (const CLI::Option* option : used->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const CLI::App* sub : used->get_subcommands({})) known.push_back(sub->get_name());
    for (const std::string& word : strangers)
        if (const auto guess = nearest(word.substr(0, word.find('=')), known))
            std::cerr << "; did you mean " << *guess << "?";
    std::cerr << "\nmir: see 'mir" << (used == &app ? "" : " " + used->get_name()) << " --help'\n";
    return exit_usage;
}

void add_allow_outside(CLI::App& app, mir::Limits& limits) {
    app.add_flag("--allow-outside", limits.allow_outside,
                 "The scene may name files outside of its folder");
}

}  // namespace

Parsed parse(int argc, char** argv) {
    RenderOptions render;
    InfoOptions info;
    ExportOptions exporting;
    CompareOptions compare;
    DevicesOptions devices;

    CLI::App app{"Metropolis Instant Radiosity: renders a scene with virtual point lights", "mir"};
    app.set_version_flag("--version", [] {
        return std::string("mir ") + mir::version + " (" + mir::cpu_description() + ")";
    });
    app.require_subcommand(1);
    const std::string scene = "file (.gltf, .glb, .obj, .ply) or builtin:NAME";

    CLI::App* r = app.add_subcommand("render", "Render a scene to EXR and PNG");
    r->add_option("scene", render.scene, scene)->required();
    add_allow_outside(*r, render.settings.limits);
    add_render(*r, render);

    CLI::App* i = app.add_subcommand("info", "Tell what a scene holds and what is not supported");
    i->add_option("scene", info.scene, scene)->required();
    add_allow_outside(*i, info.limits);
    add_environment(*i, info.environment);
    i->add_flag("--accel", info.accel, "Build the kd-tree and tell its size, cost and build time");
    i->add_flag("--json", info.json, "JSON on stdout");

    CLI::App* x = app.add_subcommand("export", "Write a scene as glTF binary");
    x->add_option("scene", exporting.scene, scene)->required();
    add_allow_outside(*x, exporting.limits);
    x->add_option("-o,--output", exporting.output, "File to write (.glb)")->required();

    CLI::App* c = app.add_subcommand("compare", "Compare a picture with a reference");
    add_compare(*c, compare);

    CLI::App* d = app.add_subcommand("devices", "List what can render on this machine");
    d->add_flag("--json", devices.json, "JSON on stdout");

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        return complain(app, e);
    }
    if (render.no_layers && render.layers.size() > 1)
        return complain(app, CLI::ValidationError("--aov", "none goes with no other layer"));
    if (r->parsed()) return Command{render};
    if (i->parsed()) return Command{info};
    if (x->parsed()) return Command{exporting};
    if (c->parsed()) return Command{compare};
    return Command{devices};
}

}  // namespace mirtool
