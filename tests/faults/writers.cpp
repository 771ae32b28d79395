// SPDX-License-Identifier: MIT
#include "faults/writers.hpp"

#include "mir/io/exr.hpp"
#include "mir/io/gltf_writer.hpp"
#include "mir/io/html_report.hpp"
#include "mir/io/pass_journal.hpp"
#include "mir/io/png.hpp"
#include "mir/io/shard_file.hpp"
#include "mir/io/vpl_ply.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "mir/scenes.hpp"
#include "runtime/noise_renderer.hpp"

#include <memory>
#include <utility>

namespace mirtest {
namespace {

/// A render of two passes and what is written of it.
struct Contents {
    explicit Contents(int variant) {
        settings.image = {24, 18};
        settings.seed = static_cast<std::uint64_t>(variant);
        const NoiseRenderer renderer;
        mir::ProgressiveRender render(renderer, scene, settings, {.passes = 2}, nullptr, {});
        while (!render.is_complete()) render.next_pass();
        sums = render.sums();
        result = std::make_unique<mir::RenderResult>(sums.result());
        mir::Vpl vpl{};
        vpl.position = {static_cast<float>(variant), 0.0f, 0.0f};
        result->vpls.push_back(vpl, {});
    }
    mir::Scene scene = mir::builtin::make("furnace");
    mir::RenderSettings settings;
    mir::PassSums sums;
    std::unique_ptr<mir::RenderResult> result;
};

}  // namespace

std::vector<Writer> all_writers(int variant) {
    const auto contents = std::make_shared<const Contents>(variant);
    const auto writer = [&](const char* name, auto write) {
        return Writer{
            name, [contents, write](const std::filesystem::path& path) { write(*contents, path); }};
    };
    using Path = std::filesystem::path;
    return {writer("a.exr",
                   [](const Contents& c, const Path& path) {
                       const auto& r = *c.result;
                       mir::write_exr(path, r.beauty.extent(),
                                      {{"", &r.beauty},
                                       {"albedo", &r.guides.albedo, mir::ExrPrecision::half},
                                       {"depth", &r.guides.depth}},
                                      {{"mir:a", "text"}});
                   }),
            writer("a.png", [](const Contents& c,
                               const Path& path) { mir::write_png(path, c.result->beauty); }),
            writer("a.html",
                   [](const Contents& c, const Path& path) {
                       const mir::HtmlReport report{
                           "title", {{"label", "value"}}, {{"beauty", &c.result->beauty}}};
                       mir::write_html_report(path, report);
                   }),
            writer("a.ply", [](const Contents& c,
                               const Path& path) { mir::write_vpls_ply(path, c.result->vpls); }),
            writer("a.glb",
                   [](const Contents& c, const Path& path) {
                       mir::Scene scene = c.scene;
                       scene.name = "seed " + std::to_string(c.settings.seed);
                       mir::write_glb(scene, path);
                   }),
            writer("a.shard",
                   [](const Contents& c, const Path& path) {
                       const mir::ShardPass pass = mir::shard_pass(*c.result);
                       mir::ShardFile(path, mir::shard_manifest(c.scene, c.settings, 2, {2, 3}))
                           .write(c.sums, {pass, pass});
                   }),
            writer("a.journal", [](const Contents& c, const Path& path) {
                mir::PassJournal(path, c.scene, c.settings).write(c.sums);
            })};
}

}  // namespace mirtest
