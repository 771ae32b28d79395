// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <atomic>
#include <cstdint>

namespace mir {

/// Looks into a running render from another thread, and stops it. All members may be used from any
/// thread at any time.
struct Monitor {
    std::atomic<std::uint64_t> contributions{0};          ///< luxel-VPL pairs done
    std::atomic<std::uint64_t> planned_contributions{0};  ///< 0 until known
    std::atomic<std::uint64_t> looping_contributions{0};  ///< of the present loop that are done
    std::atomic<std::uint64_t> gathers{0};                ///< of render_discs(): luxels done
    std::atomic<std::uint64_t> planned_gathers{0};        ///< times bounces; 0 until known
    std::atomic<std::uint32_t> bands{0};                  ///< of the image: begun
    std::atomic<std::uint32_t> planned_bands{0};          ///< 0 until known
    std::atomic<std::uint64_t> blocks{0};                 ///< of the present loop on the host: done
    std::atomic<std::uint64_t> planned_blocks{0};         ///< 0 before the first loop
    std::atomic<const char*> stage{nullptr};              ///< RenderStage::title; null before any
    std::atomic<std::uint32_t> passes{0};                 ///< of a ProgressiveRender: done
    std::atomic<bool> cancelled{false};                   ///< set to stop at the next block

    /// Nothing done and nothing known of the pass that begins, `passes` being behind it.
    void begin_pass(std::uint32_t done) {
        passes = done;
        contributions = planned_contributions = looping_contributions = 0;
        gathers = planned_gathers = 0;
        bands = planned_bands = 0;
    }

    /// A loop of `n` blocks begins on the host.
    void begin_loop(std::uint64_t n) {
        blocks = 0;
        planned_blocks = n;
    }

    /// @throws Error(cancelled) when the caller asked to stop.
    void check() const {
        if (cancelled.load(std::memory_order_relaxed))
            throw Error(ErrorCode::cancelled, "the render was cancelled; nothing was written");
    }
};

}  // namespace mir
