// SPDX-License-Identifier: MIT
#pragma once

#include "conformance/brute_force.hpp"
#include "mir/accel/exact/triangle_rows.hpp"
#include "mir/concepts/visibility.hpp"

#include <span>
#include <vector>

namespace mirtest {

/// Visibility by asking every triangle: the same bits on host and device, for scenes of a few dozen
/// triangles. A view of rows that somebody else keeps.
template <mir::Space S>
struct BruteForceView {
    static constexpr mir::Space space = S;

    const mir::TriangleRows* rows = nullptr;
    std::uint32_t count = 0;

    [[nodiscard]] MIR_HD bool visible(mir::Vec3 a, mir::Vec3 b) const {
        for (std::uint32_t i = 0; i < count; ++i)
            if (mir::hits_segment(rows[i], a, b)) return false;
        return true;
    }
};

/// The engine of a Stage whose visibility a device can have too: rows() are what it needs. The
/// geometry must outlive it.
class BruteForceRows {
 public:
    explicit BruteForceRows(const mir::WorldGeometry& geometry) : caster_{&geometry} {
        for (std::uint32_t i = 0; i < geometry.triangles().size(); ++i)
            rows_.push_back(mir::make_triangle_rows(geometry.corner(i, 0), geometry.corner(i, 1),
                                                    geometry.corner(i, 2)));
    }

    [[nodiscard]] std::span<const mir::TriangleRows> rows() const { return rows_; }
    [[nodiscard]] BruteForceView<mir::Space::host> visibility() const {
        return {rows_.data(), static_cast<std::uint32_t>(rows_.size())};
    }
    [[nodiscard]] BruteForceRayCaster ray_caster() const { return caster_; }

 private:
    std::vector<mir::TriangleRows> rows_;
    BruteForceRayCaster caster_;
};

static_assert(mir::Visibility<BruteForceView<mir::Space::device>>);

}  // namespace mirtest
