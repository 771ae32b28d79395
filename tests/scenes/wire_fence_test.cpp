// SPDX-License-Identifier: MIT
#include "scenes/wire_fence.hpp"

#include "support/catch.hpp"
#include "support/mesh_measures.hpp"

namespace {

using mir::Mesh;
using mir::Vec3;
using namespace mir::builtin;

/// Points on the middle lines of wires: centres of the pentagons they are made of.
std::vector<Vec3> middles(const Mesh& m) {
    std::vector<Vec3> centres;
    for (std::size_t v = 0; v + 5 <= m.positions.size(); v += 5) {
        Vec3 sum(0);
        for (std::size_t k = 0; k < 5; ++k) sum += m.positions[v + k];
        centres.push_back(sum / 5.0f);
    }
    return centres;
}

/// Smallest distance between the middle lines of the wires along `a` and those along `b`.
float nearest_crossing(const Fence& f) {
    Mesh along_a = empty_mesh("a", 0);
    Mesh along_b = empty_mesh("b", 0);
    add_wires(along_a, f);
    add_wires(along_b, {f.p, f.b, f.a, f.mesh, f.radius});
    float nearest = 1.0f;
    for (const Vec3 p : middles(along_a))
        for (const Vec3 q : middles(along_b)) nearest = mir::smaller(nearest, glm::length(p - q));
    return nearest;
}

}  // namespace

TEST_CASE("wires of a fence are closed and turned outwards") {
    const Mesh m = fence("f", 4, {{1, 0, 2}, {0.5f, 0, 0}, {0, 0.4f, 0}});
    CHECK(m.material == 4);
    CHECK(mirtest::is_closed(m, 1e-7f));
    CHECK(mirtest::volume(m) > 0.0);
    CHECK(m.normals.size() == m.positions.size());
}

TEST_CASE("wires pass over and under each other and never touch") {
    const Fence f{{0, 0, 0}, {0.35f, 0, 0}, {0, 0.28f, 0}};
    CHECK(nearest_crossing(f) == mirtest::Approx(2.5f * f.radius).epsilon(1e-3));
}

TEST_CASE("a fence stays within its parallelogram, wire thickness aside") {
    const Fence f{{1, 2, 3}, {0, 0, 1}, {0, 0.7f, 0}};
    for (const Vec3 p : fence("f", 0, f).positions) {
        const Vec3 d = p - f.p;
        CHECK(std::fabs(d.x) < 2.5f * f.radius);
        CHECK(d.y > -1.1f * f.radius);
        CHECK(d.y < 0.7f + 1.1f * f.radius);
        CHECK(d.z > -1.1f * f.radius);
        CHECK(d.z < 1.0f + 1.1f * f.radius);
    }
}
