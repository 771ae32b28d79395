// SPDX-License-Identifier: MIT
#pragma once

#include "timeline.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace mirpaper {

/// How rays and shading are cut into kernels.
enum class KernelVariant {
    fused,    ///< RC: a thread per luxel, a loop over VPLs, rays and shading together
    split,    ///< RCVP: rays to bits first, then a thread per luxel that shades by the bits
    per_vpl,  ///< a launch per VPL, a thread per luxel: neighbours of a thread never leave its VPL
    shafts    ///< bits by shafts first, then shading by the bits
};

/// Order of the luxels in memory, 32 of which make a warp.
enum class LuxelOrder {
    squares,  ///< the library's: 8 x 4 inside blocks of 16 x 16
    rows,     ///< as the image is scanned
    clusters  ///< compact runs of 32 and of 256: mir::cluster_order()
};

/// Order of the VPLs.
enum class VplOrder {
    morton,   ///< neighbours in space are neighbours in the list
    shuffled  ///< none at all
};

/// What traces rays, those that shafts leave over among them.
enum class RayEngine { kd_tree, wide_bvh };

/// The end at which a shadow ray starts.
enum class RayStart { vpl, luxel };

inline constexpr std::array variant_names{"fused", "split", "per-vpl", "shafts"};
inline constexpr std::array luxel_order_names{"squares", "rows", "clusters"};
inline constexpr std::array vpl_order_names{"morton", "shuffled"};
inline constexpr std::array ray_engine_names{"kd-tree", "wide BVH"};
inline constexpr std::array ray_start_names{"vpl", "luxel"};

struct KernelChoice {
    KernelVariant variant = KernelVariant::fused;
    LuxelOrder luxels = LuxelOrder::squares;
    VplOrder vpl_order = VplOrder::morton;
    RayStart start = RayStart::vpl;
    RayEngine engine = RayEngine::kd_tree;
    std::uint32_t vpls = 256;
};

/// Kernels of one image, by events.
struct KernelRun {
    double visibility = 0.0;  ///< seconds; of KernelVariant::split only
    double shading = 0.0;     ///< seconds; of KernelVariant::split only
    double seconds = 0.0;     ///< all kernels
    double mean_luminance = 0.0;
    std::optional<StageSeconds> stages;  ///< of KernelVariant::shafts
};

}  // namespace mirpaper
