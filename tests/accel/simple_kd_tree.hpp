// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/accept_box.hpp"
#include "mir/accel/kd/kd_tree.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mirtest {

/// Which boxes a tree is built over: `exact` ones are the mistake that tests have to notice.
enum class Boxes { accept, exact };

/// A kd-tree in plain lines, as second opinion. Planes lie one unit in the last place outside of
/// triangles, the middle one along the longest edge of a cell: where hits are lost first. Every
/// triangle whose box touches a child goes there.
class SimpleKdTree {
 public:
    explicit SimpleKdTree(const mir::WorldGeometry& geometry, std::uint32_t leaf_size = 4,
                          std::uint32_t depth = 11, Boxes kind = Boxes::accept) {
        const float magnitude = mir::magnitude_of(geometry.bounds());
        mir::Bounds all;
        for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t) {
            const mir::Vec3 a = geometry.corner(t, 0);
            const mir::Vec3 b = geometry.corner(t, 1);
            const mir::Vec3 c = geometry.corner(t, 2);
            triangles_.push_back(mir::make_triangle_rows(a, b, c));
            mir::Bounds exact;
            for (mir::Vec3 p : {a, b, c}) exact.add(p);
            exact_boxes_.push_back(exact);
            boxes_.push_back(kind == Boxes::exact ? exact : mir::accept_box(a, b, c, magnitude));
            all.add(boxes_.back().low);
            all.add(boxes_.back().high);
        }
        view_.reach = mir::reach_of(magnitude);
        if (!all.empty()) view_.low = all.low, view_.high = all.high;
        std::vector<std::uint32_t> references(triangles_.size());
        std::iota(references.begin(), references.end(), 0u);
        constexpr std::uint32_t root = mir::KdTreeView<mir::Space::host>::root;
        nodes_.resize(root + 1);
        split(root, all, std::move(references), leaf_size, depth);
    }

    [[nodiscard]] mir::KdTreeView<mir::Space::host> view() const {
        auto view = view_;
        view.nodes = nodes_.data();
        view.references = references_.data();
        view.triangles = triangles_.data();
        return view;
    }
    [[nodiscard]] const std::vector<mir::KdNode>& nodes() const { return nodes_; }
    [[nodiscard]] const std::vector<std::uint32_t>& references() const { return references_; }
    [[nodiscard]] const std::vector<mir::TriangleRows>& triangles() const { return triangles_; }

 private:
    /// Middle one of the faces of exact boxes, inside the cell.
    [[nodiscard]] float middle_face(mir::Bounds cell, const std::vector<std::uint32_t>& inside,
                                    int axis) const {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        std::vector<float> faces;
        for (std::uint32_t t : inside)
            for (float x : {std::nextafter(exact_boxes_[t].low[axis], -infinity),
                            std::nextafter(exact_boxes_[t].high[axis], infinity)})
                if (x > cell.low[axis] && x < cell.high[axis]) faces.push_back(x);
        if (faces.empty()) return cell.centre()[axis];
        const auto middle = faces.begin() + static_cast<std::ptrdiff_t>(faces.size() / 2);
        std::nth_element(faces.begin(), middle, faces.end());
        return *middle;
    }

    void split(std::uint32_t node, mir::Bounds cell, std::vector<std::uint32_t> inside,
               std::uint32_t leaf_size, std::uint32_t depth) {
        if (inside.size() <= leaf_size || depth == 0) {
            nodes_[node] = mir::KdNode::leaf(static_cast<std::uint32_t>(references_.size()),
                                             static_cast<std::uint32_t>(inside.size()));
            references_.insert(references_.end(), inside.begin(), inside.end());
            return;
        }
        const mir::Vec3 edges = cell.high - cell.low;
        const int axis = edges.x >= edges.y && edges.x >= edges.z ? 0 : edges.y >= edges.z ? 1 : 2;
        const float plane = middle_face(cell, inside, axis);
        std::vector<std::uint32_t> below;
        std::vector<std::uint32_t> above;
        for (std::uint32_t t : inside) {
            if (boxes_[t].low[axis] <= plane) below.push_back(t);
            if (boxes_[t].high[axis] >= plane) above.push_back(t);
        }
        const auto child = static_cast<std::uint32_t>(nodes_.size());
        nodes_[node] = mir::KdNode::inner(static_cast<std::uint32_t>(axis), plane, child);
        nodes_.resize(nodes_.size() + 2);
        mir::Bounds low_half = cell;
        mir::Bounds high_half = cell;
        low_half.high[axis] = plane;
        high_half.low[axis] = plane;
        split(child, low_half, std::move(below), leaf_size, depth - 1);
        split(child + 1, high_half, std::move(above), leaf_size, depth - 1);
    }

    std::vector<mir::TriangleRows> triangles_;
    std::vector<mir::Bounds> boxes_;
    std::vector<mir::Bounds> exact_boxes_;
    std::vector<mir::KdNode> nodes_;
    std::vector<std::uint32_t> references_;
    mir::KdTreeView<mir::Space::host> view_;
};

}  // namespace mirtest
