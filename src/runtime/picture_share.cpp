// SPDX-License-Identifier: MIT
#include "runtime/picture_share.hpp"

#include "runtime/band_book.hpp"

#include <string>
#include <thread>

namespace mir {
namespace {

using Bytes = Peers::Bytes;

/// "process 2: " before what happened there.
Error error_in(BytesReader& in, const std::string& where) {
    const auto code = in.get<ErrorCode>();
    return {code, where + in.text()};
}

Error out_of_step() {
    return {ErrorCode::internal,
            "processes of a team got out of step (they may run different programs); start the same "
            "one everywhere"};
}

}  // namespace

/// One loop.
class PictureShare::Run {
 public:
    Run(PictureShare& share, SharedLoop& loop, Monitor* monitor)
        : share_(share), loop_(loop), monitor_(monitor), number_(share.all_loops_++) {
        // Who has which band of a loop that is not kept says nothing of the next one.
        if (!loop.is_kept()) share.owners_.clear();
        if (loop.is_kept()) ++share.loops_;
        if (!share.is_lead()) return;
        if (loop.is_kept()) done_before_ = share.begin_loop(loop, sums_);
        book_.emplace(loop.bands(), share.owners_, done_before_);
    }

    void run() {
        IdlePause pause;
        if (book_ && book_->is_complete()) go_on();
        while (!is_over_) {
            if (monitor_ != nullptr) monitor_->check();
            if (!has_asked_ && loop_.crew().is_free()) ask();
            for (const BandCrew::Event& event : loop_.crew().events(pause.next())) {
                pause.reset();
                tell(event);
            }
            while (!is_over_) {
                const std::optional<Peers::Letter> letter = share_.receive();
                if (!letter) break;
                pause.reset();
                take(*letter);
            }
        }
        // Who had the bands that were kept is not known.
        if (done_before_ > 0 || !loop_.is_kept()) share_.owners_.clear();
    }

 private:
    void ask() {
        has_asked_ = true;
        tell_lead(PackedBytes()
                      .add(TeamWord::want)
                      .add(number_)
                      .add(loop_.bands())
                      .add(loop_.fingerprint())
                      .take());
    }
    void tell(const BandCrew::Event& event) {
        PackedBytes message;
        message.add(event.done ? TeamWord::done : TeamWord::ready).add(event.band);
        if (event.done)
            message.add_all(std::span<const std::byte>(loop_.save()))
                .add_all(std::span<const std::byte>(loop_.rows()));
        tell_lead(message.take());
    }
    void tell_lead(const Bytes& message) {
        if (!share_.is_lead()) return share_.peers_.send(0, message);
        take({0, message});
    }
    void send(std::uint32_t to, const Bytes& message) {
        if (to != 0) return share_.peers_.send(to, message);
        take({0, message});
    }

    void take(const Peers::Letter& letter) {
        BytesReader in(letter.bytes);
        switch (in.get<TeamWord>()) {
            case TeamWord::band:
                has_asked_ = false;
                return loop_.crew().begin(in.get<std::uint32_t>());
            case TeamWord::turn: {
                const auto band = in.get<std::uint32_t>();
                loop_.load(in.next_bytes());
                return loop_.crew().give_turn(band);
            }
            case TeamWord::loop_end:
                loop_.load(in.next_bytes());
                is_over_ = true;
                return;
            case TeamWord::want:
                return deal(letter.from, in);
            case TeamWord::ready:
                book_->ready(in.get<std::uint32_t>());
                return go_on();
            case TeamWord::done:
                static_cast<void>(in.get<std::uint32_t>());
                book_->done();
                sums_ = in.get_all<std::byte>();
                keep(in.next_bytes());
                return go_on();
            default:
                throw out_of_step();
        }
    }

    void keep(std::span<const std::byte> rows) {
        loop_.keep(rows);
        if (loop_.is_kept()) share_.keep_band(sums_, rows);
    }
    void deal(std::uint32_t rank, BytesReader& in) {
        // One that was over when it began is answered already.
        if (in.get<std::uint32_t>() != number_) return;
        const auto bands = in.get<std::uint32_t>();
        if (bands != loop_.bands() || in.get<std::uint64_t>() != loop_.fingerprint())
            throw Error(ErrorCode::invalid_input,
                        "process " + std::to_string(rank) +
                            " computed other VPLs, rays or shares of light than the first (their "
                            "bands would not fit together); start all on machines of one kind, "
                            "with the same settings");
        if (const std::optional<std::uint32_t> band = book_->deal(rank))
            send(rank, PackedBytes().add(TeamWord::band).add(*band).take());
    }
    /// Gives the turn to the next band that waits for it, or ends the loop.
    void go_on() {
        if (book_->is_complete()) {
            const Bytes message = PackedBytes()
                                      .add(TeamWord::loop_end)
                                      .add_all(std::span<const std::byte>(sums_))
                                      .take();
            for (std::uint32_t rank = share_.peers_.count(); rank-- > 0;) send(rank, message);
        } else if (const std::optional<std::uint32_t> band = book_->turn()) {
            send(book_->owner(*band), PackedBytes()
                                          .add(TeamWord::turn)
                                          .add(*band)
                                          .add_all(std::span<const std::byte>(sums_))
                                          .take());
        }
    }

