// SPDX-License-Identifier: MIT
#include "render_shard.hpp"

#include "alarm.hpp"
#include "exit_code.hpp"
#include "mir/io/shard_file.hpp"
#include "mir/runtime/shard_render.hpp"
#include "mir/version.hpp"
#include "output_places.hpp"
#include "pass_goal_of.hpp"
#include "print_result.hpp"
#include "progress.hpp"
#include "shard_words.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <optional>
#include <utility>

namespace mirtool {
namespace {

/// The manifest, with what the program has to say of the scene and the machine.
mir::ShardManifest manifest_of(const RenderOptions& o, const SceneAndReport& loaded,
                               const std::vector<std::string>& of_choice) {
    mir::ShardManifest manifest =
        mir::shard_manifest(loaded.scene, o.settings, goal_of(o.passes).passes, *o.shard);
    put_words(o, manifest);
    manifest.remarks = loaded.report.remarks;
    manifest.remarks.insert(manifest.remarks.end(), of_choice.begin(), of_choice.end());
    return manifest;
}

void print_shard(const std::string& file, const mir::ShardManifest& m, bool as_json) {
    if (!as_json) return print_result(file);
    const mir::PixelRows rows = m.rows();
    const nlohmann::ordered_json out{
        {"version", mir::version}, {"scene_hash", m.scene_hash}, {"file", file},
        {"shard", m.shard.number}, {"shards", m.shard.count},    {"first_row", rows.first},
        {"rows", rows.count},      {"passes", m.passes}};
    std::printf("%s\n", out.dump(2, ' ', true, nlohmann::json::error_handler_t::replace).c_str());
}

/// Renders what is missing. Passes that are done are kept now and then where they may be resumed.
void render_passes(mir::ShardRender& render, const mir::ShardFile& file, const PassOptions& o) {
    Alarm save(o.save_every.value_or(default_save_every));
    try {
        while (!render.is_complete()) {
            render.next_pass();
            if (o.resume && !render.is_complete() && save.rings())
                file.write(render.sums(), render.passes());
        }
    } catch (const mir::Error& e) {
        if (o.resume && e.code() == mir::ErrorCode::cancelled && render.sums().passes() > 0)
            file.write(render.sums(), render.passes());
        throw;
    }
}

}  // namespace

std::string choose_shard(const RenderOptions& o) {
    mir::expects(!o.passes.seconds && !o.passes.relative_error,
                 "shards would end after different passes (their picture would be of none); give "
                 "--passes instead of --time and --target-error");
    mir::expects(o.preview.empty() && o.report.empty() && o.vpls_out.empty(),
                 "a shard has no preview, report or VPLs of its own (they are of the whole "
                 "picture); give --png to mir merge, and the others to a whole render");
    mir::expects(!o.denoise,
                 "a shard is not denoised (a denoiser needs the whole picture); leave --denoise "
                 "out and give the merged picture to mir denoise");
    const std::string number =
        std::to_string(o.shard->number) + "-of-" + std::to_string(o.shard->count);
    std::string file = o.output.empty() ? stem_of(o.scene) + "." + number + ".shard" : o.output;
    mir::expects(file != "-", "a shard cannot be written to standard output; name a file");
    check_output_places({o.scene, o.environment.file}, {file}, "render");
    return file;
}

int render_shard(const std::string& name, const mir::Registry::Choice& choice,
                 const RenderOptions& o, const SceneAndReport& loaded, mir::Monitor& monitor) {
    const mir::ShardManifest manifest = manifest_of(o, loaded, choice.remarks);
    const mir::ShardFile file(name, manifest);
    mir::ShardPasses done = o.passes.resume ? file.read() : mir::ShardPasses{};
    const bool was_complete = done.passes.size() == manifest.passes;
    mir::ShardRender render(*choice.renderer, loaded.scene, o.settings, *o.shard, manifest.passes,
                            &monitor, std::move(done.sums), std::move(done.passes));
    {
        std::optional<Progress> progress;
        if (!o.quiet) progress.emplace(monitor);
        render_passes(render, file, o.passes);
    }
    file.write(render.sums(), render.passes());  // a complete one too: its look may be another
    if (!o.quiet)
        std::fprintf(stderr, "mir: shard %s %s, %.2f s\n", to_string(*o.shard).c_str(),
                     was_complete ? "was complete" : "is complete",
                     render.sums().statistics().seconds.total);
    print_shard(name, manifest, o.json);
    return exit_done;
}

}  // namespace mirtool
