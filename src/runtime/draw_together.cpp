// SPDX-License-Identifier: MIT
#include "runtime/draw_together.hpp"

#include "mir/core/byte_hash.hpp"

#include <algorithm>
#include <cstddef>

namespace mir {
namespace {

/// Batches of each process, so that the last ones to end end nearly together.
constexpr std::size_t batches_each = 8;
/// Paths of a batch at least: a message must be worth its time.
constexpr std::size_t least_batch = 256;
/// Batches that a process may have at a time: it draws one while others wait for their turns.
constexpr std::size_t most_batches = 4;

/// Batches of paths as bands, whose rows are what was drawn.
class DrawLoop final : public SharedLoop {
 public:
    DrawLoop(const PathsToDraw& paths, const PathDraw& draw, std::uint32_t processes)
        : paths_(paths),
          batch_(std::max(paths.weights.size() / (batches_each * processes), least_batch)),
          crew_(most_batches, seam_, [this, &draw](std::uint32_t batch, BandTurn& turn) {
              const PathsToDraw own = part(batch);
              draw(own.first, own.weights, own.places);
              turn.wait();
              drawn_ = own;
          }) {}

    [[nodiscard]] std::uint32_t bands() const override {
        return static_cast<std::uint32_t>((paths_.weights.size() + batch_ - 1) / batch_);
    }
    [[nodiscard]] std::uint64_t fingerprint() const override {
        ByteHash hash;
        for (const std::uint64_t number : {paths_.first, std::uint64_t{paths_.weights.size()}})
            hash.add(&number, sizeof number);
        return hash.value();
    }
    [[nodiscard]] bool is_kept() const override { return false; }
    [[nodiscard]] BandCrew& crew() override { return crew_; }
    void load(std::span<const std::byte> /*sums*/) override {}
    [[nodiscard]] Peers::Bytes save() override { return {}; }
    [[nodiscard]] Peers::Bytes rows() override { return packed(drawn_); }
    void keep(std::span<const std::byte> rows) override { take(rows); }

    /// Paths with their first number.
    [[nodiscard]] static Peers::Bytes packed(const PathsToDraw& paths) {
        return PackedBytes()
            .add(paths.first)
            .add_all(std::span<const double>(paths.weights))
            .add_all(std::span<const std::uint32_t>(paths.places))
            .take();
    }
    /// Puts packed() paths where they belong.
    void take(std::span<const std::byte> bytes) const {
        BytesReader in(bytes);
        const auto begin = static_cast<std::size_t>(in.get<std::uint64_t>() - paths_.first);
        const auto weights = in.get_all<double>();
        const auto places = in.get_all<std::uint32_t>();
        if (begin > paths_.weights.size() || weights.size() > paths_.weights.size() - begin ||
            weights.size() != places.size())
            throw Error(ErrorCode::internal,
                        "another process drew paths that nobody wants (it may be another version); "
                        "start the same program everywhere");
        std::ranges::copy(weights, paths_.weights.subspan(begin).begin());
        std::ranges::copy(places, paths_.places.subspan(begin).begin());
    }

 private:
    [[nodiscard]] PathsToDraw part(std::uint32_t batch) const {
        const std::size_t begin = batch * batch_;
        const std::size_t count = std::min(batch_, paths_.weights.size() - begin);
        return {paths_.first + begin, paths_.weights.subspan(begin, count),
                paths_.places.subspan(begin, count)};
    }

    PathsToDraw paths_;
    std::size_t batch_;
    PathsToDraw drawn_;  ///< the batch whose turn it was
    FilmSeam seam_;      ///< none
    BandCrew crew_;
};

}  // namespace

void draw_together(PictureShare& share, Monitor* monitor, const PathsToDraw& paths,
                   const PathDraw& draw) {
    DrawLoop loop(paths, draw, share.peers().count());
    share.run(loop, monitor);
    const Peers::Bytes all =
        share.spread(share.is_lead() ? DrawLoop::packed(paths) : Peers::Bytes());
    if (!share.is_lead()) loop.take(all);
}

}  // namespace mir
