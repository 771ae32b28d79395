// SPDX-License-Identifier: MIT
#include "runtime/host_tracing.hpp"

#include "mir/host/tbb_executor.hpp"
#include "runtime/traced_scene.hpp"
#include "support/catch.hpp"

#include <cmath>

namespace {

/// Hills of two times `side` squared triangles.
mir::Scene hills(std::uint32_t side) {
    mir::Scene scene;
    scene.materials.emplace_back();
    mir::Mesh mesh;
    const std::uint32_t row = side + 1;
    for (std::uint32_t i = 0; i < row * row; ++i) {
        const auto x = static_cast<float>(i % row);
        const auto y = static_cast<float>(i / row);
        mesh.positions.push_back({x, y, std::sin(x) * std::cos(y)});
    }
    for (std::uint32_t i = 0; i + row < row * row; ++i) {
        if (i % row == side) continue;
        mesh.triangles.push_back({i, i + 1, i + row});
        mesh.triangles.push_back({i + 1, i + row + 1, i + row});
    }
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({0, mir::Mat4(1.0f)});
    return scene;
}

}  // namespace

TEST_CASE("structures are built under the eyes of a monitor, which stops them") {
    const mir::Scene scene = hills(200);
    const mir::WorldGeometry geometry(scene);
    mir::TbbExecutor threads(2);
    for (const mir::Acceleration structure :
         {mir::Acceleration::bvh, mir::Acceleration::kd_tree, mir::Acceleration::embree}) {
        if (structure == mir::Acceleration::embree && mir::embree_tracing() == nullptr) continue;
        mir::RenderSettings settings;
        settings.acceleration = structure;
        mir::Monitor monitor;
        mir::StageClock clock(&monitor);
        const mir::PlacedScene placed{scene, geometry, mir::AnyExecutor(threads), &monitor, clock};
        const mir::HostTracing tracing = mir::trace_on_host(placed, settings);
        CAPTURE(tracing.name);
        CHECK(monitor.planned_blocks > 0);
        CHECK(monitor.blocks > 0);

        monitor.cancelled = true;
        try {
            static_cast<void>(mir::trace_on_host(placed, settings));
            FAIL("a cancelled build came to its end");
        } catch (const mir::Error& e) {
            CHECK(e.code() == mir::ErrorCode::cancelled);
        }
        CHECK(monitor.blocks == 0);
    }
}
