// SPDX-License-Identifier: MIT
#include "faults/failing_new.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

#include <cstring>
#include <optional>

namespace {

mir::RenderSettings tiny_settings(mir::SamplerKind sampler) {
    mir::RenderSettings s;
    s.image = {16, 12};
    s.luxels_per_pixel = 1;
    s.vpls = 8;
    s.threads = 1;
    s.backend = mir::BackendKind::cpu;
    s.sampler = sampler;
    return s;
}

}  // namespace

TEST_CASE("a render whose allocations fail throws, or makes the picture all the same") {
    mir::Registry registry;
    mir::add_all_to(registry);
    const mir::Scene scene = mir::builtin::make("cornell-box");
    const auto sampler =
        GENERATE(mir::SamplerKind::instant_radiosity, mir::SamplerKind::metropolis);
    const mir::RenderSettings settings = tiny_settings(sampler);
    const auto renderer = registry.make(settings.backend, settings.scheduler);
    const mir::RenderResult whole = renderer->render(scene, settings, nullptr);
    std::optional<mir::RenderResult> result;
    std::size_t wrong = 0;
    const auto failures = mirtest::fail_allocations(
        40, 17, [&] { result = renderer->render(scene, settings, nullptr); },
        [&](bool done) {
            const auto pixels = whole.beauty.pixels();
            if (done && std::memcmp(result->beauty.pixels().data(), pixels.data(),
                                    pixels.size_bytes()) != 0)
                ++wrong;
        });
    INFO(failures.tried << " allocations, survived " << failures.survived);
    CHECK(failures.tried > 50);
    CHECK(wrong == 0);
}
