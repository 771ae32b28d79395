// SPDX-License-Identifier: MIT
#include "shard_words.hpp"

#include "command_line.hpp"
#include "mir/core/number_text.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "prepare_scene.hpp"

namespace mirtool {

std::string program_build() {
    const std::string rays = mir::cpu_description();
    return rays.substr(0, rays.find(',')) + ", compiler " + __VERSION__;
}

void put_words(const RenderOptions& o, mir::ShardManifest& manifest) {
    manifest.build = program_build();
    manifest.recipe = o.words;
    manifest.look = std::to_string(static_cast<int>(o.tone));
    manifest.look += o.exposure ? " " + mir::number_text(*o.exposure, 9) : " auto";
    manifest.look += o.record_seconds ? " seconds" : "";
    for (const std::string& layer : o.layers) manifest.look += " " + layer;
}

RenderOptions options_of(const mir::ShardManifest& manifest) {
    std::vector<std::string> words{"mir"};
    words.insert(words.end(), manifest.recipe.begin(), manifest.recipe.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const Parsed parsed = parse(static_cast<int>(words.size()), argv.data());
    const Command* const command = std::get_if<Command>(&parsed);
    const auto* const of_picture = command ? std::get_if<RenderOptions>(command) : nullptr;
    if (of_picture == nullptr)
        throw mir::Error(mir::ErrorCode::invalid_input,
                         "the shards do not say how their picture is to be written (another "
                         "program made them); merge them with that one");
    RenderOptions o = *of_picture;
    for (std::string* file : {&o.output, &o.preview, &o.report, &o.report_reference, &o.vpls_out})
        file->clear();
    o.passes = {};
    o.settings.image = manifest.image;
    choose_layers(o);
    return o;
}

}  // namespace mirtool
