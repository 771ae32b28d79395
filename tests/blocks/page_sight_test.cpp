// SPDX-License-Identifier: MIT
#include "mir/blocks/page_sight.hpp"

#include "mir/data/vpl_list.hpp"
#include "mir/shading/contribution.hpp"
#include "shaft/stepped_plane.hpp"
#include "support/catch.hpp"
#include "support/packet_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace {

using mir::BlockMask;
using mir::Hit;
using mir::Vec3;
using mirtest::LuxelPlanes;

/// Hides what lies on every second strip, seen from the left of x = 0. Model of BlockVisibility
/// that counts the blocks it was told of.
struct Strips {
    static constexpr mir::Space space = mir::Space::host;

    /// Positions of luxels. Stays where it was made.
    struct Block {
        explicit Block(const mir::SoaView<const Hit>& luxels) {
            for (std::uint32_t i = 0; i < BlockMask::luxels; ++i)
                positions[i] = luxels.load(i).position;
        }
        Block(const Block&) = delete;
        Block& operator=(const Block&) = delete;
        ~Block() = default;

        std::array<Vec3, BlockMask::luxels> positions;
    };

    std::size_t* blocks = nullptr;
    float width = 0.0f;  ///< of a strip, metres

    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const {
        return a.x >= 0.0f || std::fmod(std::floor((b.x + 0.005f) / width), 2.0f) == 0.0f;
    }
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const mir::PointPacket& points,
                                               std::uint32_t active) const {
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k)
            if (visible(origin, mirtest::point_of(points, k))) seen |= 1u << k;
        return seen & active;
    }
    [[nodiscard]] Block block(const mir::SoaView<const Hit>& luxels, mir::InstructionSet) const {
        ++*blocks;
        return Block(luxels);
    }
    void visible_block(const Block& block, Vec3 origin, BlockMask& mask) const {
        for (std::uint32_t i = 0; i < BlockMask::luxels; ++i)
            if (!visible(origin, block.positions[i])) mask.packet[i / 16] &= ~(1u << i % 16);
    }
};
static_assert(mir::BlockVisibility<Strips>);

/// A page of a plane without edges, seen from above.
struct Page {
    mir::BlockedLayout layout{2, 2};
    LuxelPlanes luxels = mirtest::stepped_plane(layout, 1000);
    std::size_t blocks = 0;
    float strip = 0.03f;  ///< metres

    [[nodiscard]] Strips visibility() { return {&blocks, strip}; }
    [[nodiscard]] mir::LuxelPage page() const { return mir::LuxelPages{layout}[0]; }
};

/// Every third luxel does not count.
bool is_wanted(std::uint32_t slot) { return slot % 3 != 0; }

/// Bits of a page and of VPLs at these places that are not those of single segments; asks for 16
/// VPLs at a time.
std::size_t wrong_bits(Page& page, const std::vector<Vec3>& places) {
    mir::VplList vpls;
    for (const Vec3& p : places) vpls.push_back({p, {0, 0, -1}, {1, 1, 1}}, {});
    const Strips visibility = page.visibility();
    mir::blocks::PageSight<Strips> sight(std::as_const(page.luxels).view(), page.page(), visibility,
                                         mir::InstructionSet::baseline, is_wanted);
    const mir::LuxelPage luxels = page.page();
    std::size_t wrong = 0;
    for (std::uint32_t first = 0; first < vpls.size(); first += 16) {
        const std::uint32_t count = std::min(16u, vpls.size() - first);
        const std::uint32_t seen =
            sight.look(vpls.span(), first, count, [](const mir::Vpl&) { return true; });
        for (std::uint32_t slot = 0; slot < luxels.luxels(); ++slot)
            for (std::uint32_t k = 0; k < count; ++k) {
                const Hit hit = page.luxels.view().load(luxels.slot(slot));
                const mir::Vpl vpl = vpls.span()[first + k];
                const bool wanted = is_wanted(slot) && faces(hit, vpl) &&
                                    visibility.visible(vpl.position, hit.position);
                const BlockMask mask =
                    (seen >> k & 1u) != 0 ? sight.seen(slot / BlockMask::luxels, k) : BlockMask{};
                const std::uint32_t i = slot % BlockMask::luxels;
                wrong += (mask.packet[i / 16] >> i % 16 & 1u) != (wanted ? 1u : 0u) ? 1 : 0;
            }
    }
    return wrong;
}

}  // namespace

TEST_CASE("A page is sorted once VPLs have lit many of its packets in part, and keeps its bits") {
    Page page;
    CHECK(wrong_bits(page, std::vector<Vec3>(40, Vec3(-1, 0, 2))) == 0);
    CHECK(page.blocks == 2 * page.page().blocks());
}

TEST_CASE("A page whose packets are lit or dark as a whole stays as it is") {
    Page page;
    std::vector<Vec3> places(40, Vec3(1, 0, 2));
    CHECK(wrong_bits(page, places) == 0);
    CHECK(page.blocks == page.page().blocks());
    page.blocks = 0;
    page.strip = 0.04f;  // as wide as a packet
    std::fill(places.begin(), places.end(), Vec3(-1, 0, 2));
    CHECK(wrong_bits(page, places) == 0);
    CHECK(page.blocks == page.page().blocks());
}

TEST_CASE("Nothing is made of a page for VPLs that nobody faces") {
    Page page;
    page.luxels = mirtest::stepped_plane(page.layout, 3);
    const Vec3 below(-1, 0, -2);
    CHECK(wrong_bits(page, std::vector<Vec3>(40, below)) == 0);
    CHECK(page.blocks == 0);
    std::vector<Vec3> places(20, below);
    places.resize(40, Vec3(-1, 0, 2));
    CHECK(wrong_bits(page, places) == 0);
    CHECK(page.blocks == page.page().blocks());
}

TEST_CASE("VPLs that do not matter are not asked about") {
    Page page;
    mir::VplList vpls;
    for (int k = 0; k < 16; ++k)
        vpls.push_back({{-1, 0, k < 8 ? 2.0f : 3.0f}, {0, 0, -1}, {1, 1, 1}}, {});
    const Strips visibility = page.visibility();
    mir::blocks::PageSight<Strips> sight(std::as_const(page.luxels).view(), page.page(), visibility,
                                         mir::InstructionSet::baseline, is_wanted);
    CHECK(sight.look(vpls.span(), 0, 16, [](const mir::Vpl&) { return false; }) == 0);
    CHECK(page.blocks == 0);
    const auto is_high = [](const mir::Vpl& vpl) { return vpl.position.z > 2.5f; };
    CHECK(sight.look(vpls.span(), 0, 16, is_high) == 0xFF00u);
    CHECK(page.blocks == page.page().blocks());
}

TEST_CASE("A page of several surfaces is sorted before anybody asks") {
    Page page;
    page.luxels = mirtest::stepped_plane(page.layout, 3);
    CHECK(wrong_bits(page, std::vector<Vec3>(40, Vec3(-1, 0, 2))) == 0);
    CHECK(page.blocks == page.page().blocks());
}
