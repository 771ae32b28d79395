// SPDX-License-Identifier: MIT
#include "micro/surfel_worlds.hpp"
#include "mir/micro/surfel_tree_build.hpp"
#include "support/catch.hpp"

#include <map>

using namespace mirtest;
using mir::SphereFit;
using mir::Surfel;
using mir::SurfelNode;
using mir::SurfelSplit;
using mir::SurfelTree;
using mir::Vec3;

namespace {

using Long3 = glm::vec<3, long double>;

/// Distance to the farthest point of a disc, in extended precision.
long double reach(const Surfel& s, Long3 from) {
    const Long3 n = glm::normalize(Long3(s.normal));
    const Long3 d = Long3(s.position) - from;
    const long double height = glm::dot(d, n);
    const long double along = glm::length(glm::cross(d, n)) + s.radius;
    return std::sqrt(height * height + along * along);
}

/// What walking a tree counts.
struct TreeCount {
    std::uint32_t depth = 0;     ///< most nodes on the way to a disc
    std::uint32_t outside = 0;   ///< discs that reach out of a node's sphere
    std::uint32_t off_axis = 0;  ///< normals outside of a node's cone
    std::uint32_t broken = 0;    ///< nodes whose numbers do not fit their children
    double sums_off = 0.0;       ///< largest relative error of an area
    double albedo_off = 0.0;     ///< largest error of an albedo
    double radii = 0.0;          ///< sum over nodes, metres
};

void check_node(const SurfelTree& tree, std::span<const mir::Rgb> colors, std::uint32_t index,
                std::uint32_t depth, TreeCount& count) {
    const SurfelNode& node = tree.nodes()[index];
    const Long3 axis = glm::normalize(Long3(node.axis));
    long double area = 0;
    long double red = 0;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const Surfel& s = tree.surfels()[i];
        if (!node.is_leaf() && reach(s, Long3(node.centre)) > node.radius) ++count.outside;
        if (glm::dot(axis, glm::normalize(Long3(s.normal))) < node.cos_angle - 1e-18L)
            ++count.off_axis;
        area += s.area;
        red += s.area * static_cast<long double>(colors[s.material].r);
    }
    count.sums_off = std::max(count.sums_off, double(std::fabs(tree.area()[index] - area) / area));
    count.albedo_off =
        std::max(count.albedo_off, std::fabs(double(tree.albedo()[index].r - red / area)));
    count.depth = std::max(count.depth, depth);
    count.radii += double(node.radius);
}

/// Checks the node and all below it; returns the index behind them.
std::uint32_t walk(const SurfelTree& tree, std::span<const mir::Rgb> colors, std::uint32_t index,
                   std::uint32_t depth, TreeCount& count) {
    check_node(tree, colors, index, depth, count);
    const SurfelNode& node = tree.nodes()[index];
    if (node.is_leaf()) {
        const Surfel& s = tree.surfels()[node.first];
        const bool same = node.count == 1 && node.centre == s.position && node.radius == s.radius &&
                          node.axis == s.normal;
        count.broken += same ? 0 : 1;
        return index + 1;
    }
    const SurfelNode& left = tree.nodes()[index + 1];
    const SurfelNode& right = tree.nodes()[node.right];
    const bool whole = left.first == node.first && right.first == left.first + left.count &&
                       node.count == left.count + right.count;
    const std::uint32_t between = walk(tree, colors, index + 1, depth + 1, count);
    count.broken += whole && between == node.right ? 0 : 1;
    return walk(tree, colors, node.right, depth + 1, count);
}

/// Checks that a tree is one, over the discs that were given.
TreeCount check_whole(const World& world, const SurfelTree& tree, std::span<const Surfel> given) {
    TreeCount count;
    std::vector<mir::Rgb> colors;
    for (const mir::Material& m : world.scene.materials) colors.push_back(m.base_color);
    REQUIRE(tree.nodes().size() == 2 * given.size() - 1);
    CHECK(walk(tree, colors, 0, 1, count) == tree.nodes().size());
    CHECK(count.broken == 0);
    CHECK(count.outside == 0);
    CHECK(count.off_axis == 0);
    CHECK(count.sums_off <= 0x1.001p-24);
    CHECK(count.albedo_off <= 0x1p-24);
    const auto place = [](const Surfel& a, const Surfel& b) {
        return std::tie(a.triangle, a.position.x, a.position.y, a.position.z) <
               std::tie(b.triangle, b.position.x, b.position.y, b.position.z);
    };
    std::vector<Surfel> before(given.begin(), given.end());
    std::vector<Surfel> after(tree.surfels().begin(), tree.surfels().end());
    std::sort(before.begin(), before.end(), place);
    std::sort(after.begin(), after.end(), place);
    CHECK(equal_bytes<Surfel>(before, after));
    return count;
}

