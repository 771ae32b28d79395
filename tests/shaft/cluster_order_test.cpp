// SPDX-License-Identifier: MIT
#include "support/shafts/cluster_order.hpp"

#include "conformance/worlds.hpp"
#include "mir/accel/kd/kd_tree_scene.hpp"
#include "mir/core/morton.hpp"
#include "mir/fill_gbuffer.hpp"
#include "mir/scenes.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <numeric>
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

mir::detail::ClusterKey position_key(const Hit& hit) {
    return {hit.position.x, hit.position.y, hit.position.z, 0.0f, 0.0f, 0.0f};
}

/// The directions of all cuts of a part of an order by position.
std::vector<mir::detail::ClusterKey> cut_directions(const std::vector<Hit>& hits,
                                                    const Order& part) {
    mir::detail::KeyScatter scatter(position_key(hits[part.front()]));
    for (const std::uint32_t i : part) scatter.add(position_key(hits[i]));
    return {{1, 0, 0, 0, 0, 0}, {0, 1, 0, 0, 0, 0}, {0, 0, 1, 0, 0, 0}, scatter.principal_axis()};
}

/// Luxels times the size of their box, metres.
double cost(const std::vector<Hit>& hits, const Order& part) {
    mir::Bounds b;
    for (const std::uint32_t i : part) b.add(hits[i].position);
    const Vec3 d = b.high - b.low;
    return static_cast<double>(part.size()) * (d.x + d.y + d.z);
}

/// Checks that an order splits luxels by position, and remembers the parts.
class SplitTree {
 public:
    SplitTree(const std::vector<Hit>& hits, const Order& order) : hits_(hits), order_(order) {
        walk(0, used(hits));
    }
    /// Parts whose halves overlap in all directions.
    [[nodiscard]] std::size_t overlapping() const { return overlapping_; }
    /// Parts for whose halves there is a cheaper cut.
    [[nodiscard]] std::size_t dear() const { return dear_; }
    /// Whether each aligned run of 32 2^k luxels is a part.
    [[nodiscard]] bool has_aligned_runs() const {
        const std::uint32_t n = used(hits_);
        for (std::uint32_t size = 32; size <= n; size *= 2)
            for (std::uint32_t first = 0; first + size <= n; first += size)
                if (!parts_.contains({first, size})) return false;
        return true;
    }

 private:
    [[nodiscard]] Order run(std::uint32_t first, std::uint32_t count) const {
        return {order_.begin() + first, order_.begin() + first + count};
    }
    [[nodiscard]] float along(std::uint32_t i, const mir::detail::ClusterKey& direction) const {
        return mir::detail::key_along(position_key(hits_[i]), direction);
    }
    [[nodiscard]] double cost_of_cut(Order part, std::uint32_t first_half,
                                     const mir::detail::ClusterKey& direction) const {
        std::sort(part.begin(), part.end(), [&](std::uint32_t i, std::uint32_t j) {
            return std::pair(along(i, direction), i) < std::pair(along(j, direction), j);
        });
        const auto middle = part.begin() + first_half;
        return cost(hits_, {part.begin(), middle}) + cost(hits_, {middle, part.end()});
    }
    [[nodiscard]] bool overlap(const Order& low, const Order& high,
                               const mir::detail::ClusterKey& direction) const {
        // Sums for the principal axis are made in another order here.
        constexpr float rounding = 1e-4f;
        float end = -INFINITY;
        float begin = INFINITY;
        for (const std::uint32_t i : low) end = std::max(end, along(i, direction));
        for (const std::uint32_t i : high) begin = std::min(begin, along(i, direction));
        return end > begin + rounding;
    }
    void walk(std::uint32_t first, std::uint32_t count) {
        parts_.insert({first, count});
        if (count <= 16) return;
        std::uint32_t part = 16;
        while (2 * part < count) part *= 2;
        const Order low = run(first, part);
        const Order high = run(first + part, count - part);
        const double own = cost(hits_, low) + cost(hits_, high);
        bool is_split = false;
        bool is_dear = false;
        for (const auto& direction : cut_directions(hits_, run(first, count))) {
            is_split = is_split || !overlap(low, high, direction);
            const double other = cost_of_cut(run(first, count), part, direction);
            // Rounding may move luxels between the halves of a cut by the principal axis.
            is_dear = is_dear || own > 1.001 * other;
        }
        overlapping_ += is_split ? 0 : 1;
        dear_ += is_dear ? 1 : 0;
        walk(first, part);
        walk(first + part, count - part);
    }

