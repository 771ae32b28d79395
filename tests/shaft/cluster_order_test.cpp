// SPDX-License-Identifier: MIT
#include "mir/shaft/cluster_order.hpp"

#include "conformance/worlds.hpp"
#include "mir/accel/kd_tree_scene.hpp"
#include "mir/core/morton.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scene/builtin.hpp"
#include "shaft/hit_run.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"

#include <set>

namespace {

using mir::Hit;
using mir::Vec3;
using Order = std::vector<std::uint32_t>;

/// Every seventh luxel is empty, some coincide.
std::vector<Hit> random_luxels(std::uint32_t count) {
    mir::Random random = mirtest::test_random(1);
    std::vector<Hit> hits(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        if (i % 7 == 3) continue;
        const Vec3 p = i % 5 == 1 ? hits[i - 1].position : mirtest::point_in_cube(random);
        hits[i] = {p * Vec3(4, 2, 1), mirtest::direction(random)};
    }
    return hits;
}

std::uint32_t used(const std::vector<Hit>& hits) {
    return static_cast<std::uint32_t>(
        std::count_if(hits.begin(), hits.end(), [](const Hit& h) { return !is_empty(h); }));
}

Order order_of(const std::vector<Hit>& hits, float normal_weight = 0.01f) {
    mir::InlineExecutor executor;
    return mir::cluster_order(mirtest::HitRun(hits).view(), {normal_weight}, executor);
}

/// Checks that an order splits luxels by position, and remembers the parts.
class SplitTree {
 public:
    SplitTree(const std::vector<Hit>& hits, const Order& order) : hits_(hits), order_(order) {
        walk(0, used(hits));
    }
    /// Parts whose halves overlap along the axis in which the part is widest.
    [[nodiscard]] std::size_t overlapping() const { return overlapping_; }
    /// Whether each aligned run of 32 2^k luxels is a part.
    [[nodiscard]] bool has_aligned_runs() const {
        const std::uint32_t n = used(hits_);
        for (std::uint32_t size = 32; size <= n; size *= 2)
            for (std::uint32_t first = 0; first + size <= n; first += size)
                if (!parts_.contains({first, size})) return false;
        return true;
    }

 private:
    [[nodiscard]] mir::Bounds box(std::uint32_t first, std::uint32_t count) const {
        mir::Bounds b;
        for (std::uint32_t i = first; i < first + count; ++i) b.add(hits_[order_[i]].position);
        return b;
    }
    void walk(std::uint32_t first, std::uint32_t count) {
        parts_.insert({first, count});
        if (count <= 16) return;
        std::uint32_t part = 16;
        while (2 * part < count) part *= 2;
        const mir::Bounds all = box(first, count);
        const Vec3 size = all.high - all.low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        if (box(first, part).high[axis] > box(first + part, count - part).low[axis]) ++overlapping_;
        walk(first, part);
        walk(first + part, count - part);
    }

    const std::vector<Hit>& hits_;
    const Order& order_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> parts_;
    std::size_t overlapping_ = 0;
};

Order used_luxels(const std::vector<Hit>& hits) {
    Order order;
    for (std::uint32_t i = 0; i < hits.size(); ++i)
        if (!is_empty(hits[i])) order.push_back(i);
    return order;
}

Order morton_order(const std::vector<Hit>& hits) {
    Order order = used_luxels(hits);
    mir::Bounds b;
    for (const std::uint32_t i : order) b.add(hits[i].position);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
        const auto code = [&](std::uint32_t k) {
            return mir::morton_code((hits[k].position - b.low) / (b.high - b.low + 1e-6f));
        };
        return code(i) < code(j);
    });
    return order;
}

/// Sum of the areas of the boxes around runs of luxels, square metres.
double box_area(const std::vector<Hit>& hits, const Order& order, std::uint32_t run) {
    double area = 0.0;
    const std::uint32_t n = used(hits);
    for (std::uint32_t first = 0; first < n; first += run) {
        mir::Bounds b;
        for (std::uint32_t i = first; i < std::min(first + run, n); ++i)
            b.add(hits[order[i]].position);
        const Vec3 d = b.high - b.low;
        area += static_cast<double>(d.x) * d.y + static_cast<double>(d.y) * d.z +
                static_cast<double>(d.z) * d.x;
    }
    return 2.0 * area;
}

