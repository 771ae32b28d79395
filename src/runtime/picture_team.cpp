// SPDX-License-Identifier: MIT
#include "mir/runtime/picture_team.hpp"

#include "mir/core/byte_hash.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/settings_hash.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/version.hpp"
#include "runtime/picture_share.hpp"
#include "runtime/shared_frame.hpp"

#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>

namespace mir {
namespace {

/// What all processes of a team must have alike, as a sentence says it.
std::string program_of() {
    const std::string rays = cpu_description();
    return std::string(version) + ", " + rays.substr(0, rays.find(',')) + ", compiler " +
           __VERSION__;
}

std::string text_of(const std::exception& e) { return e.what(); }

void add_text(PackedBytes& message, const std::string& text) {
    message.add_all(std::span<const char>(text));
}

Peers::Bytes error_message(TeamWord word, const Error& reason) {
    PackedBytes message;
    message.add(word).add(reason.code());
    add_text(message, reason.what());
    return message.take();
}

/// What differs from picture to picture.
struct Pass {
    std::uint64_t seed;
    PixelPlace only_luxel;
    float vsl_scale;
};

/// What tells a picture from all others.
Peers::Bytes identity_of(const Scene& scene, const RenderSettings& settings) {
    PackedBytes message;
    add_text(message, program_of());
    add_text(message, SceneHash(scene).hex());
    message.add(SettingsHash(settings).value());
    message.add(Pass{settings.seed, settings.only_luxel, settings.vsl.scale});
    return message.take();
}

std::uint64_t hash_of(const Peers::Bytes& bytes) {
    ByteHash hash;
    hash.add(bytes.data(), bytes.size());
    return hash.value();
}

/// The settings of the picture that a lead begins, from those of this process.
RenderSettings settings_of(BytesReader in, const std::string& scene, RenderSettings settings) {
    const auto differs = [](const char* what) {
        return Error(ErrorCode::invalid_input,
                     std::string("it has another ") + what +
                         " than the first process (their bands would not fit together); start all "
                         "with the same program, scene and options");
    };
    if (in.text() != program_of()) throw differs("version or build");
    if (in.text() != scene) throw differs("scene");
    const auto hash = in.get<std::uint64_t>();
    const auto pass = in.get<Pass>();
    settings.seed = pass.seed;
    settings.only_luxel = pass.only_luxel;
    settings.vsl.scale = pass.vsl_scale;
    if (SettingsHash(settings).value() != hash) throw differs("setting");
    return settings;
}

/// Calls work(); whatever it throws leaves as an Error, unless it is a team's own word.
template <class Work>
auto with_errors(const Work& work) {
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::out_of_memory,
                    "memory is short (a process of a team needs as much as one alone); start fewer "
                    "on a machine");
    } catch (const std::exception& e) {
        throw Error(ErrorCode::internal, text_of(e));
    }
}

}  // namespace

/// State of a team in one process.
class PictureTeam::Impl {
 public:
    explicit Impl(Peers& peers) : peers_(peers), share_(peers) {}

    [[nodiscard]] bool is_lead() const { return share_.is_lead(); }
    [[nodiscard]] bool is_alone() const { return peers_.count() == 1; }
    /// One process with one device may have to go on from what several kept.
    [[nodiscard]] bool goes_on_alone(const RenderSettings& settings) const {
        return keeper_ != nullptr && !settings.devices.all && settings.devices.numbers.size() <= 1;
    }

    RenderResult render(const Renderer& renderer, const Scene& scene,
                        const RenderSettings& settings, Monitor* monitor);
    void work(const Renderer& renderer, const Scene& scene, const RenderSettings& settings,
              Monitor* monitor);
    void keep_in(PictureKeeper& keeper) { keeper_ = &keeper; }
    void fail(const Error& reason) noexcept;
    void end() noexcept;

 private:
    void tell_all(const Peers::Bytes& message) {
        for (std::uint32_t rank = 1; rank < peers_.count(); ++rank) peers_.send(rank, message);
    }
    /// At the lead: waits until all others have left.
    void see_off();
    /// At all others: waits until the lead lets them go.
    void await_leave();
    void say_left() { peers_.send(0, PackedBytes().add(TeamWord::left).take()); }
    void work_on(const Renderer& renderer, const Scene& scene, const RenderSettings& settings,
                 Monitor* monitor);

    Peers& peers_;
    PictureShare share_;
    PictureKeeper* keeper_ = nullptr;
    std::optional<Error> failure_;  ///< after which the lead does nothing more
    bool is_over_ = false;          ///< this process has left
};

