// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/runtime/peers.hpp"
#include "mir/runtime/picture_keeper.hpp"
#include "runtime/band_crew.hpp"
#include "runtime/packed_bytes.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace mir {

/// What processes of a team tell each other. A message begins with it.
enum class TeamWord : std::uint8_t {
    begin,     ///< lead: a picture
    band,      ///< lead: its number
    turn,      ///< lead: of a band, and the sums of all above
    loop_end,  ///< lead: the sums of all bands
    stop,      ///< lead: an error; nothing more is to be done
    leave,     ///< lead: there are no more pictures
    want,      ///< a band, in a loop over so many
    ready,     ///< a band waits for its turn
    done,      ///< a band, and the sums with it
    pixels,    ///< what a process developed of a picture
    failed,    ///< an error
    left,      ///< the last that a process says
    whole      ///< lead: what all need of a loop
};

/// What ends the work of a process in the middle of a picture, when the lead says so.
struct TeamStopped {
    Error error;  ///< of whoever failed
};

/// A loop over the bands of an image, in which processes add up something band by band.
class SharedLoop {
 public:
    SharedLoop() = default;
    SharedLoop(const SharedLoop&) = delete;
    SharedLoop& operator=(const SharedLoop&) = delete;
    virtual ~SharedLoop() = default;

    /// Bands that it goes over, the same everywhere.
    [[nodiscard]] virtual std::uint32_t bands() const = 0;
    /// Of all that must be the same everywhere.
    [[nodiscard]] virtual std::uint64_t fingerprint() const = 0;
    /// Whether a team that is started again goes on behind bands of it.
    [[nodiscard]] virtual bool is_kept() const { return true; }
    /// The threads that work on its bands.
    [[nodiscard]] virtual BandCrew& crew() = 0;
    /// Replaces the sums by those of the bands above.
    virtual void load(std::span<const std::byte> sums) = 0;
    /// The sums, behind a band whose turn it was.
    [[nodiscard]] virtual Peers::Bytes save() = 0;
    /// What else that band leaves to the lead, who keeps it in the order of the bands.
    [[nodiscard]] virtual Peers::Bytes rows() = 0;
    /// Keeps what a band left; at the lead.
    virtual void keep(std::span<const std::byte> rows) = 0;
};

/// Bands of a picture that are done, as a lead keeps them.
struct KeptBands {
    std::vector<Peers::Bytes> loops;  ///< sums of the loops before
    std::uint64_t fingerprint = 0;    ///< of the present loop
    Peers::Bytes sums;                ///< of its bands that are done
    std::vector<Peers::Bytes> rows;   ///< what each of those left

    std::uint32_t cut_for = 0;  ///< processes; their number tells how high bands are

    /// As bytes, behind the number of a picture.
    [[nodiscard]] Peers::Bytes packed(std::uint64_t id) const;
    /// Those of picture `id`; none where the bytes are another's.
    [[nodiscard]] static KeptBands of(std::uint64_t id, const Peers::Bytes& bytes);
};

/// Part of one process in the pictures of a team. One thread at a time.
class PictureShare {
 public:
    /// `peers` must outlive it.
    explicit PictureShare(Peers& peers) : peers_(peers) {}

    /// Those who make the picture.
    [[nodiscard]] Peers& peers() const { return peers_; }
    /// True for the process that gets the picture.
    [[nodiscard]] bool is_lead() const { return peers_.rank() == 0; }
    /// A picture begins, in bands for so many processes. `keeps`: bands leave their pixels to the
    /// lead at once.
    void begin_picture(bool keeps, std::uint32_t cut_for) {
        owners_.clear();
        keeps_ = keeps;
        cut_for_ = cut_for;
        loops_ = 0;
        kept_ = {};
    }
    /// At the lead: it is kept in `keeper`, and goes on from what is there of picture `id`, in the
    /// same bands.
    void go_on(PictureKeeper& keeper, std::uint64_t id);
    /// Processes that the picture is cut into bands for; not those that there are if it goes on
    /// from what others kept.
    [[nodiscard]] std::uint32_t cut_for() const { return cut_for_; }
    /// Whether bands leave their pixels to the lead at once.
    [[nodiscard]] bool keeps() const { return keeps_; }

    /// Works on bands of a loop as the lead deals them, and deals them at the lead. Returns when
    /// all bands are done everywhere. The sums are then those of all bands. `monitor` may be null.
    /// @throws What the work throws; Error(cancelled); Error of another process, at the lead;
    ///         TeamStopped, at the others.
    void run(SharedLoop& loop, Monitor* monitor);

    /// What the lead hands to all behind a loop; waits for it elsewhere.
    /// @throws As run(), for messages of errors.
    [[nodiscard]] Peers::Bytes spread(Peers::Bytes of_lead);

    /// The next message; waits for it.
    /// @throws As run(), for messages of errors.
    [[nodiscard]] Peers::Letter wait();
    /// The next message that has come, if any.
    /// @throws The same.
    [[nodiscard]] std::optional<Peers::Letter> receive();

 private:
    class Run;

    [[nodiscard]] std::uint32_t begin_loop(SharedLoop& loop, Peers::Bytes& sums);
    void keep_band(const Peers::Bytes& sums, std::span<const std::byte> rows);

    Peers& peers_;
    PictureKeeper* keeper_ = nullptr;  ///< of the lead; may be null
    std::uint64_t id_ = 0;             ///< of the picture in it
    KeptBands kept_;                   ///< in it
    bool keeps_ = false;
    std::uint32_t cut_for_ = 1;
    std::uint32_t loops_ = 0;            ///< of the picture that have begun
    std::uint32_t all_loops_ = 0;        ///< of all pictures
    std::vector<std::uint32_t> owners_;  ///< processes, by the bands of the last loop
};

/// Pauses that become longer while nothing happens: an idle process leaves its core to others.
class IdlePause {
 public:
    /// The next pause.
    [[nodiscard]] std::chrono::microseconds next() {
        return std::exchange(pause_, std::min(pause_ * 2, longest));
    }
    /// Something has happened.
    void reset() { pause_ = shortest; }

 private:
    static constexpr std::chrono::microseconds shortest{50};
    static constexpr std::chrono::microseconds longest{2000};
    std::chrono::microseconds pause_ = shortest;
};

}  // namespace mir
