// SPDX-License-Identifier: MIT
#include "mir/shaft/device/pair_segments.hpp"

#include "shaft/cluster_draws.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <vector>

// Planes that are kept, and what they do to the 32 segments of a pair, against hits_segment().

namespace {

using mir::KeptPlanes;
using mir::LaneGroup;
using mir::PlaneRange;
using mir::Vec3;

using Words = std::array<std::uint32_t, sizeof(mir::SurePlanes) / 4>;

constexpr float sigma = 0x1p-19f;
const Vec3 apex(0.1f, -0.05f, 0.9f);

/// A VPL, a cluster and triangles between them, of which planes were made.
class FormedPair {
 public:
    /// Triangles of about that size.
    FormedPair(std::uint64_t seed, std::uint32_t triangles, float size)
        : random_(mirtest::test_random(seed)) {
        const mir::Hit middle{0.5f * mirtest::point_in_cube(random_) - Vec3(0, 0, 0.4f),
                              glm::normalize(Vec3(0, 0, 1) + 0.4f * mirtest::direction(random_))};
        // Luxels before and behind those of the pair, which it must not ask about.
        for (std::uint32_t k = 0; k < 96; ++k)
            hits_.push_back(k / 32 == 1 ? mirtest::hit_beside(middle, 0.02f, random_)
                                        : mir::Hit{Vec3(0.9f), Vec3(0, 0, 1)});
        const mirtest::HitRun run(hits_);
        pyramid_ = mir::make_pyramid(mir::cluster_record(run.view(), 32, 32, sigma), apex, sigma);
        for (std::uint32_t k = 0; k < triangles; ++k) add_triangle(k, middle.position, size);
    }

    [[nodiscard]] std::uint32_t by_forms(PlaneRange range, std::uint32_t lit) const {
        const mirtest::HitRun run(hits_);
        const LaneGroup group;
        mir::PairSegments segments(group, run.view(), 32, pyramid_);
        return segments.lit_behind(planes_, range, rows_.data(), lit);
    }
    [[nodiscard]] std::uint32_t by_triangles(PlaneRange range, std::uint32_t lit) const {
        for (std::uint32_t k = 0; k < 32; ++k)
            for (std::uint32_t t = range.first; t < range.end; ++t)
                if (mir::hits_segment(rows_[place(t)], apex, hits_[32 + k].position))
                    lit &= ~(1u << k);
        return lit;
    }
    [[nodiscard]] const KeptPlanes& planes() const { return planes_; }

 private:
    [[nodiscard]] static std::uint32_t place(std::uint32_t kept) { return 38 - kept; }

    /// Every third has an edge across one of the segments, which planes are not sure of.
    void add_triangle(std::uint32_t kept, Vec3 towards, float size) {
        const bool is_close = kept % 3 == 0;
        const Vec3 end = is_close ? hits_[32 + kept].position : towards;
        const Vec3 at = apex + (0.3f + 0.6f * random_.next()) * (end - apex);
        const auto aside = [&] { return size * mirtest::point_in_cube(random_); };
        const Vec3 a = at + aside();
        const Vec3 b = is_close ? at + (at - a) : at + aside();
        rows_[place(kept)] = mir::make_triangle_rows(a, b, at + aside());
        mir::ShadowPlanes made;
        static_cast<void>(mir::occlusion(rows_[place(kept)], pyramid_, made));
        planes_.put(kept,
                    mir::in_margins(made, mir::OcclusionMargins::plane * sigma,
                                    mir::OcclusionMargins::hit_share),
                    place(kept));
    }

    mir::Random random_;
    std::vector<mir::Hit> hits_;
    mir::Pyramid pyramid_;
    std::vector<mir::TriangleRows> rows_ =
        std::vector<mir::TriangleRows>(39);  ///< places are not those of planes
    KeptPlanes planes_;
};

mir::SurePlanes numbered_planes(float n) {
    return {{n, n + 1, n + 2, n + 3},
            {n + 4, n + 5, n + 6, n + 7},
            {n + 8, n + 9, n + 10, n + 11},
            {n + 12, n + 13, n + 14, n + 15}};
}

}  // namespace

TEST_CASE("Kept planes are what was put there, at all places and in any order") {
    KeptPlanes planes;
    for (std::uint32_t k = 0; k < KeptPlanes::capacity; ++k) {
        const std::uint32_t at = k * 5 % KeptPlanes::capacity;
        planes.put(at, numbered_planes(100.0f * static_cast<float>(at)), 1000 + at);
    }
    planes.put(3, numbered_planes(7.0f), 77);
    for (std::uint32_t at = 0; at < KeptPlanes::capacity; ++at) {
        const mir::SurePlanes there = planes.get(at);
        const mir::SurePlanes wanted =
            numbered_planes(at == 3 ? 7.0f : 100.0f * static_cast<float>(at));
        CHECK(std::bit_cast<Words>(there) == std::bit_cast<Words>(wanted));
        CHECK(planes.triangle(at) == (at == 3 ? 77 : 1000 + at));
    }
    CHECK(PlaneRange{4, 4}.empty());
    CHECK_FALSE(PlaneRange{4, 5}.empty());
}

TEST_CASE("Segments of a pair are hidden where a triangle of the range hits them") {
    std::size_t hidden = 0, kept = 0, wrong = 0;
    for (std::uint32_t draw = 0; draw < 400; ++draw) {
        const float size = 0.002f * std::pow(20.0f, static_cast<float>(draw % 10) / 9.0f);
        const FormedPair pair(500 + draw, 32, size);
        mir::Random random = mirtest::test_random(1000 + draw);
        for (std::uint32_t k = 0; k < 12; ++k) {
            const auto first = static_cast<std::uint32_t>(random.next() * 31.99f);
            const auto count = 1 + static_cast<std::uint32_t>(random.next() *
                                                              (31.99f - static_cast<float>(first)));
            const PlaneRange range = k == 0 ? PlaneRange{0, 32} : PlaneRange{first, first + count};
            const std::uint32_t lit = k % 3 == 0 ? ~0u : 0x0F0F3355u << k % 4;
            const std::uint32_t truth = pair.by_triangles(range, lit);
            wrong += pair.by_forms(range, lit) == truth ? 0 : 1;
            hidden += static_cast<std::size_t>(std::popcount(lit & ~truth));
            kept += static_cast<std::size_t>(std::popcount(truth));
        }
    }
    INFO(hidden << " hidden, " << kept << " kept");
    CHECK(wrong == 0);
    CHECK(hidden > 10000);
    CHECK(kept > 10000);
}
