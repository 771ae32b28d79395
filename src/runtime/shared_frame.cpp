// SPDX-License-Identifier: MIT
#include "runtime/shared_frame.hpp"

#include "mir/core/byte_hash.hpp"
#include "mir/normalise/response.hpp"
#include "mir/runtime/mean_luminances.hpp"
#include "runtime/draw_together.hpp"
#include "runtime/sample_vpls.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <utility>

namespace mir {
namespace {

/// Bands of each process, so that the last ones to end end nearly together.
constexpr std::uint32_t bands_each = 8;
/// Bands that a process on the host may have at a time. A slow process holds up those that are so
/// many times as fast.
constexpr std::size_t most_bands = 4;

/// A turn that brings the sum of the bands above.
class SumTurn final : public BandTurn {
 public:
    SumTurn(BandTurn& turn, const std::function<void()>& load) : turn_(turn), load_(load) {}
    void wait() override {
        turn_.wait();
        load_();
    }
    [[nodiscard]] FilmSeam* seam() override { return turn_.seam(); }

 private:
    BandTurn& turn_;
    const std::function<void()>& load_;
};

std::uint64_t fingerprint_of(const RenderFrame& frame, std::uint32_t bands) {
    const RenderResult& r = frame.job().result;
    const RenderStatistics& s = r.statistics;
    ByteHash hash;
    hash.add(r.vpls.vpls().data(), r.vpls.vpls().size_bytes());
    for (const double number :
         {s.path_luminance, s.states, double{s.bound}, s.vsl_radius, double{s.emitted_power},
          s.dropped_share, s.direct_noise.value_or(0.0),
          s.gather_difference ? s.gather_difference->mean : 0.0, frame.traits().on_host ? 1.0 : 0.0,
          // Of bands: how many they are, and what their height depends on (ImageBands).
          static_cast<double>(bands), static_cast<double>(frame.traits().parts)})
        hash.add(&number, sizeof number);
    hash.add(&frame.job().settings.limits.visibility_bytes, sizeof(std::uint64_t));
    return hash.value();
}

/// What a loop over bands is mostly: stages of several bands at a time are not told apart.
StageClock::Stage stage_of(const RenderSettings& settings, bool sums_responses) {
    if (sums_responses) return &StageSeconds::visibility;
    switch (settings.integrator) {
        case Integrator::path:
            return &StageSeconds::paths;
        case Integrator::micro:
            return &StageSeconds::gather;
        case Integrator::vpl:
            break;
    }
    return &StageSeconds::reconstruction;
}

FrameTraits shared_traits(const RenderFrame& local, const PictureShare& share) {
    FrameTraits traits = local.traits();
    expects(traits.parts == 1,
            "a process of several was given several GPUs (bands go to one of each process); start "
            "one process for each GPU");
    traits.parts = share.cut_for() * bands_each / 4;
    return traits;
}

/// The pixels of an image, and the rows whose pixels count.
struct Plane {
    template <class T>
    Plane(Image<T>& image, const std::vector<std::array<std::uint32_t, 2>>& rows_of_it)
        : pixels(std::as_writable_bytes(image.pixels())),
          row_bytes(image.width() * sizeof(T)),
          rows(rows_of_it) {}

    [[nodiscard]] std::span<std::byte> of(std::array<std::uint32_t, 2> range) const {
        return pixels.subspan(range[0] * row_bytes, (range[1] - range[0]) * row_bytes);
    }

    std::span<std::byte> pixels;
    std::size_t row_bytes;
    const std::vector<std::array<std::uint32_t, 2>>& rows;
};

/// Guides, then layers: those without layers have guides at the same places.
std::vector<Plane> planes_of(Guides& guides, std::vector<Image<Rgb>>& layers,
                             const std::vector<std::array<std::uint32_t, 2>>& guided,
                             const std::vector<std::array<std::uint32_t, 2>>& developed) {
    std::vector<Plane> planes{{guides.albedo, guided},
                              {guides.normal, guided},
                              {guides.position, guided},
                              {guides.depth, guided}};
    for (Image<Rgb>& layer : layers) planes.emplace_back(layer, developed);
    return planes;
}

}  // namespace

/// A loop over bands, for the share of this process.
class SharedFrame::Loop final : public SharedLoop {
 public:
    Loop(SharedFrame& frame, std::uint32_t bands, const BandWork& work)
        : frame_(frame),
          bands_(bands),
          fingerprint_(fingerprint_of(frame, bands)),
          told_(frame.job().result.luminances.size()),
          crew_(frame.traits().on_host ? most_bands : 1, frame.seam_,
                [&frame, &work](std::uint32_t band, BandTurn& turn) { work(frame, band, turn); }) {
        static_cast<void>(progress());  // of what comes
    }

