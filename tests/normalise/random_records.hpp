// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/worlds.hpp"
#include "mir/concepts/sampler.hpp"

namespace mirtest {

/// Records of arbitrary light at arbitrary points of a scene, one to three paths of different
/// colour, bounce, light group and weight at each: whatever the normalisation stage makes of them,
/// the luminance of the image must be P_c. Model of Sampler; the geometry must outlive it.
class RandomRecords {
 public:
    static constexpr mir::Normalisation normalisation = mir::Normalisation::image_response;
    static constexpr double path_luminance = 0.37;  // P_c, W m^-2 sr^-1

    RandomRecords(const mir::WorldGeometry& geometry, std::uint32_t places, std::uint64_t seed)
        : geometry_(&geometry), places_(places), seed_(seed) {}

    template <mir::Executor E>
    [[nodiscard]] mir::VplRecords sample(E& /*executor*/) const {
        mir::VplRecords out;
        out.path_luminance = path_luminance;
        mir::Random random = test_random(seed_);
        for (std::uint32_t i = 0; i < places_; ++i) {
            mir::SurfacePoint p = random_surface_point(*geometry_, random);
            if (i % 5 != 0) turn_inwards(p);
            const std::uint32_t paths = 1 + i % 3;
            for (std::uint32_t k = 0; k < paths; ++k)
                out.records.push_back(record(p, i, k, random));
        }
        for (const mir::VplRecord& r : out.records) out.states += static_cast<double>(r.weight);
        return out;
    }

 private:
    /// Most points shine into the box, around whose centre the Cornell scenes are built.
    static void turn_inwards(mir::SurfacePoint& p) {
        const mir::Vec3 inwards = mir::Vec3(0, 1, 0) - p.position;
        if (glm::dot(p.geometric_normal, inwards) < 0.0f) p.geometric_normal = -p.geometric_normal;
    }

    [[nodiscard]] mir::VplRecord record(const mir::SurfacePoint& p, std::uint32_t i,
                                        std::uint32_t k, mir::Random& random) const {
        mir::VplRecord r;
        const mir::Vec3 n = p.geometric_normal;
        const float power = 0.001f + 100.0f * random.next() * random.next();
        const mir::Rgb colour{random.next(), random.next() * random.next(), random.next()};
        r.vpl = {mir::lift(p), n, colour * power};
        r.origin = {mir::VplKind::reflective, p.triangle, p.barycentrics};
        r.bounce = static_cast<std::uint8_t>(2 + (i + k) % 4);
        r.light_group = static_cast<std::uint16_t>(k % 2);
        r.weight = static_cast<float>(1 + (i + 2 * k) % 4);
        return r;
    }

    const mir::WorldGeometry* geometry_;
    std::uint32_t places_;
    std::uint64_t seed_;
};
static_assert(mir::Sampler<RandomRecords>);

}  // namespace mirtest