/// Discs of no size worth mentioning at the given points.
std::vector<Surfel> specks(std::span<const Vec3> points) {
    std::vector<Surfel> out;
    for (Vec3 p : points) out.push_back({p, 1e-6f, {0, 0, 1}, 1e-12f, 0, 0});
    return out;
}

mir::Rgb all_grey(const Surfel&) { return {0.5f, 0.5f, 0.5f}; }

SurfelTree tree_over(std::vector<Surfel> surfels, SphereFit fit) {
    mir::InlineExecutor executor;
    mir::SurfelTreeOptions options;
    options.sphere = fit;
    return {std::move(surfels), all_grey, options, executor};
}

}  // namespace

TEST_CASE("Spheres and cones of a disc tree hold what is below them, areas are sums") {
    const float scale = GENERATE(1e-3f, 1.0f);
    const World worlds[] = {triangle_soup(60, 920, scale, scale * Vec3(300, -100, 30)),
                            needles(20, 1e4f, 921), thin_wall(), coincident(40)};
    const float areas[] = {2e-3f * scale * scale, 1e-6f, 1e-2f, 0.1f};
    mir::SurfelTreeOptions options;
    options.sphere = GENERATE(SphereFit::mean, SphereFit::ritter, SphereFit::smallest);
    options.split = GENERATE(SurfelSplit::median, SurfelSplit::orientation);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto given = surfels_of(worlds[i], areas[i]);
        check_whole(worlds[i], tree_of(worlds[i], areas[i], options), given);
    }
}

TEST_CASE("Tighter spheres are smaller") {
    const World world = triangle_soup(80, 922);
    const auto radii = [&](SphereFit fit) {
        mir::SurfelTreeOptions options;
        options.sphere = fit;
        const SurfelTree tree = tree_of(world, 5e-3f, options);
        return check_whole(world, tree, surfels_of(world, 5e-3f)).radii;
    };
    const double smallest = radii(SphereFit::smallest);
    CHECK(radii(SphereFit::ritter) < 1.1 * smallest);
    CHECK(smallest * 1.001 < radii(SphereFit::ritter));
    CHECK(radii(SphereFit::ritter) < radii(SphereFit::mean));
}

TEST_CASE("The smallest sphere is that of the closed form, whatever else lies inside") {
    std::vector<Vec3> points;
    SECTION("two points") { points = {{-1, 0, 0}, {1, 0, 0}}; }
    SECTION("an equilateral triangle") {
        points = {{1, 0, 0}, {-0.5f, 0.8660254f, 0}, {-0.5f, -0.8660254f, 0}};
    }
    SECTION("a tetrahedron") {
        const float a = 0.57735027f;
        points = {{a, a, a}, {a, -a, -a}, {-a, a, -a}, {-a, -a, a}};
    }
    SECTION("an obtuse triangle, whose longest side decides") {
        points = {{-1, 0, 0}, {1, 0, 0}, {0.5f, 0.1f, 0}};
    }
    mir::Random random = test_random(923);
    for (int i = 0; i < 200; ++i) points.push_back(0.3f * point_in_cube(random));
    const SurfelNode root = tree_over(specks(points), SphereFit::smallest).nodes()[0];
    CHECK(root.radius == Approx(1.0).epsilon(1.1e-3));
    CHECK(glm::length(root.centre) < 0.05f);
}

TEST_CASE("The smallest sphere around two discs touches both") {
    std::vector<Surfel> discs = specks(std::vector<Vec3>{{0, 0, 0}, {4, 0, 0}});
    discs[0].radius = 1.0f;
    discs[1].radius = 3.0f;
    const SurfelNode root = tree_over(discs, SphereFit::smallest).nodes()[0];
    CHECK(root.radius == Approx(4.0).epsilon(1.1e-3));
    CHECK(glm::distance(root.centre, Vec3(3, 0, 0)) < 0.2f);
}