    [[nodiscard]] std::uint32_t bands() const override { return bands_; }
    [[nodiscard]] std::uint64_t fingerprint() const override { return fingerprint_; }
    [[nodiscard]] BandCrew& crew() override { return crew_; }
    void load(std::span<const std::byte> sums) override {
        frame_.load(sums);
        begin_ = frame_.seam_.first_row;
    }
    [[nodiscard]] Peers::Bytes save() override {
        const FilmSeam& seam = frame_.seam_;
        if (seam.first_row > begin_) frame_.developed_.push_back({begin_, seam.first_row});
        return PackedBytes()
            .add(seam.luxel_rows)
            .add(seam.first_row)
            .add(seam.rows)
            .add_all(std::span(seam.sums))
            .add(frame_.summed_rows_)
            .add_all(std::span(std::as_const(frame_.sums_)))
            .take();
    }
    [[nodiscard]] Peers::Bytes rows() override {
        const std::vector<RowLuminances>& all = frame_.job().result.luminances;
        const std::size_t first = std::exchange(told_, all.size());
        PackedBytes left;
        left.add(progress()).add_all(std::span(all).subspan(first));
        if (frame_.share_.keeps()) frame_.add_pixels(left);
        return left.take();
    }
    void keep(std::span<const std::byte> rows) override {
        BytesReader in(rows);
        const auto more = in.get<Progress>();
        if (Monitor* const monitor = frame_.job().monitor; monitor != nullptr) {
            monitor->contributions += more.contributions;
            monitor->gathers += more.gathers;
            monitor->bands += more.bands;
        }
        for (const RowLuminances& row : in.get_all<RowLuminances>()) luminances_.push_back(row);
        if (frame_.share_.keeps()) frame_.take_pixels(in);
    }

    /// At the lead, those of all rows, once all bands are done.
    [[nodiscard]] const std::vector<RowLuminances>& luminances() const { return luminances_; }

 private:
    /// What a process has done since it told of that last.
    struct Progress {
        std::uint64_t contributions = 0;
        std::uint64_t gathers = 0;
        std::uint32_t bands = 0;
    };
    /// The lead's own is in its monitor.
    [[nodiscard]] Progress progress() {
        const Monitor* const monitor = frame_.job().monitor;
        if (monitor == nullptr || frame_.share_.is_lead()) return {};
        const Progress now{monitor->contributions, monitor->gathers, 1};
        const Progress before = std::exchange(reported_, now);
        return {now.contributions - before.contributions, now.gathers - before.gathers, 1};
    }

    SharedFrame& frame_;
    std::uint32_t bands_;
    std::uint64_t fingerprint_;
    std::size_t told_;         ///< rows of luxels whose luminances the lead knows
    std::uint32_t begin_ = 0;  ///< row of pixels below those that the bands above finished
    Progress reported_;
    std::vector<RowLuminances> luminances_;
    BandCrew crew_;
};

SharedFrame::SharedFrame(RenderJob& job, std::unique_ptr<RenderFrame> local, PictureShare& share)
    : RenderFrame(job, shared_traits(*local, share)), local_(std::move(local)), share_(share) {}

void SharedFrame::for_each_band(std::uint32_t bands, const BandWork& work) {
    const auto begin = std::chrono::steady_clock::now();
    load({});
    in_loop_ = true;
    Loop loop(*this, bands, work);
    share_.run(loop, job().monitor);
    in_loop_ = false;
    restate(loop.luminances());
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    job().clock.reassign(taken.count(), &StageSeconds::other,
                         stage_of(job().settings, summed_rows_ > 0));
}

/// Replaces the sums of bands; by those of none where there are no bytes.
void SharedFrame::load(std::span<const std::byte> sums) {
    seam_ = {};
    sums_.clear();
    summed_rows_ = 0;
    if (sums.empty()) return;
    BytesReader in(sums);
    seam_.luxel_rows = in.get<std::uint32_t>();
    seam_.first_row = in.get<std::uint32_t>();
    seam_.rows = in.get<std::uint32_t>();
    seam_.sums = in.get_all<double>();
    summed_rows_ = in.get<std::uint32_t>();
    sums_ = in.get_all<ImageResponse>();
}

/// Makes the luminances of a result those of all processes; at the lead.
void SharedFrame::restate(const std::vector<RowLuminances>& luminances) {
    if (luminances.empty()) return;
    RenderResult& result = job().result;
    RenderStatistics& s = result.statistics;
    clear_rows(s);
    for (const RowLuminances& row : luminances) add_row(s, row);
    result.luminances = luminances;
}

void SharedFrame::add_responses(const FrameBand& band, VplSpan<Space::host> vpls, float bound,
                                BandTurn& turn, ResponseSum& sum) {
    if (!in_loop_) return local_->add_responses(band, vpls, bound, turn, sum);
    const std::function<void()> load = [&] {
        if (summed_rows_ > 0) sum.go_on(summed_rows_, sums_);
    };
    SumTurn with_sum(turn, load);
    local_->add_responses(band, vpls, bound, with_sum, sum);
    summed_rows_ = sum.rows();
    sums_.assign(sum.sums().begin(), sum.sums().end());
}

VplRecords SharedFrame::sample_chains(const MetropolisOptions& options, float bound) {
    if (!traits().on_host) return local_->sample_chains(options, bound);
    return sample_chains_on_host(
        *local_, options, bound,
        [this](std::uint64_t first, std::span<double> weights, std::span<std::uint32_t> places,
               const PathDraw& draw) {
            draw_together(share_, job().monitor, {first, weights, places}, draw);
        });
}

void SharedFrame::take_over(ResponseSum& sum) { sum.go_on(summed_rows_, sums_); }

void SharedFrame::put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) {
    const std::uint32_t pixel = job().rays.grid.per_pixel_y;
    local_->put(band, std::move(layers), turn);
    guided_.push_back({band.first_row / pixel, (band.first_row + band.extent().height) / pixel});
}

