// SPDX-License-Identifier: MIT
#include "faults/failing_new.hpp"
#include "mir/runtime/progressive_render.hpp"
#include "runtime/noise_renderer.hpp"
#include "support/catch.hpp"

#include <optional>

namespace {

const mir::Scene scene;

/// Two passes of a tiny picture; the second has more bounces and a layer of what was removed.
class Growing : public mirtest::NoiseRenderer {
 public:
    Growing() { bounces = {1, 3}; }

    mir::RenderResult render(const mir::Scene& s, const mir::RenderSettings& settings,
                             mir::Monitor* monitor) const override {
        mir::RenderResult result = NoiseRenderer::render(s, settings, monitor);
        if (seeds.size() > 1) result.removed = result.direct;
        return result;
    }
};

mir::RenderSettings tiny() {
    mir::RenderSettings s;
    s.image = {5, 3};
    return s;
}

}  // namespace

TEST_CASE("a pass whose allocations fail leaves those before as they were, and can be repeated") {
    const std::size_t before = GENERATE(0u, 1u);
    const mir::PassGoal goal{.passes = 2};
    Growing renderer;
    mir::ProgressiveRender whole(renderer, scene, tiny(), goal);
    for (std::size_t pass = 0; pass <= before; ++pass) whole.next_pass();
    const mir::RenderResult wanted = whole.result();

    std::size_t wrong = 0;
    std::optional<mir::ProgressiveRender> render;
    const auto start = [&] {
        renderer.seeds.clear();
        renderer.seeds.reserve(8);
        render.emplace(renderer, scene, tiny(), goal);
        for (std::size_t pass = 0; pass < before; ++pass) render->next_pass();
    };
    start();
    const auto failures = mirtest::fail_allocations(
        100000, 1, [&] { render->next_pass(); },
        [&](bool done) {
            if (!done) {
                if (render->sums().passes() != before) ++wrong;
                if (before > 0 && render->result().bounces.size() != 1) ++wrong;
                renderer.seeds.resize(before);
                render->next_pass();
            }
            const mir::RenderResult found = render->result();
            if (!mirtest::same_bits(found.beauty, wanted.beauty) ||
                !mirtest::same_bits(found.removed, wanted.removed) ||
                found.bounces.size() != wanted.bounces.size() ||
                !mirtest::same_bits(found.bounces.back(), wanted.bounces.back()))
                ++wrong;
            start();
        });
    INFO(failures.tried << " allocations");
    CHECK(failures.tried > 20);
    CHECK(wrong == 0);
}