/// What the camera of a built-in scene sees.
std::vector<Hit> camera_luxels(std::string_view name) {
    const mirtest::World world(mir::builtin::make(name));
    const mir::KdTreeScene tree(world.geometry);
    const auto caster = tree.ray_caster();
    const mir::Extent extent{160, 120};
    const mir::CameraRays rays{world.scene.cameras.front(), mir::luxel_grid(extent, 1)};
    std::vector<Hit> hits;
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const auto point = caster.closest_hit(rays(x, y));
            hits.push_back(point ? Hit{point->position, point->geometric_normal} : Hit{});
        }
    return hits;
}

}  // namespace

TEST_CASE("A cluster order is a permutation with empty luxels last, in their order") {
    for (const std::uint32_t count : {0u, 1u, 15u, 31u, 32u, 33u, 511u, 513u, 30000u}) {
        const std::vector<Hit> hits = random_luxels(count);
        const Order order = order_of(hits);
        REQUIRE(order.size() == count);
        CHECK(std::set<std::uint32_t>(order.begin(), order.end()).size() == count);
        const auto begin_of_empty = order.begin() + used(hits);
        CHECK(std::none_of(order.begin(), begin_of_empty,
                           [&](std::uint32_t i) { return is_empty(hits[i]); }));
        CHECK(std::is_sorted(begin_of_empty, order.end()));
    }
}

TEST_CASE("Aligned runs of a cluster order are parts of a recursive split by position") {
    for (const std::uint32_t count : {33u, 100u, 513u, 20000u}) {
        const std::vector<Hit> hits = random_luxels(count);
        const Order order = order_of(hits, 0.0f);
        const SplitTree tree(hits, order);
        CHECK(tree.overlapping() == 0);
        CHECK(tree.has_aligned_runs());
    }
}

TEST_CASE("Orders that are no recursive split are noticed") {
    const std::vector<Hit> hits = random_luxels(20000);
    const Order morton = morton_order(hits);
    CHECK(SplitTree(hits, morton).overlapping() > 100);
    const Order as_stored = used_luxels(hits);
    CHECK(SplitTree(hits, as_stored).overlapping() > 100);
    Order moved = order_of(hits, 0.0f);
    std::rotate(moved.begin(), moved.begin() + 8, moved.begin() + used(hits));
    CHECK(SplitTree(hits, moved).overlapping() > 100);
}

TEST_CASE("A cluster order does not depend on threads or on what runs first") {
    const std::vector<Hit> hits = random_luxels(60000);
    const mirtest::HitRun run(hits);
    mir::InlineExecutor one;
    mirtest::BackwardsExecutor many{3};
    const Order order = mir::cluster_order(run.view(), {}, one);
    CHECK(mir::cluster_order(run.view(), {}, many) == order);
}

TEST_CASE("Luxels in one place and luxels all empty have an order") {
    const std::vector<Hit> same(100, Hit{{1, 2, 3}, {0, 0, 1}});
    Order counted(100);
    std::iota(counted.begin(), counted.end(), 0u);
    CHECK(order_of(same) == counted);
    CHECK(order_of(std::vector<Hit>(100)) == counted);
}

TEST_CASE("The weight of normals tells the sides of a sheet apart, no weight does not") {
    mir::Random random = mirtest::test_random(2);
    std::vector<Hit> sheet;
    for (std::uint32_t i = 0; i < 64; ++i)
        sheet.push_back({{random.next(), random.next(), 0}, {0, 0, i % 2 == 0 ? 1 : -1}});
    const auto sides_of_first_half = [&](float weight) {
        std::set<float> sides;
        const Order order = order_of(sheet, weight);
        for (std::uint32_t i = 0; i < 32; ++i) sides.insert(sheet[order[i]].normal.z);
        return sides.size();
    };
    CHECK(sides_of_first_half(1.0f) == 1);
    CHECK(sides_of_first_half(0.0f) == 2);
}

TEST_CASE("Clusters of what cameras see have smaller boxes than those of Morton's curve") {
    const std::string name = GENERATE("cornell-box", "sphere", "door-ajar", "furnace");
    INFO(name);
    const std::vector<Hit> hits = camera_luxels(name);
    REQUIRE(used(hits) > 1000);
    const Order order = order_of(hits);
    const Order morton = morton_order(hits);
    for (const std::uint32_t run : {32u, 256u})
        CHECK(box_area(hits, order, run) <= box_area(hits, morton, run));
}