TEST_CASE("A disc tree has the same bytes for any number of threads and any order of work") {
    const World world = triangle_soup(400, 924);
    mir::SurfelTreeOptions options;
    options.sphere = GENERATE(SphereFit::ritter, SphereFit::smallest);
    const SurfelTree one = tree_of(world, 5e-4f, options);
    REQUIRE(one.surfels().size() > 4 * 4096);
    for (std::size_t threads : {2u, 3u}) {
        BackwardsExecutor executor{threads};
        const SurfelTree other(surfels_of(world, 5e-4f), base_color(world), options, executor);
        CHECK(equal_bytes(one.nodes(), other.nodes()));
        CHECK(equal_bytes(one.albedo(), other.albedo()));
        CHECK(equal_bytes(one.surfels(), other.surfels()));
    }
}

TEST_CASE("Where normals cancel a node's cone is the whole sphere, and colours mix by area") {
    const World world = thin_wall();
    const SurfelTree tree = tree_of(world, 0.01f);
    CHECK(tree.nodes()[0].cos_angle == Approx(-1.0));
    CHECK(double(tree.albedo()[0].r) == Approx(0.5));
    CHECK(double(tree.albedo()[0].b) == Approx(0.45));
    CHECK(double(tree.area()[0]) == Approx(2.0));
}

TEST_CASE("The orientation heuristic parts the sides of a wall that halves mix") {
    const World world = thin_wall();
    const auto mixed = [&](SurfelSplit split) {
        mir::SurfelTreeOptions options;
        options.split = split;
        std::uint32_t nodes = 0;
        const SurfelTree tree = tree_of(world, 1e-3f, options);
        for (const SurfelNode& n : tree.nodes()) nodes += n.cos_angle < 0.0f ? 1 : 0;
        return nodes;
    };
    CHECK(mixed(SurfelSplit::orientation) == 1);
    CHECK(mixed(SurfelSplit::median) > 100);
}

TEST_CASE("A disc tree never becomes deeper than it may") {
    // Discs that become smaller towards a point: every cut by areas parts off a few.
    std::vector<Vec3> points;
    for (int i = 0; i < 2000; ++i) points.push_back(std::ldexp(1.0f, -i / 20) * Vec3(1, 1, 1));
    mir::SurfelTreeOptions options;
    options.median_below = 2;
    options.max_depth = GENERATE(1u, 12u, 13u, 20u, 48u);
    mir::InlineExecutor executor;
    const SurfelTree tree(specks(points), all_grey, options, executor);
    const mir::Rgb grey{0.5f, 0.5f, 0.5f};
    TreeCount count;
    walk(tree, {&grey, 1}, 0, 1, count);
    CHECK(count.depth <= std::max(options.max_depth, 12u));
    CHECK((options.max_depth < 48 || count.depth > 20));
    CHECK(mir::detail::balanced_depth_of(2000) == 12);
    CHECK(mir::detail::balanced_depth_of(mir::detail::most_surfels) <=
          mir::SurfelTreeOptions::depth_limit);
}

TEST_CASE("A scene without triangles has no node, one disc makes one") {
    const World empty{mir::Scene{}};
    CHECK(tree_of(empty, 1.0f).view().empty());
    const World world = coincident(1);
    const SurfelTree tree = tree_of(world, 100.0f);
    REQUIRE(tree.view().node_count == 1);
    CHECK(tree.nodes()[0].is_leaf());
    CHECK(tree.nodes()[0].count == 1);
    CHECK(tree.nodes()[0].cos_angle == 1.0f);
}

TEST_CASE("Options of the disc tree out of range are refused") {
    const World world = triangle_soup(4, 925);
    mir::SurfelTreeOptions options;
    SECTION("one bin") { options.bins = 1; }
    SECTION("many bins") { options.bins = 65; }
    SECTION("no depth") { options.max_depth = 0; }
    SECTION("depth") { options.max_depth = 49; }
    CHECK_THROWS_AS(tree_of(world, 1.0f, options), mir::Error);
}

TEST_CASE("Two walls that meet are parted by their normals, near the edge too") {
    mir::Scene scene;
    const std::uint32_t grey = scene.add(mir::lambertian("grey", {0.5f, 0.5f, 0.5f}));
    scene.place(mir::builtin::quad("floor", grey, {0, 0, 0}, {0.8f, 0.6f, 0}, {0.3f, 0, -1}));
    scene.place(mir::builtin::quad("wall", grey, {0, 0, 0}, {0.3f, 0, -1}, {-0.6f, 0.8f, 0}));
    const SurfelTree tree = tree_of(World(std::move(scene)), 1e-3f);
    const auto mixed = std::count_if(tree.nodes().begin(), tree.nodes().end(),
                                     [](const SurfelNode& n) { return n.cos_angle < 0.99f; });
    CHECK(tree.surfels().size() > 4000);
    CHECK(mixed < 8);
}