RenderResult PictureTeam::Impl::render(const Renderer& renderer, const Scene& scene,
                                       const RenderSettings& settings, Monitor* monitor) {
    if (is_alone() && !goes_on_alone(settings)) return renderer.render(scene, settings, monitor);
    if (failure_) throw *failure_;
    try {
        return with_errors([&] {
            expects(settings.rows.count == 0,
                    "rows of a picture were asked of several processes (they share out all rows); "
                    "leave the rows out, or render shards one by one");
            settings.validate();
            const bool keeps = keeper_ != nullptr;
            const Peers::Bytes identity = identity_of(scene, settings);
            share_.begin_picture(keeps, peers_.count());
            if (keeps) share_.go_on(*keeper_, hash_of(identity));
            tell_all(PackedBytes()
                         .add(TeamWord::begin)
                         .add(keeps)
                         .add(share_.cut_for())
                         .add_all(std::span(identity))
                         .take());
            return renderer.render_share(scene, settings, monitor, share_);
        });
    } catch (const Error& e) {
        fail(e);
        throw;
    }
}

void PictureTeam::Impl::work_on(const Renderer& renderer, const Scene& scene,
                                const RenderSettings& settings, Monitor* monitor) {
    const std::string hash = SceneHash(scene).hex();
    Monitor own;  // the lead wants to know how far this process is
    for (;;) {
        const Peers::Letter letter = share_.wait();
        BytesReader in(letter.bytes);
        const auto word = in.get<TeamWord>();
        if (word == TeamWord::leave) return;
        if (word != TeamWord::begin)
            throw Error(ErrorCode::internal, "the lead of a team began no picture");
        const bool keeps = in.get<bool>();
        share_.begin_picture(keeps, in.get<std::uint32_t>());
        const RenderSettings picture = settings_of(BytesReader(in.next_bytes()), hash, settings);
        try {
            static_cast<void>(
                renderer.render_share(scene, picture, monitor != nullptr ? monitor : &own, share_));
            throw Error(ErrorCode::internal, "a renderer shared nothing out");
        } catch (const PixelsSent&) {
            continue;
        }
    }
}

void PictureTeam::Impl::work(const Renderer& renderer, const Scene& scene,
                             const RenderSettings& settings, Monitor* monitor) {
    if (is_alone()) return;
    try {
        with_errors([&] { work_on(renderer, scene, settings, monitor); });
        is_over_ = true;
        say_left();
    } catch (const TeamStopped& stopped) {
        is_over_ = true;
        say_left();
        throw stopped.error;
    } catch (const Error& e) {
        fail(e);
        throw;
    }
}

void PictureTeam::Impl::await_leave() {
    try {
        for (;;) {
            const Peers::Letter letter = share_.wait();
            if (BytesReader(letter.bytes).get<TeamWord>() == TeamWord::leave) return;
        }
    } catch (const TeamStopped&) {
    }
}

void PictureTeam::Impl::see_off() {
    IdlePause pause;
    for (std::uint32_t others = peers_.count() - 1; others > 0;) {
        const std::optional<Peers::Letter> letter = peers_.receive();
        if (!letter)
            std::this_thread::sleep_for(pause.next());
        else if (BytesReader(letter->bytes).get<TeamWord>() == TeamWord::left)
            --others;
    }
}

void PictureTeam::Impl::fail(const Error& reason) noexcept {
    if (is_over_ || is_alone()) return;
    is_over_ = true;
    try {
        if (is_lead()) {
            failure_ = reason;
            tell_all(error_message(TeamWord::stop, reason));
            see_off();
        } else {
            peers_.send(0, error_message(TeamWord::failed, reason));
            await_leave();
            say_left();
        }
    } catch (...) {  // nobody can be told any more
    }
}

void PictureTeam::Impl::end() noexcept {
    if (is_over_ || is_alone()) return;
    if (!is_lead())
        return fail(Error(ErrorCode::internal, "a process left its team without having worked"));
    is_over_ = true;
    try {
        tell_all(PackedBytes().add(TeamWord::leave).take());
        see_off();
    } catch (...) {  // they are not there any more
    }
}

PictureTeam::PictureTeam(Peers& peers) : impl_(std::make_unique<Impl>(peers)) {}
PictureTeam::~PictureTeam() { impl_->end(); }
bool PictureTeam::is_lead() const { return impl_->is_lead(); }

void PictureTeam::keep_in(PictureKeeper& keeper) { impl_->keep_in(keeper); }

RenderResult PictureTeam::render(const Renderer& renderer, const Scene& scene,
                                 const RenderSettings& settings, Monitor* monitor) {
    return impl_->render(renderer, scene, settings, monitor);
}

void PictureTeam::work(const Renderer& renderer, const Scene& scene, const RenderSettings& settings,
                       Monitor* monitor) {
    impl_->work(renderer, scene, settings, monitor);
}

void PictureTeam::fail(const Error& reason) noexcept { impl_->fail(reason); }

}  // namespace mir
