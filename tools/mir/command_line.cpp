// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "arguments.hpp"
#include "complaint.hpp"
#include "exit_code.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/version.hpp"
#include "text.hpp"

#include <CLI/CLI.hpp>

#include <iostream>

namespace mirtool {
namespace {

int complain(const CLI::App& app, const CLI::ParseError& e) {
    const CLI::App& used = used_command(app);
    std::cerr << "mir: " << shown(complaint(app, e)) << "\nmir: see 'mir"
              << (&used == &app ? "" : " " + used.get_name()) << " --help'\n";
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
