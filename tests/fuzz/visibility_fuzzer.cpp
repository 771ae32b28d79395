// SPDX-License-Identifier: MIT
#include "accel/against_brute_force.hpp"
#include "fuzz/input_file.hpp"
#include "fuzz/small_world.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/accel/kd/kd_traverse.hpp"
#include "mir/accel/wide/wide_traverse.hpp"
#include "mir/host/wide_build.hpp"

namespace {

using mirfuzz::ByteReader;

template <class View>
void check_segment(const View& view, const std::vector<mir::TriangleRows>& rows, mir::Vec3 from,
                   mir::Vec3 to) {
    const bool truth = mirtest::hidden_by_any(rows, view.reach, from, to);
    mirfuzz::require(is_hidden(view, from, to) == truth);
    mirfuzz::require(is_hidden(view, to, from) == truth);
    const mir::Vec3 way = to - from;
    const float length = glm::length(way);
    if (!(length > 0.0f) || !std::isfinite(length)) return;
    const mir::Ray ray{from, way / length};
    mirfuzz::require(
        mirtest::same_bits(first_hit(view, ray), mirtest::first_of_all(rows, view.reach, ray)));
}

}  // namespace

/// A few triangles, and segments among them: the kd-tree, with costs of any proportion, and the
/// wide hierarchy, with leaves of any size and any share of split triangles, must answer with the
/// bits of asking every triangle.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ByteReader bytes(data, size);
    mirfuzz::Coordinates coordinates(bytes);
    mir::KdTreeOptions kd_options;
    kd_options.traversal_cost = 0.01f * static_cast<float>(1 + bytes.next<std::uint8_t>());
    mir::WideBvhOptions wide_options;
    const std::uint32_t choice = bytes.next<std::uint8_t>();
    wide_options.leaf_size = 1 + choice % 8;
    wide_options.splits = static_cast<float>(choice / 8) / 31.0f;
    const mir::WorldGeometry geometry(mirfuzz::small_scene(bytes, coordinates));
    mir::InlineExecutor executor;
    const mir::KdTree kd(geometry, kd_options, executor);
    const mir::WideBvh wide = mir::build_wide_bvh(geometry, executor, wide_options);
    const std::vector<mir::TriangleRows> rows = mirtest::all_rows(geometry);
    for (int i = 0; i < 64 && !bytes.empty(); ++i) {
        const mir::Vec3 from = mirfuzz::some_place(bytes, coordinates, geometry);
        const mir::Vec3 to = mirfuzz::some_place(bytes, coordinates, geometry);
        check_segment(kd.view(), rows, from, to);
        check_segment(wide.view(), rows, from, to);
    }
    return 0;
}
