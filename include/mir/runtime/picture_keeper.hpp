// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace mir {

/// Where the lead of a PictureTeam keeps a picture under way, band by band. A team that is started
/// again goes on from there, in machines of the same kind. To be derived from.
class PictureKeeper {
 public:
    PictureKeeper() = default;
    PictureKeeper(const PictureKeeper&) = delete;
    PictureKeeper& operator=(const PictureKeeper&) = delete;
    virtual ~PictureKeeper() = default;

    /// What was kept last, byte by byte; nothing where nothing was.
    [[nodiscard]] virtual std::vector<std::byte> read() = 0;
    /// Whether the bands done are to be kept now. Asked behind each band.
    [[nodiscard]] virtual bool is_time() = 0;
    /// Replaces what was kept before.
    virtual void write(const std::vector<std::byte>& picture) = 0;
};

}  // namespace mir
