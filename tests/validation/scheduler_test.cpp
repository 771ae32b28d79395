// SPDX-License-Identifier: MIT
#include "mir/validation/scheduler.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"
#include "validation/finds.hpp"

#include <optional>

namespace {

using mirtest::finds;
using mirtest::finds_only;

/// What is wrong with a scheduler.
enum class Bug { none, adds_twice, skips_the_last, writes_at_once, always_lit, last_first };

/// sched::Cpu and a bug.
struct Buggy {
    Bug bug;

    template <class In>
    class Pipeline {
     public:
        Pipeline(const In& in, mir::Image<mir::Rgb>& image, Bug bug)
            : in_(in), image_(image), bug_(bug) {}

        void submit(mir::TileIndex t) { tiles_.push_back(t); }
        void finish() {
            const mir::sched::Cpu right{executor_};
            if (bug_ == Bug::skips_the_last) tiles_.pop_back();
            if (bug_ == Bug::writes_at_once) tiles_ = all();
            auto pipeline = right.open(in_, image_);
            for (const mir::TileIndex t : tiles_) pipeline.submit(t);
            pipeline.finish();
            const mir::Tile& first = in_.gbuffer.tiles()[tiles_.front()];
            mir::Rgb& corner = image_(first.x, first.y + first.height / 2);
            if (bug_ == Bug::adds_twice)
                for (mir::Rgb& c : image_.pixels()) c += c;
            if (bug_ == Bug::last_first && tiles_.front() != 0) corner = {1, 2, 3};
            if (bug_ == Bug::always_lit && in_.vpls.size() == 0) corner = {1, 1, 1};
        }

     private:
        [[nodiscard]] std::vector<mir::TileIndex> all() const {
            std::vector<mir::TileIndex> tiles;
            for (mir::TileIndex t = 0; t < in_.gbuffer.tiles().size(); ++t) tiles.push_back(t);
            return tiles;
        }

        const In& in_;
        mir::Image<mir::Rgb>& image_;
        Bug bug_;
        mir::InlineExecutor executor_;
        std::vector<mir::TileIndex> tiles_;
    };

    template <class In>
    Pipeline<In> open(const In& in, mir::Image<mir::Rgb>& image) const {
        return {in, image, bug};
    }
};

mir::validation::Report check(Bug bug) {
    const mirtest::Stage<mir::Lambert, mirtest::BruteForceScene> stage({40, 30}, {16, 16}, 5);
    return mir::validation::check_scheduler(Buggy{bug}, stage.gbuffer(), stage.vpls(),
                                            stage.visibility(),
                                            mir::VplShading<mir::Lambert>{2.0f});
}

}  // namespace

TEST_CASE("check_scheduler finds nothing wrong with the oracle") {
    CHECK(check(Bug::none).passed());
}

TEST_CASE("check_scheduler finds each axiom that a scheduler breaks") {
    CHECK(finds(check(Bug::adds_twice), "the image is that of sched::Cpu"));
    CHECK(finds(check(Bug::skips_the_last), "luxels of submitted tiles are written, and no other"));
    CHECK(finds_only(check(Bug::writes_at_once),
                     "luxels of submitted tiles are written, and no other"));
    CHECK(finds_only(check(Bug::always_lit), "no VPLs give black"));
    CHECK(finds_only(check(Bug::last_first), "the order of tiles does not matter"));
}
