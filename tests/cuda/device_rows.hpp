// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "support/brute_force_view.hpp"

namespace mirtest {

/// Triangles that visibility on the GPU asks one by one: a copy of the host's.
class DeviceRows {
 public:
    DeviceRows(const mir::cuda::Backend& backend, BruteForceView<mir::Space::host> sight)
        : rows_(uploaded(backend, sight)) {}

    /// Valid as long as this.
    [[nodiscard]] BruteForceView<mir::Space::device> visibility() const {
        return {rows_.data(), static_cast<std::uint32_t>(rows_.size())};
    }

 private:
    using Rows = mir::UploadedArray<mir::cuda::Backend, mir::TriangleRows>;

    static Rows uploaded(const mir::cuda::Backend& backend,
                         BruteForceView<mir::Space::host> sight) {
        auto queue = backend.queue();
        Rows rows(backend, queue, {sight.rows, sight.count});
        queue.record().sync();
        return rows;
    }

    Rows rows_;
};

}  // namespace mirtest
