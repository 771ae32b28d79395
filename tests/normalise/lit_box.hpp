// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/fill_visibility.hpp"
#include "normalise/random_records.hpp"

namespace mirtest {

/// The glossy Cornell box seen through luxels, some of them empty, with random records on all of
/// its surfaces and the visibility of every pair.
template <mir::Bsdf B>
struct LitBox {
    using GBuffer = mir::BlockedGBuffer<typename B::Params>;

    World world{glossy_box()};
    BruteForceScene engine{world.geometry};
    mir::VplRecords records;
    mir::VplList vpls;
    GBuffer gbuffer;
    mir::VisibilityMatrix matrix;

    explicit LitBox(mir::Extent image, mir::Extent tile = {32, 16}, std::uint32_t places = 30)
        : records(sample(world, places)),
          vpls(aggregate(records)),
          gbuffer(luxels(image, tile, 0, image.height)),
          matrix(visibility(gbuffer, engine.visibility())) {}
    LitBox(const LitBox&) = delete;
    LitBox& operator=(const LitBox&) = delete;
    ~LitBox() = default;

    /// Rows first .. first + rows - 1 of an image.
    [[nodiscard]] GBuffer luxels(mir::Extent image, mir::Extent tile, std::uint32_t first,
                                 std::uint32_t rows) const {
        GBuffer g({image.width, rows}, tile);
        mir::CameraRays rays;
        rays.camera = world.scene.cameras.front();
        rays.grid.pixels = image;
        mir::InlineExecutor executor;
        mir::fill_gbuffer<B>(g, first, rays, engine.ray_caster(), mir::SurfaceTable<B>(world.scene),
                             executor);
        return g;
    }

    template <class V>
    [[nodiscard]] mir::VisibilityMatrix visibility(const GBuffer& g, const V& sight) const {
        mir::VisibilityMatrix m(g.tiles(), vpls.size());
        mir::InlineExecutor executor;
        fill_visibility(m, g, vpls.span(), sight, executor);
        return m;
    }

 private:
    static mir::VplRecords sample(const World& world, std::uint32_t places) {
        mir::InlineExecutor executor;
        return RandomRecords(world.geometry, places, 71).sample(executor);
    }
};

}  // namespace mirtest
