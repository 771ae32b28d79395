// SPDX-License-Identifier: MIT
#pragma once

#include "mir/film/film_seam.hpp"

#include <cstdint>
#include <functional>

namespace mir {

class RenderFrame;

/// The place of a band in a loop that works from top to bottom. As it is, of loops that take bands
/// one by one.
class BandTurn {
 public:
    BandTurn() = default;
    BandTurn(const BandTurn&) = delete;
    BandTurn& operator=(const BandTurn&) = delete;
    virtual ~BandTurn() = default;

    /// Returns once the work on all bands above is done, or their turns were passed on.
    /// @throws What ends the loop when work on another band failed.
    virtual void wait() {}
    /// Where another frame's film ended, for RenderFrame::put(). Null where one frame puts all
    /// bands. To be used after wait() and before pass().
    [[nodiscard]] virtual FilmSeam* seam() { return nullptr; }
    /// Lets the turn of the band below begin: it waits for nothing that is still to be done.
    virtual void pass() {}
};

/// Work on a band of an image. Its frame works on no other band meanwhile.
using BandWork = std::function<void(RenderFrame& by, std::uint32_t band, BandTurn& turn)>;

}  // namespace mir