    const std::vector<Hit>& hits_;
    const Order& order_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> parts_;
    std::size_t overlapping_ = 0;
    std::size_t dear_ = 0;
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

TEST_CASE("Aligned runs of a cluster order are parts of a recursive split by the cheapest cuts") {
    for (const std::uint32_t count : {33u, 100u, 513u, 20000u}) {
        const std::vector<Hit> hits = random_luxels(count);
        const Order order = order_of(hits, 0.0f);
        const SplitTree tree(hits, order);
        CHECK(tree.overlapping() == 0);
        CHECK(tree.dear() == 0);
        CHECK(tree.has_aligned_runs());
    }
}

TEST_CASE("Cuts into parts of different sizes are the cheapest, too") {
    for (std::uint32_t count = 40; count < 700; count += 13) {
        const std::vector<Hit> hits = random_luxels(count);
        CHECK(SplitTree(hits, order_of(hits, 0.0f)).dear() == 0);
    }
}

TEST_CASE("Luxels of the smallest clusters are in the order of their indices") {
    const std::vector<Hit> hits = random_luxels(20000);
    const Order order = order_of(hits);
    for (std::uint32_t first = 0; first < used(hits); first += 16) {
        const auto begin = order.begin() + first;
        CHECK(std::is_sorted(begin, begin + std::min(16u, used(hits) - first)));
    }
}

TEST_CASE("Orders that are no recursive split are noticed") {
    const std::vector<Hit> hits = random_luxels(20000);
    Order moved = order_of(hits, 0.0f);
    std::rotate(moved.begin(), moved.begin() + 8, moved.begin() + used(hits));
    for (const Order& order : {morton_order(hits), used_luxels(hits), moved}) {
        const SplitTree tree(hits, order);
        CHECK(tree.overlapping() > 100);
        CHECK(tree.dear() > 100);
    }
}

TEST_CASE("Surfaces are taken apart where that leaves smaller boxes than the widest key") {
    std::vector<Hit> hits;
    for (std::uint32_t i = 0; i < 64; ++i)
        hits.push_back({{static_cast<float>(i) / 16.0f, i % 2 == 0 ? 0.0f : 3.0f, 0}, {0, 0, 1}});
    const Order order = order_of(hits);
    for (std::uint32_t i = 0; i < 64; ++i) CHECK(order[i] % 2 == i / 32);
}

TEST_CASE("Keys scatter most along the long side of a slanted sheet") {
    mir::Random random = mirtest::test_random(3);
    const Vec3 along = glm::normalize(Vec3(1, 2, -2));
    const Vec3 across = glm::normalize(glm::cross(along, Vec3(0, 0, 1)));
    const Vec3 far(1000, -2000, 500);
    const auto key = [](Vec3 p) { return position_key({p, {}}); };
    mir::detail::KeyScatter scatter(key(far));
    for (int i = 0; i < 1000; ++i)
        scatter.add(key(far + 4.0f * random.next() * along + random.next() * across));
    const auto axis = scatter.principal_axis();
    const Vec3 found(axis[0], axis[1], axis[2]);
    // Hypothesis: the axis is the sheet's. The standard error of the angle in the sheet is
    // 0.27 / sqrt(1000) = 0.0085 with 1000 points, so that 0.05 is 5.9 of them: level 4e-9.
    CHECK(std::abs(glm::dot(found, along)) > std::cos(0.05f));
    CHECK(glm::length(found) == Approx(1.0f));
    mir::detail::KeyScatter one(key(far));
    one.add(key(far));
    CHECK(one.principal_axis() == mir::detail::ClusterKey{});
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