std::vector<Image<Rgb>> SharedFrame::develop() {
    if (!share_.is_lead()) {
        if (!share_.keeps()) {
            PackedBytes message;
            add_pixels(message.add(TeamWord::pixels));
            share_.peers().send(0, message.take());
        }
        throw PixelsSent{};
    }
    if (share_.keeps()) return std::move(layers_);
    develop_own();
    for (std::uint32_t others = share_.peers().count() - 1; others > 0;) {
        const Peers::Letter letter = share_.wait();
        BytesReader in(letter.bytes);
        // Who came late to the last loop has asked for a band of it.
        if (in.get<TeamWord>() != TeamWord::pixels) continue;
        take_pixels(in);
        --others;
    }
    return std::move(layers_);
}

/// Puts what the film of this process has developed into its images.
void SharedFrame::develop_own() {
    for (const Rows rows : developed_) local_->develop_rows(rows[0], rows[1], layers_);
}

/// Adds the pixels that this process has made since it last did.
void SharedFrame::add_pixels(PackedBytes& message) {
    develop_own();
    std::vector<Image<Rgb>> none;
    std::vector<Image<Rgb>>& layers = developed_.empty() ? none : layers_;
    message.add(static_cast<std::uint32_t>(layers.size()));
    for (const Plane& plane : planes_of(job().result.guides, layers, guided_, developed_)) {
        Peers::Bytes pixels;
        for (const Rows rows : plane.rows) {
            const std::span<const std::byte> bytes = plane.of(rows);
            pixels.insert(pixels.end(), bytes.begin(), bytes.end());
        }
        message.add_all(std::span(plane.rows)).add_all(std::span<const std::byte>(pixels));
    }
    guided_.clear();
    developed_.clear();
}

/// Puts what a process made into the images of the lead.
void SharedFrame::take_pixels(BytesReader& in) {
    const auto count = in.get<std::uint32_t>();
    if (layers_.empty()) layers_.resize(count, Image<Rgb>(job().settings.image));
    std::vector<Image<Rgb>> none;
    for (const Plane& plane :
         planes_of(job().result.guides, count == 0 ? none : layers_, guided_, developed_)) {
        const std::vector<Rows> rows = in.get_all<Rows>();
        std::span<const std::byte> pixels = in.next_bytes();
        for (const Rows range : rows) {
            const std::span<std::byte> to = plane.of(range);
            std::copy_n(pixels.begin(), to.size(), to.begin());
            pixels = pixels.subspan(to.size());
        }
    }
}

std::unique_ptr<RenderFrame> shared_out(RenderJob& job, std::unique_ptr<RenderFrame> frame) {
    if (job.share == nullptr) return frame;
    return std::make_unique<SharedFrame>(job, std::move(frame), *job.share);
}

}  // namespace mir
