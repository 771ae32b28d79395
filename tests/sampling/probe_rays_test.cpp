// SPDX-License-Identifier: MIT
#include "mir/sampling/probe_rays.hpp"

#include "support/catch.hpp"

TEST_CASE("A grid of probes has at least the cells asked for, nearly square ones") {
    for (std::uint32_t count : {1u, 2u, 100u, 4096u, 1000000u})
        for (float aspect : {0.1f, 1.0f, 16.0f / 9.0f, 20.0f}) {
            const mir::Extent cells = mir::ProbeRays{mir::Camera{}, aspect, count, 0}.cells();
            CAPTURE(count, aspect, cells.width, cells.height);
            CHECK(cells.area() >= count);
            CHECK(cells.area() < count + cells.width);
            if (count < 4096) continue;
            const float width_of_cell = aspect / static_cast<float>(cells.width);
            CHECK(width_of_cell * static_cast<float>(cells.height) ==
                  mirtest::Approx(1).epsilon(0.1));
        }
}

TEST_CASE("Each probe looks through its own cell, the same one every time for a seed") {
    const mir::Camera camera;
    const mir::ProbeRays rays{camera, 2.0f, 32, 5};
    const float half = std::tan(0.5f * camera.vertical_fov);
    std::size_t moved = 0;
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) {
            const mir::Ray ray = rays(x, y);
            const mir::Vec3 d = ray.direction / -ray.direction.z;
            const float fx = (d.x / (2.0f * half) + 1.0f) / 2.0f * 8.0f;
            const float fy = (1.0f - d.y / half) / 2.0f * 4.0f;
            CHECK(fx >= static_cast<float>(x) - 1e-4f);
            CHECK(fx <= static_cast<float>(x) + 1.0001f);
            CHECK(fy >= static_cast<float>(y) - 1e-4f);
            CHECK(fy <= static_cast<float>(y) + 1.0001f);
            CHECK(rays(x, y).direction == ray.direction);
            moved += mir::ProbeRays{camera, 2.0f, 32, 6}(x, y).direction == ray.direction ? 0 : 1;
        }
    CHECK(moved == 32);
}
