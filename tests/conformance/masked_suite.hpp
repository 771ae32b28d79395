// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/masked_soup.hpp"
#include "conformance/packet_suite.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "support/masked_scene.hpp"
#include "support/packet_points.hpp"

// What alpha masks cut away is there for no ray: single segments, packets and closest hits of an
// engine against brute force in double precision, which looks texels up by itself.

namespace mirtest {

/// Brute force that knows masks of nearest texels of images that repeat.
class MaskedReferee {
 public:
    explicit MaskedReferee(const World& world) : world_(world), triangles_(world.geometry) {}

    /// How surely the point is there: positive in what is kept, negative in holes, and near zero
    /// near the edge of a texel or of the triangle.
    [[nodiscard]] double solid(std::uint32_t triangle, const LineHit& hit) const {
        const mir::WorldGeometry& g = world_.geometry;
        const mir::Material& m = world_.scene.materials[g.material_of(triangle)];
        const mir::Texture& texture = m.textures.base_color;
        double margin = 1.0;
        double alpha = double{m.alpha};
        if (texture.is_set()) {
            const auto place = texel_of(triangle, hit, world_.scene.images[texture.image], margin);
            alpha *= (place >> 24) / 255.0;
        }
        return alpha >= double{m.alpha_cutoff} ? margin : -margin;
    }

    /// First triangle along origin + t direction with 0 < t < end, `none` without one; `doubtful`
    /// where single precision may say something else.
    struct Answer {
        std::uint32_t triangle = Referee::none;
        bool doubtful = false;
    };

    [[nodiscard]] Answer first(mir::Vec3 origin, mir::Vec3 direction, double end) const {
        constexpr double tie = 1e-4;
        double first_t = end;
        Answer answer;
        double nearest_doubt = end;
        for (std::uint32_t i = 0; i < world_.geometry.triangles().size(); ++i) {
            const auto hit = triangles_.line(i, Double3(origin), Double3(direction));
            if (!hit || hit->t < -tie || hit->t > end + tie || hit->inside() < -tie) continue;
            const double kept = solid(i, *hit);
            const double sure = std::min(
                {std::fabs(hit->inside()), std::fabs(kept), hit->t, std::fabs(end - hit->t)});
            if (sure < tie) nearest_doubt = std::min(nearest_doubt, hit->t - tie);
            if (sure < tie || kept < 0.0 || hit->inside() < 0.0 || hit->t > first_t) continue;
            if (first_t - hit->t < tie) nearest_doubt = std::min(nearest_doubt, hit->t);
            first_t = hit->t;
            answer.triangle = i;
        }
        answer.doubtful = nearest_doubt < first_t + tie && nearest_doubt < end;
        return answer;
    }

 private:
    /// Texel at a point; `margin` becomes its distance from the texel's border, in texels.
    [[nodiscard]] std::uint32_t texel_of(std::uint32_t triangle, const LineHit& hit,
                                         const mir::TextureImage& image, double& margin) const {
        const mir::WorldGeometry& g = world_.geometry;
        const mir::TriangleIndices& t = g.triangles()[triangle];
        const auto uv = g.texture_coordinates();
        const auto at = [&](int axis, std::uint32_t size) {
            const double c = (1.0 - hit.u - hit.v) * double{uv[t[0]][axis]} +
                             hit.u * double{uv[t[1]][axis]} + hit.v * double{uv[t[2]][axis]};
            const double x = (c - std::floor(c)) * size;
            margin = std::min(margin, std::fabs(x - std::round(x)));
            return std::min(static_cast<std::uint32_t>(x), size - 1);
        };
        const std::uint32_t column = at(0, image.width);
        return image.texels[at(1, image.height) * image.width + column];
    }