    PictureShare& share_;
    SharedLoop& loop_;
    Monitor* monitor_;
    std::optional<BandBook> book_;   ///< of the lead
    Bytes sums_;                     ///< of the bands that are done; at the lead
    std::uint32_t number_ = 0;       ///< of the loop, among those of all pictures
    std::uint32_t done_before_ = 0;  ///< bands that were kept
    bool has_asked_ = false;         ///< for a band, which has not come
    bool is_over_ = false;
};

void PictureShare::run(SharedLoop& loop, Monitor* monitor) { Run(*this, loop, monitor).run(); }

/// Bands of the loop that were kept, and their sums. What they left is the loop's again.
std::uint32_t PictureShare::begin_loop(SharedLoop& loop, Bytes& sums) {
    const std::uint32_t number = loops_ - 1;
    if (number < kept_.loops.size()) {
        sums = kept_.loops[number];
        return loop.bands();
    }
    const bool goes_on = number == kept_.loops.size() && !kept_.rows.empty() &&
                         kept_.fingerprint == loop.fingerprint() &&
                         kept_.rows.size() <= loop.bands();
    if (!goes_on) {
        while (number > kept_.loops.size()) kept_.loops.push_back(kept_.sums);
        kept_.fingerprint = loop.fingerprint();
        kept_.sums.clear();
        kept_.rows.clear();
    }
    for (const Bytes& rows : kept_.rows) loop.keep(rows);
    sums = kept_.sums;
    return static_cast<std::uint32_t>(kept_.rows.size());
}

void PictureShare::keep_band(const Bytes& sums, std::span<const std::byte> rows) {
    if (keeper_ == nullptr) return;
    kept_.sums = sums;
    kept_.rows.emplace_back(rows.begin(), rows.end());
    if (keeper_->is_time()) keeper_->write(kept_.packed(id_));
}

void PictureShare::go_on(PictureKeeper& keeper, std::uint64_t id) {
    keeper_ = &keeper;
    id_ = id;
    kept_ = KeptBands::of(id, keeper.read());
    if (kept_.cut_for > 0) cut_for_ = kept_.cut_for;
    kept_.cut_for = cut_for_;
}

Bytes KeptBands::packed(std::uint64_t id) const {
    PackedBytes all;
    all.add(id).add(cut_for).add(fingerprint).add_all(std::span(sums));
    for (const auto* list : {&loops, &rows}) {
        all.add(std::uint64_t{list->size()});
        for (const Bytes& one : *list) all.add_all(std::span(one));
    }
    return all.take();
}

KeptBands KeptBands::of(std::uint64_t id, const Bytes& bytes) {
    KeptBands kept;
    if (bytes.empty()) return kept;
    BytesReader in(bytes);
    if (in.get<std::uint64_t>() != id) return kept;
    kept.cut_for = in.get<std::uint32_t>();
    kept.fingerprint = in.get<std::uint64_t>();
    kept.sums = in.get_all<std::byte>();
    for (auto* list : {&kept.loops, &kept.rows})
        for (auto left = in.get<std::uint64_t>(); left > 0; --left)
            list->push_back(in.get_all<std::byte>());
    return kept;
}

Bytes PictureShare::spread(Bytes of_lead) {
    if (is_lead()) {
        const Bytes message =
            PackedBytes().add(TeamWord::whole).add_all(std::span<const std::byte>(of_lead)).take();
        for (std::uint32_t rank = 1; rank < peers_.count(); ++rank) peers_.send(rank, message);
        return of_lead;
    }
    const Peers::Letter letter = wait();
    BytesReader in(letter.bytes);
    if (in.get<TeamWord>() != TeamWord::whole) throw out_of_step();
    return in.get_all<std::byte>();
}

std::optional<Peers::Letter> PictureShare::receive() {
    std::optional<Peers::Letter> letter = peers_.receive();
    if (!letter) return letter;
    BytesReader in(letter->bytes);
    const auto word = in.get<TeamWord>();
    if (word == TeamWord::stop) throw TeamStopped{error_in(in, "")};
    if (word == TeamWord::failed)
        throw error_in(in, "process " + std::to_string(letter->from) + ": ");
    return letter;
}

Peers::Letter PictureShare::wait() {
    for (IdlePause pause;;) {
        if (std::optional<Peers::Letter> letter = receive()) return std::move(*letter);
        std::this_thread::sleep_for(pause.next());
    }
}

}  // namespace mir
