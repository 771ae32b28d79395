// SPDX-License-Identifier: MIT
#include "mir/sampling/light_path_luminance.hpp"

#include "mir/scene/scene.hpp"
#include "mir/shading/lambert.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"

#include <cmath>
#include <vector>

namespace {

using mir::Lambert;
using mir::Vec3;
using mirtest::Approx;

using Paths = std::vector<std::vector<float>>;

/// The estimate for paths whose VPLs have these intensities, and `dark` ones without a VPL. Inside
/// a sphere every VPL gives the same to the image, by its intensity.
mir::PathLuminance estimate(const Paths& paths, std::uint64_t dark, std::size_t most = 2048,
                            std::uint32_t luxels = 16) {
    const mirtest::AnalyticSphere sphere{2.0f, 0, 0};
    mir::Scene scene;
    scene.add(mir::lambertian("wall", {0.5f, 0.5f, 0.5f}));
    const mir::SurfaceTable<Lambert> surfaces(scene);
    const mir::Camera camera = mir::Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1.0f);
    const mir::ImageProbe<Lambert, mirtest::FreeSight> probe({camera, 1.0f, luxels, 1}, sphere,
                                                             surfaces, {});
    const mir::SurfacePoint place = sphere.point(Vec3(0, 1, 0));
    mir::VplRecords records;
    records.paths = paths.size() + dark;
    for (const std::vector<float>& path : paths) {
        std::uint8_t bounce = 2;
        for (const float j : path) {
            mir::VplRecord record;
            record.vpl = {place.position, place.geometric_normal, {j, j, j}};
            record.bounce = bounce++;
            records.records.push_back(record);
        }
    }
    mir::InlineExecutor executor;
    return light_path_luminance(records, probe, executor, most);
}

/// Of an equal share of `lit` among `all`.
double error_of_share(double lit, double all) { return std::sqrt((all / lit - 1.0) / (all - 1.0)); }

}  // namespace

TEST_CASE("paths that give the same to the image leave no error") {
    const mir::PathLuminance p = estimate(Paths(100, {1.0f}), 0);
    CHECK(p.relative_error() == Approx(0.0).margin(1e-6));
    CHECK(p.paths == 100);
    CHECK(p.contributing == 100);
    // rho / (4 pi R^2) for each W sr^-1.
    CHECK(p.mean == Approx(100.0 * 0.5 / (4.0 * 3.14159265 * 4.0)).epsilon(1e-3));
}

TEST_CASE("one path that brings all the light leaves an error as large as the light") {
    CHECK(estimate({{7.0f}}, 99).relative_error() == Approx(1.0));
    CHECK(estimate(Paths(25, {1.0f}), 75).relative_error() == Approx(error_of_share(25, 100)));
    CHECK(estimate({}, 100).relative_error() == 0.0);
}

TEST_CASE("the VPLs of one path count together") {
    Paths twos(10, {1.0f, 1.0f});
    twos.push_back({2.0f});
    CHECK(estimate(twos, 9).relative_error() == Approx(error_of_share(11, 20)));
    CHECK(estimate(twos, 9).contributing == 11);
}

TEST_CASE("of many paths each is looked at by few luxels rather than not at all") {
    // One path of 3000 brings all: with all 64 luxels for each of 750 records three of four such
    // paths would go unseen.
    Paths rare(3000, {0.0f});
    rare[1234] = {5.0f};
    const mir::PathLuminance p = estimate(rare, 0, 750, 64);
    CHECK(p.contributing == 1);
    CHECK(p.relative_error() == Approx(1.0));
    CHECK(p.mean == Approx(5.0 * 0.5 / (4.0 * 3.14159265 * 4.0)).epsilon(1e-3));
}

TEST_CASE("of many paths some tell the error of all") {
    const mir::PathLuminance some = estimate(Paths(4000, {1.0f}), 4000, 100);
    CHECK(some.paths == 8000);
    CHECK(some.contributing == Approx(4000).epsilon(0.03));
    CHECK(some.relative_error() == Approx(error_of_share(4000, 8000)).epsilon(0.03));
    CHECK(some.mean == Approx(estimate(Paths(4000, {1.0f}), 4000, 4000).mean).epsilon(0.03));
}
