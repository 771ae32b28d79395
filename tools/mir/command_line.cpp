// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include "arguments.hpp"
#include "complaint.hpp"
#include "exit_code.hpp"
#include "manual/help.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/version.hpp"
#include "option_types.hpp"
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

/// The options that `mir render --help` shows.
const std::vector<std::string> first_options{
    "--output",  "--aov",     "--exposure",    "--denoise", "--width",   "--height",
    "--quality", "--sun",     "--environment", "--vpls",    "--sampler", "--passes",
    "--time",    "--backend", "--help",        "--help-all"};

constexpr const char* help_examples =
    "Examples:\n"
    "  mir render room.glb -o room.exr      a picture, and room.png as its preview\n"
    "  mir render room.glb --time 60        the best picture of a minute\n"
    "  mir info room.glb                    what the file holds and what is not read\n"
    "  mir compare room.exr reference.exr   how two pictures differ";

/// All commands, and where what is given to them goes.
struct CommandLine {
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;
    ~CommandLine() = default;

    /// The options of the command that was given.
    [[nodiscard]] Command given() const;

    RenderOptions render;
    MergeOptions merge;
    InfoOptions info;
    ExportOptions exporting;
    CompareOptions compare;
    DenoiseOptions denoise;
    DevicesOptions devices;
    ManualOptions manual;
    CLI::App app{"Metropolis Instant Radiosity: renders scenes with virtual point lights", "mir"};

 private:
    void add_render_command();
    void add_merge_command();
    void add_info_command();
    void add_manual_command();
};

/// The argument that names a scene.
void add_scene(CLI::App& command, std::string& scene) {
    command.add_option("scene", scene, "File (.gltf, .glb, .obj, .ply) or builtin:NAME")
        ->required()
        ->type_name("SCENE");
}

CommandLine::CommandLine() {
    app.formatter(std::make_shared<Help>());
    app.set_help_flag("-h,--help", "Print this help");
    app.set_help_all_flag("--help-all", "Print the help of all commands");
    app.set_version_flag(
        "--version",
        [] { return std::string("mir ") + mir::version + " (" + mir::cpu_description() + ")"; },
        "Print the version, and how the processor traces rays");
    app.require_subcommand(1);
    add_render_command();
    add_merge_command();
    add_info_command();

    CLI::App* x = app.add_subcommand("export", "Write a scene as glTF binary");
    add_scene(*x, exporting.scene);
    add_allow_outside(*x, exporting.limits);
    x->add_option("-o,--output", exporting.output, "File to write (.glb)")
        ->required()
        ->type_name("FILE");
    add_compare(*app.add_subcommand("compare", "Compare a picture with a reference"), compare);
    add_denoise(*app.add_subcommand("denoise", "Take the noise out of a picture"), denoise);
    CLI::App* d = app.add_subcommand("devices", "List what can render on this machine");
    d->add_flag("--json", devices.json, "JSON on stdout");
    add_manual_command();

    // Commands that are added later would have them too.
    app.footer(help_examples);
    // Their --help shows everything.
    for (CLI::App* command : app.get_subcommands({}))
        if (command->get_name() != "render") command->get_option("--help-all")->group("");
}

void CommandLine::add_render_command() {
    CLI::App& command = *app.add_subcommand("render", "Render a scene to EXR and PNG");
    command.formatter(std::make_shared<Help>(first_options));
    command.get_option("--help")->group("Help");
    command.set_help_all_flag("--help-all", "Print the help of all options")->group("Help");
    add_scene(command, render.scene);
    add_render(command, render);
}

void CommandLine::add_merge_command() {
    CLI::App& command = *app.add_subcommand("merge", "Put the shards of a picture together");
    command.add_option("shards", merge.shards, "All shards of one picture, in any order")
        ->required()
        ->type_name("SHARD");
    command
        .add_option("-o,--output", merge.output,
                    "Picture to write (default: SCENE.exr in this folder)")
        ->type_name("FILE");
    command.add_option("--png", merge.preview, "Preview to write (default: beside the picture)")
        ->type_name("FILE");
    command.add_flag("--no-png", merge.no_preview, "Write no preview");
    command.add_flag("--json", merge.json, "Print statistics as JSON on stdout");
    command.add_flag("-q,--quiet", merge.quiet, "No summary");
}

void CommandLine::add_info_command() {
    CLI::App& command =
        *app.add_subcommand("info", "Tell what a scene holds and what is not supported");
    add_scene(command, info.scene);
    add_allow_outside(command, info.limits);
    add_environment(command, info.environment);
    command.add_flag("--accel", info.accel,
                     "Build the kd-tree and tell its size, cost and build time");
    command.add_flag("--json", info.json, "JSON on stdout");
}

void CommandLine::add_manual_command() {
    using Language = ManualOptions::Language;
    CLI::App& command =
        *app.add_subcommand("manual", "Write the manual page or the completion of a shell");
    add_choice<Language>(command, "language", manual.language,
                         {{"man", Language::man},
                          {"bash", Language::bash},
                          {"zsh", Language::zsh},
                          {"fish", Language::fish}},
                         "man, for the manual page, or the shell: bash, zsh, fish")
        ->required();
}

Command CommandLine::given() const {
    if (app.got_subcommand("render")) return render;
    if (app.got_subcommand("merge")) return merge;
    if (app.got_subcommand("info")) return info;
    if (app.got_subcommand("export")) return exporting;
    if (app.got_subcommand("compare")) return compare;
    if (app.got_subcommand("denoise")) return denoise;
    if (app.got_subcommand("devices")) return devices;
    return manual;
}

}  // namespace

Parsed parse(int argc, char** argv) {
    CommandLine line;
    try {
        line.app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return line.app.exit(e);
    } catch (const CLI::ParseError& e) {
        return complain(line.app, e);
    }
    if (line.render.no_layers && line.render.layers.size() > 1)
        return complain(line.app, CLI::ValidationError("--aov", "none goes with no other layer"));
    if (line.render.shard) line.render.words.assign(argv + 1, argv + argc);
    return line.given();
}

CommandFacts program_facts() { return facts_of(CommandLine().app); }

}  // namespace mirtool
