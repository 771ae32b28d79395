// SPDX-License-Identifier: MIT
#include "runtime/split_frame.hpp"

#include "runtime/band_dealer.hpp"
#include "runtime/side_threads.hpp"

#include <algorithm>
#include <utility>

namespace mir {
namespace {

FrameTraits traits_of(const std::vector<std::unique_ptr<RenderFrame>>& parts) {
    expects(!parts.empty(),
            "a picture was split among no frames (nobody would make it); give at least one");
    FrameTraits traits = parts.front()->traits();
    for (const auto& part : parts)
        traits.luxel_bytes = std::max(traits.luxel_bytes, part->traits().luxel_bytes);
    traits.parts = static_cast<std::uint32_t>(parts.size());
    return traits;
}

}  // namespace

/// Of one band after the other, of one part.
class SplitFrame::Turn final : public BandTurn {
 public:
    Turn(BandDealer& dealer, FilmSeam& seam) : dealer_(dealer), seam_(seam) {}

    /// The next band of the part; none at the end.
    [[nodiscard]] std::optional<std::uint32_t> next(std::size_t part) {
        const std::optional<std::uint32_t> band = dealer_.next(part);
        if (band) band_ = *band;
        return band;
    }
    void wait() override { dealer_.wait_for(band_); }
    [[nodiscard]] FilmSeam* seam() override { return &seam_; }

 private:
    BandDealer& dealer_;
    FilmSeam& seam_;
    std::uint32_t band_ = 0;
};

SplitFrame::SplitFrame(RenderJob& job, std::vector<std::unique_ptr<RenderFrame>> parts)
    : RenderFrame(job, traits_of(parts)), parts_(std::move(parts)) {}

void SplitFrame::for_each_band(std::uint32_t bands, const BandWork& work) {
    if (owners_.size() != bands) owners_.clear();
    BandDealer dealer(bands, parts_.size(), owners_);
    on_side_threads(parts_.size(), [&](std::size_t part) {
        Turn turn(dealer, seam_);
        while (const std::optional<std::uint32_t> band = turn.next(part)) {
            try {
                work_on(part, *band, work, turn);
                dealer.finish(*band);
            } catch (const BandDealer::Stopped&) {
                return;
            } catch (...) {
                dealer.fail(*band, std::current_exception());
            }
        }
    });
    dealer.rethrow();
}

/// Waits for the turn of the band, if the work did not.
void SplitFrame::work_on(std::size_t part, std::uint32_t band, const BandWork& work, Turn& turn) {
    work(*parts_[part], band, turn);
    turn.wait();
    const std::uint32_t begin = developed_.empty() ? 0 : developed_.back().end;
    if (seam_.first_row > begin) developed_.push_back({part, begin, seam_.first_row});
}

void SplitFrame::keep_radii(std::vector<float>&& radii) {
    for (std::size_t k = 1; k < parts_.size(); ++k) parts_[k]->keep_radii(std::vector(radii));
    first().keep_radii(std::move(radii));
}

float SplitFrame::keep_lobes(const VplRecords& records) {
    for (std::size_t k = 1; k < parts_.size(); ++k)
        static_cast<void>(parts_[k]->keep_lobes(records));
    return first().keep_lobes(records);
}

std::vector<Image<Rgb>> SplitFrame::develop() {
    if (developed_.empty()) return first().develop();
    std::vector<std::vector<Image<Rgb>>> images(parts_.size());
    for (const Rows& rows : developed_)
        if (images[rows.part].empty()) images[rows.part] = parts_[rows.part]->develop();
    std::vector<Image<Rgb>>& whole = images[developed_.front().part];
    for (const Rows& rows : developed_) {
        if (rows.part == developed_.front().part) continue;
        job().executor.for_each(whole.size(), [&](std::size_t layer) {
            const std::span<const Rgb> from = images[rows.part][layer].pixels();
            const std::size_t width = whole[layer].width();
            std::copy(from.begin() + rows.begin * width, from.begin() + rows.end * width,
                      whole[layer].pixels().begin() + rows.begin * width);
        });
    }
    developed_.clear();
    seam_ = {};
    return std::move(whole);
}

void SplitFrame::develop_rows(std::uint32_t first, std::uint32_t end,
                              std::vector<Image<Rgb>>& images) {
    for (const Rows& rows : developed_) {
        const std::uint32_t begin = std::max(first, rows.begin);
        if (begin < std::min(end, rows.end))
            parts_[rows.part]->develop_rows(begin, std::min(end, rows.end), images);
    }
}

}  // namespace mir
