// SPDX-License-Identifier: MIT
//
// Quoted by docs/extending.md: a scheduler of a user's own.
#include "conformance/brute_force.hpp"
#include "conformance/scheduler_suite.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/shading/contribution.hpp"
#include "support/catch.hpp"

// region: scheduler
/// One VPL after the other over a whole tile, the loops of sched::Cpu exchanged. Each luxel still
/// adds its VPLs in their order, so the image is that of sched::Cpu in every bit.
struct VplByVpl {
    template <class In>
    class Pipeline {
     public:
        Pipeline(const In& in, mir::Image<mir::Rgb>& image) : in_(in), image_(image) {}

        void submit(mir::TileIndex t) {
            const mir::Tile tile = in_.gbuffer.tiles()[t];
            for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
                for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x) image_(x, y) = {};
            for (mir::VplIndex j = 0; j < in_.vpls.size(); ++j) add(in_.vpls[j], t, tile);
        }
        void finish() {}

     private:
        void add(const mir::Vpl& vpl, mir::TileIndex t, const mir::Tile& tile) {
            const auto layout = mir::BlockedLayout::of(tile);
            const auto luxels = in_.gbuffer.view(t);
            for (std::uint32_t y = 0; y < tile.height; ++y)
                for (std::uint32_t x = 0; x < tile.width; ++x) {
                    const mir::LuxelIndex i = layout(x, y);
                    image_(tile.x + x, tile.y + y) += contribution(
                        luxels.hit(i), luxels.surface(i), vpl, in_.visibility, in_.shading);
                }
        }

        const In& in_;
        mir::Image<mir::Rgb>& image_;
    };

    template <class In>
    Pipeline<In> open(const In& in, mir::Image<mir::Rgb>& image) const {
        static_assert(mir::AccessibleFrom<decltype(in.visibility), mir::Space::host>,
                      "VplByVpl needs a Visibility that lives in host memory");
        return {in, image};
    }
};
// endregion: scheduler

TEST_CASE("The scheduler of the documentation keeps the axioms of Scheduler") {
    // region: axioms
    const mirtest::Stage<mir::CookTorrance, mirtest::BruteForceScene> stage({100, 70}, {48, 32},
                                                                            37);
    mirtest::scheduler_suite(VplByVpl{}, stage);
    // endregion: axioms
}
