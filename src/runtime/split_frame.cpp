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
    Turn(SplitFrame& frame, BandDealer& dealer, std::size_t part)
        : frame_(frame), dealer_(dealer), part_(part) {}

    /// The next band of the part; none at the end.
    [[nodiscard]] std::optional<std::uint32_t> next() {
        const std::optional<std::uint32_t> band = dealer_.next(part_);
        if (band) band_ = *band;
        has_passed_ = false;
        return band;
    }
    void wait() override { dealer_.wait_for(band_); }
    [[nodiscard]] FilmSeam* seam() override { return &frame_.seam_; }
    void pass() override {
        if (std::exchange(has_passed_, true)) return;
        const std::uint32_t end = frame_.seam_.first_row;
        const std::uint32_t begin = frame_.developed_.empty() ? 0 : frame_.developed_.back().end;
        if (end > begin) frame_.developed_.push_back({part_, begin, end});
        dealer_.finish(band_);
    }

 private:
    SplitFrame& frame_;
    BandDealer& dealer_;
    std::size_t part_;
    std::uint32_t band_ = 0;
    bool has_passed_ = false;
};

SplitFrame::SplitFrame(RenderJob& job, std::vector<std::unique_ptr<RenderFrame>> parts)
    : RenderFrame(job, traits_of(parts)), parts_(std::move(parts)) {}

void SplitFrame::for_each_band(std::uint32_t bands, const BandWork& work) {
    if (owners_.size() != bands) owners_.clear();
    BandDealer dealer(bands, parts_.size(), owners_);
    on_side_threads(parts_.size(), [&](std::size_t part) {
        Turn turn(*this, dealer, part);
        while (const std::optional<std::uint32_t> band = turn.next()) {
            try {
                work(*parts_[part], *band, turn);
                turn.wait();
                turn.pass();
            } catch (const BandDealer::Stopped&) {
                return;
            } catch (...) {
                dealer.fail(*band, std::current_exception());
            }
        }
    });
    dealer.rethrow();
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
    // Parts may share the images of the job. The first of them gives those away, the others none.
    std::vector<std::vector<Image<Rgb>>> given(parts_.size());
    std::size_t of_job = 0;
    for (const Rows& rows : developed_) {
        if (!given[rows.part].empty()) continue;
        const bool job_has_some = !job().layers.empty();
        given[rows.part] = parts_[rows.part]->develop();
        if (job_has_some && job().layers.empty()) of_job = rows.part;
    }
    const auto images_of = [&](std::size_t part) -> std::vector<Image<Rgb>>& {
        return given[given[part].empty() ? of_job : part];
    };
    std::vector<Image<Rgb>>& whole = images_of(developed_.front().part);
    for (const Rows& rows : developed_) {
        const std::vector<Image<Rgb>>& images = images_of(rows.part);
        if (&images == &whole) continue;
        job().executor.for_each(whole.size(), [&](std::size_t layer) {
            const std::span<const Rgb> from = images[layer].pixels();
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
