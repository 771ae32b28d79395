// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "denoising.hpp"
#include "exit_code.hpp"
#include "idle_options.hpp"
#include "mir/io/merge_shards.hpp"
#include "output_places.hpp"
#include "print_result.hpp"
#include "render_output.hpp"
#include "shard_words.hpp"

#include <filesystem>
#include <vector>

namespace mirtool {

int run(const MergeOptions& options) {
    const std::vector<std::filesystem::path> shards(options.shards.begin(), options.shards.end());
    mir::MergedPicture merged = mir::merge_shards(shards, program_build());
    RenderOptions o = options_of(merged.manifest);
    o.output = options.output;
    o.preview = options.preview;
    o.no_preview = options.no_preview;
    const OutputPaths paths = choose_outputs(o);
    for (const std::string& shard : options.shards)
        mir::expects(!are_one_file(shard, paths.exr) && !are_one_file(shard, paths.png),
                     "the picture would replace a shard of it; give another name with -o");
    note_idle_options(o.settings, merged.result);
    write_outputs(paths, merged.result, o);
    if (!options.quiet) print_summary(merged.result, o.settings);
    if (options.json) {
        const mir::Image<mir::Rgb> no_reference;
        print_json(paths, merged.result, o, Convergence(no_reference), Denoising{});
    } else {
        for (const std::string& name : {paths.exr, paths.png})
            if (!name.empty()) print_result(name);
    }
    return exit_done;
}

}  // namespace mirtool
