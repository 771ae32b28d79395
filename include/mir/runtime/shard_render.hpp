// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/pass_goal.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "mir/runtime/shard_number.hpp"
#include "mir/runtime/shard_pass.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace mir {

/// A render of some rows of a picture, with all passes of it. Pixels are those of the whole
/// picture. What a pass places or measures for the whole picture (VPLs, their normalisation,
/// shares of light) is done in every shard again. One thread at a time.
class ShardRender {
 public:
    /// `renderer`, `scene` and `monitor`, which may be null, must outlive it. `settings` are those
    /// of the whole picture; `done` and `sums` are of passes of this shard that were rendered
    /// earlier.
    /// @throws Error(invalid_argument) for a shard that the picture does not have.
    ShardRender(const Renderer& renderer, const Scene& scene, RenderSettings settings,
                ShardNumber shard, std::uint32_t passes, Monitor* monitor = nullptr,
                PassSums sums = {}, std::vector<ShardPass> done = {})
        : recorder_(renderer, std::move(done)),
          render_(recorder_, scene, of_rows(std::move(settings), shard), {.passes = passes},
                  monitor, std::move(sums)) {}

    /// True when all passes are done.
    [[nodiscard]] bool is_complete() const { return render_.is_complete(); }

    /// Renders one more pass.
    /// @throws Error as Renderer::render(), Error(cancelled) too: then it is as it was before.
    void next_pass() {
        recorder_.passes.reserve(recorder_.passes.size() + 1);
        try {
            render_.next_pass();
        } catch (...) {
            recorder_.passes.resize(render_.sums().passes());
            throw;
        }
    }

    /// Pixels of the passes done; those of other rows are black.
    [[nodiscard]] const PassSums& sums() const { return render_.sums(); }

    /// Numbers of each pass done.
    [[nodiscard]] const std::vector<ShardPass>& passes() const { return recorder_.passes; }

 private:
    /// Keeps what a merge has to know of each pass.
    struct Recorder final : Renderer {
        Recorder(const Renderer& one, std::vector<ShardPass>&& done)
            : renderer(one), passes(std::move(done)) {}
        RenderResult render(const Scene& scene, const RenderSettings& settings,
                            Monitor* monitor) const override {
            RenderResult result = renderer.render(scene, settings, monitor);
            passes.push_back(shard_pass(result));
            return result;
        }

        const Renderer& renderer;
        mutable std::vector<ShardPass> passes;  ///< a renderer is const; this one has one user
    };

    static RenderSettings of_rows(RenderSettings settings, ShardNumber shard) {
        settings.rows = rows_of(shard, settings.image.height);
        return settings;
    }

    Recorder recorder_;
    ProgressiveRender render_;
};

}  // namespace mir
