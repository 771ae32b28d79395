// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/construction.hpp"
#include "mir/accel/kd/detail/kd_bins.hpp"

#include <vector>

namespace mir::detail {

/// Triangles as construction needs them.
struct KdPrepared {
    RawArray<ClipTriangle> triangles;
    RawArray<KdFragment> fragments;
    KdCell cell;  ///< around all of them
};

/// Fills `rows` and makes a fragment of each triangle.
template <Executor E>
KdPrepared prepare(const WorldGeometry& geometry, RawArray<TriangleRows>& rows, E& executor) {
    constexpr std::size_t part = 4096;
    const std::size_t n = geometry.triangles().size();
    const float magnitude = magnitude_of(geometry.bounds());
    KdPrepared prepared;
    prepared.triangles.resize(n);
    prepared.fragments.replace(n);
    rows.resize(n);
    std::vector<KdContent> contents((n + part - 1) / part);
    for_each_part(n, part, executor, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const auto index = static_cast<std::uint32_t>(i);
            const Vec3 a = geometry.corner(index, 0);
            const Vec3 b = geometry.corner(index, 1);
            const Vec3 c = geometry.corner(index, 2);
            const KdItem item = make_item(a, b, c, index, magnitude);
            prepared.triangles[i] = item.triangle;
            prepared.fragments[i] = item.fragment;
            rows[i] = make_triangle_rows(a, b, c);
        }
        contents[first / part].add(prepared.fragments.span().subspan(first, last - first));
    });
    KdContent all;
    for (const KdContent& content : contents) all.add(content);
    if (n > 0) prepared.cell = {axes_only(all.low), axes_only(all.high)};
    return prepared;
}

}  // namespace mir::detail
