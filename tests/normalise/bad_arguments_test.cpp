// SPDX-License-Identifier: MIT
// What callers of stages can get wrong is an error, not a picture of rubbish.
#include "mir/normalise/response.hpp"
#include "mir/paths/path_world.hpp"
#include "mir/reshade.hpp"
#include "mir/sched/cpu.hpp"
#include "normalise/lit_box.hpp"
#include "support/catch.hpp"

#include <limits>

using namespace mirtest;

namespace {

using Shading = mir::VplShading<mir::CookTorrance>;
constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

template <class Call>
void check_refused(const Call& call) {
    try {
        call();
        FAIL("nothing was thrown");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::invalid_argument);
    }
}

}  // namespace

TEST_CASE("bounds that are negative or no numbers are refused by every stage that takes one") {
    const LitBox<mir::CookTorrance> box({32, 16});
    mir::InlineExecutor executor;
    const mir::sched::Cpu cpu{executor};
    const float bound = GENERATE(-1.0f, -std::numeric_limits<float>::infinity(), no_number);
    const Shading shading{.bound = bound};
    const auto sight = box.engine.visibility();
    const auto vpls = box.vpls.span();
    check_refused([&] { (void)reconstruct(cpu, box.gbuffer, vpls, sight, shading); });
    check_refused([&] { (void)reshade(cpu, box.gbuffer, vpls, box.matrix, shading); });
    check_refused([&] { (void)response(box.gbuffer, vpls, box.matrix, shading, executor); });
    const mir::SurfaceTable<mir::CookTorrance> surfaces(box.world.scene);
    const mir::LightTable lights(box.world.scene, box.world.geometry);
    const mir::Camera& camera = box.world.scene.cameras.front();
    const auto world = [&](float aspect, float largest) {
        return mir::PathWorld(box.world.geometry, lights, surfaces, box.engine.ray_caster(), sight,
                              camera, aspect, largest);
    };
    check_refused([&] { (void)world(1.0f, bound); });
    check_refused([&] { (void)world(bound, 1.0f); });
    CHECK_NOTHROW(world(1.0f, 0.0f));
    CHECK_NOTHROW(reconstruct(cpu, box.gbuffer, vpls, sight, Shading{.bound = 0.0f}));
}

TEST_CASE("a G-buffer that does not fit the image of its rays is refused") {
    const LitBox<mir::CookTorrance> box({32, 16});
    const auto luxels = [&](mir::Extent image, std::uint32_t first, mir::Extent band) {
        mir::BlockedGBuffer<mir::CookTorrance::Params> gbuffer(band, {16, 16});
        mir::InlineExecutor executor;
        mir::fill_gbuffer<mir::CookTorrance>(
            gbuffer, first, mir::CameraRays{box.world.scene.cameras.front(), {image}},
            box.engine.ray_caster(), mir::SurfaceTable<mir::CookTorrance>(box.world.scene),
            executor);
    };
    check_refused([&] { luxels({32, 16}, 0, {16, 16}); });
    check_refused([&] { luxels({32, 16}, 0, {32, 32}); });
    check_refused([&] { luxels({32, 32}, 17, {32, 16}); });
    check_refused([&] { luxels({32, 32}, 0xffff'fff0u, {32, 32}); });
    CHECK_NOTHROW(luxels({32, 32}, 16, {32, 16}));
}