    const World& world_;
    Referee triangles_;
};

/// Questions asked, and answers that no rounding excuses.
struct MaskedCount {
    std::size_t asked = 0;
    std::size_t doubtful = 0;
    std::size_t met = 0;
    std::size_t wrong = 0;
};

inline void check_masked(const MaskedCount& c) {
    INFO(c.met << " of " << c.asked << " met something, " << c.doubtful << " are doubtful");
    CHECK(c.met > c.asked / 10);
    CHECK(c.met < c.asked * 9 / 10);
    CHECK(c.doubtful < c.asked / 10);
    CHECK(c.wrong == 0);
}

/// Points below a checkerboard of 8 x 8 fields over [-1,1]^2 at height 1, seen from height 2: lines
/// cross it half way, and fields of an even sum of indices hide them. Points close to the border of
/// a field are left out.
template <class Engine>
void checkerboard_casts_its_shadow() {
    mir::Scene scene;
    hang_curtain(scene, masked(1.0f, 0.5f), 8, {-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
    const World world(std::move(scene));
    const Engine engine(world.geometry);
    const auto visibility = engine.visibility();
    const mir::Vec3 apex(0.1f, 2.0f, -0.2f);
    mir::Random random = test_random(80);
    std::size_t asked = 0;
    std::size_t open = 0;
    std::size_t wrong = 0;
    for (int i = 0; i < 500; ++i) {
        mir::PointPacket points{};
        std::uint32_t hidden = 0;
        std::uint32_t active = 0;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            const mir::Vec3 p(4.0f * random.next() - 2.0f, 0.0f, 4.0f * random.next() - 2.0f);
            set_point(points, k, p);
            const double x = 4.0 * (0.5 * (double{apex.x} + double{p.x}) + 1.0);
            const double z = 4.0 * (0.5 * (double{apex.z} + double{p.z}) + 1.0);
            if (std::min(std::fabs(x - std::round(x)), std::fabs(z - std::round(z))) < 1e-4)
                continue;
            active |= 1u << k;
            const bool inside = x > 0.0 && x < 8.0 && z > 0.0 && z < 8.0;
            const auto field = static_cast<int>(x) + static_cast<int>(z);
            if (inside && field % 2 == 0) hidden |= 1u << k;
        }
        const std::uint32_t seen = visibility.visible_packet(apex, points, active);
        wrong += seen != (active & ~hidden) ? 1 : 0;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k) {
            if ((active >> k & 1u) == 0) continue;
            const mir::Vec3 p = point_of(points, k);
            const bool sees = visibility.visible(apex, p);
            wrong += sees == ((hidden >> k & 1u) != 0) ? 1 : 0;
            ++asked;
            open += sees ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
    CHECK(open > asked / 3);
    CHECK(open < asked * 2 / 3);
}

template <class Engine>
void masked_suite() {
    SECTION("a checkerboard casts its shadow") { checkerboard_casts_its_shadow<Engine>(); }
    std::vector<mir::Material> materials = soup_materials();
    materials.pop_back();  // the referee knows nearest texels alone
    const World world = masked_soup(200, 81, materials);
    const Engine engine(world.geometry);
    const MaskedReferee referee(world);
    mir::Random random = test_random(82);
    SECTION("shadows of single segments have holes") {
        MaskedCount count;
        for (int i = 0; i < 10000; ++i) {
            const mir::Vec3 a = point_in_cube(random);
            const mir::Vec3 b = point_in_cube(random);
            const auto wanted = referee.first(a, b - a, 1.0);
            const bool hidden = !engine.visibility().visible(a, b);
            ++count.asked;
            count.doubtful += wanted.doubtful ? 1 : 0;
            count.met += hidden ? 1 : 0;
            count.wrong += !wanted.doubtful && hidden != (wanted.triangle != Referee::none);
        }
        check_masked(count);
    }
    SECTION("packets answer like single segments") {
        const auto visibility = engine.visibility();
        const PacketCount far = scattered_packets(visibility, Referee(world.geometry), 1000);
        const PacketCount near = coherent_packets(visibility, Referee(world.geometry), 1000);
        for (const PacketCount& count : {far, near}) {
            INFO(count.different << " of " << count.lanes << " lanes differ");
            CHECK(count.seen > count.lanes / 10);
            CHECK(count.seen < count.lanes);
            CHECK(count.different * 10000 <= count.lanes);
        }
    }
    SECTION("rays go through holes") {
        MaskedCount count;
        for (const mir::Ray& ray : random_rays(10000, 83)) {
            const auto wanted = referee.first(ray.origin, ray.direction, 10.0);
            const auto found = engine.ray_caster().closest_hit(ray);
            ++count.asked;
            count.doubtful += wanted.doubtful ? 1 : 0;
            count.met += found ? 1 : 0;
            count.wrong +=
                !wanted.doubtful && (found ? found->triangle : Referee::none) != wanted.triangle;
        }
        check_masked(count);
    }
}

}  // namespace mirtest
