// SPDX-License-Identifier: MIT
//
// Pictures by several processes against those of one: the same bytes. Threads stand for processes.
#include "frame/same_result.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/picture_team.hpp"
#include "mir/scenes.hpp"
#include "split/thread_peers.hpp"
#include "support/catch.hpp"

#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <string>
#include <thread>

namespace {

using mir::Error;
using mir::ErrorCode;
using mir::PictureTeam;
using mir::RenderResult;
using mir::RenderSettings;
using mirtest::Box;
using mirtest::check_same;
using mirtest::ThreadPeers;

/// Calls body(team, rank) for each process of a team. Nothing may be left unread in the end.
void as_team(std::uint32_t count, const std::function<void(PictureTeam&, std::uint32_t)>& body) {
    std::deque<Box> boxes(count);
    const auto be = [&](std::uint32_t rank) {
        ThreadPeers peers(boxes, rank);
        PictureTeam team(peers);
        body(team, rank);
    };
    std::vector<std::jthread> others;
    for (std::uint32_t rank = 1; rank < count; ++rank) others.emplace_back(be, rank);
    be(0);
    others.clear();
    for (const Box& box : boxes) CHECK(box.letters.empty());
}

const mir::Scene& room() {
    static const mir::Scene scene = mir::builtin::cornell_box(mir::builtin::Lamp::down);
    return scene;
}

std::unique_ptr<mir::Renderer> renderer() {
    mir::Registry registry;
    mir::add_cpu_to(registry);
    return registry.make(mir::BackendKind::cpu, "");
}

/// Bands of 16 rows of pixels.
RenderSettings small_picture() {
    RenderSettings s;
    s.image = {21, 69};
    s.luxels_per_pixel = 4;
    s.vpls = 12;
    s.direct_samples = 4;
    s.threads = 1;
    s.measure_missing = false;  // takes longer than such a picture
    s.metropolis.bootstrap.min_paths = s.metropolis.bootstrap.max_paths = 1024;
    return s;
}

RenderResult alone(const RenderSettings& settings) {
    return renderer()->render(room(), settings, nullptr);
}

RenderResult drawn(const RenderSettings& settings, std::uint32_t processes,
                   mir::Monitor* monitor = nullptr) {
    std::optional<RenderResult> result;
    as_team(processes, [&](PictureTeam& team, std::uint32_t) {
        if (team.is_lead())
            result = team.render(*renderer(), room(), settings, monitor);
        else
            team.work(*renderer(), room(), settings, nullptr);
    });
    return std::move(*result);
}

/// The code and the words of what each process throws.
struct Failures {
    std::vector<std::optional<ErrorCode>> codes;
    std::vector<std::string> words;
};

/// Each process does body(team, rank), and the team hears of what it throws.
Failures failures_of(std::uint32_t count,
                     const std::function<void(PictureTeam&, std::uint32_t)>& body) {
    Failures all{std::vector<std::optional<ErrorCode>>(count), std::vector<std::string>(count)};
    as_team(count, [&](PictureTeam& team, std::uint32_t rank) {
        try {
            body(team, rank);
        } catch (const Error& e) {
            all.codes[rank] = e.code();
            all.words[rank] = e.what();
            team.fail(e);
        }
    });
    return all;
}

/// Keeps what it is given behind each band.
struct Keeper final : mir::PictureKeeper {
    std::vector<std::byte> read() override {
        return pictures.empty() ? std::vector<std::byte>() : pictures.back();
    }
    bool is_time() override { return true; }
    void write(const std::vector<std::byte>& picture) override { pictures.push_back(picture); }

    std::vector<std::vector<std::byte>> pictures;
};

/// One whose work cannot be shared out.
struct Failing final : mir::Renderer {
    RenderResult render(const mir::Scene&, const RenderSettings&, mir::Monitor*) const override {
        throw std::runtime_error("nobody renders alone here");
    }
};

}  // namespace

TEST_CASE("Processes that share a picture give the bytes of one") {
    RenderSettings s = small_picture();
    s.bounce_layers = s.removed_layer = true;
    s.measure_missing = true;
    const RenderResult one = alone(s);
    CHECK(one.statistics.indirect_luminance > 0.0);
    for (const std::uint32_t processes : {1u, 2u, 3u, 8u}) {
        CAPTURE(processes);
        const RenderResult shared = drawn(s, processes);
        check_same(shared, one);
        CHECK(shared.luminances.size() == one.luminances.size());
        CHECK(shared.statistics.scene_hash == one.statistics.scene_hash);
        CHECK(shared.warnings == one.warnings);
    }
}

TEST_CASE("Processes share whatever a picture is made of") {
    RenderSettings s = small_picture();
    SECTION("visibility of one row of blocks at a time, which nobody keeps") {
        s.limits.visibility_bytes = std::uint64_t{3} * 256 * 12 / 8 * 2;
    }
    SECTION("a prepass, some VPLs of which need the whole image") {
        s.normalisation = mir::NormalisationPolicy::prepass;
        s.prepass_luxels = 200;
    }
    SECTION("light paths") { s.sampler = mir::SamplerKind::instant_radiosity; }
    SECTION("cuts and their error") {
        s.sampler = mir::SamplerKind::instant_radiosity;
        s.sum = mir::LightSum::cuts;
        s.picks = 4;
        s.pick_error_layer = true;
    }
    SECTION("a filter that reaches as far as two bands are high") {
        s.filter = mir::default_filter(mir::FilterKind::mitchell);
        s.filter.half_width = 16.0f;
        s.luxels_per_pixel = 1;
    }
    SECTION("more processes than bands") { s.image = {16, 9}; }
    SECTION("paths") {
        s.integrator = mir::Integrator::path;
        s.path.samples = 1;
    }
    SECTION("discs") {
        s.integrator = mir::Integrator::micro;
        s.micro.surfels = 64;
        s.micro.gather.rays = 8;
        s.micro.luxels = mir::MicroGather::rays;
        s.micro.check = mir::GatherCheck::none;
    }
    check_same(drawn(s, 3), alone(s));
}

TEST_CASE("A team makes pictures one after the other, and tells how far they are") {
    RenderSettings s = small_picture();
    std::vector<RenderResult> pictures;
    mir::Monitor monitor;
    as_team(3, [&](PictureTeam& team, std::uint32_t) {
        if (!team.is_lead()) return team.work(*renderer(), room(), small_picture(), nullptr);
        for (s.seed = 0; s.seed < 3; ++s.seed) {
            monitor.begin_pass(0);
            pictures.push_back(team.render(*renderer(), room(), s, &monitor));
            CHECK(monitor.contributions == monitor.planned_contributions);
            CHECK(monitor.bands == monitor.planned_bands);
        }
    });
    for (s.seed = 0; s.seed < 3; ++s.seed) check_same(pictures[s.seed], alone(s));
}

TEST_CASE("Loops go on without a process that comes late") {
    const RenderSettings s = small_picture();
    std::optional<RenderResult> result;
    as_team(3, [&](PictureTeam& team, std::uint32_t rank) {
        if (team.is_lead()) {
            result = team.render(*renderer(), room(), s, nullptr);
            return;
        }
        if (rank == 2) std::this_thread::sleep_for(std::chrono::milliseconds(300));
        team.work(*renderer(), room(), s, nullptr);
    });
    check_same(*result, alone(s));
}

TEST_CASE("A team that is started again goes on from the bands that were kept") {
    RenderSettings s = small_picture();
    s.bounce_layers = true;
    s.luxels_per_pixel = 1;
    s.image = {8, 520};  // so high that more processes have lower bands
    const RenderResult one = alone(s);
    const auto kept_in = [&](mir::PictureKeeper& keeper, std::uint32_t processes = 2) {
        mir::Monitor monitor;
        std::optional<RenderResult> result;
        as_team(processes, [&](PictureTeam& team, std::uint32_t) {
            if (!team.is_lead()) return team.work(*renderer(), room(), s, nullptr);
            team.keep_in(keeper);
            result = team.render(*renderer(), room(), s, &monitor);
        });
        return std::move(*result);
    };
    Keeper all;
    check_same(kept_in(all), one);
    REQUIRE(all.pictures.size() > 6);  // of two loops
    for (const std::size_t last : {std::size_t{0}, all.pictures.size() / 2 - 1,
                                   all.pictures.size() / 2, all.pictures.size() - 1}) {
        for (const std::uint32_t processes : {1u, 2u, 5u}) {
            CAPTURE(last, processes);
            Keeper again;
            again.pictures = {all.pictures[last]};
            check_same(kept_in(again, processes), one);
            CHECK(again.pictures.size() == all.pictures.size() - last);
        }
    }
    // Another picture begins anew.
    Keeper other;
    other.pictures = {all.pictures.back()};
    s.seed = 1;
    check_same(kept_in(other), alone(s));
}

TEST_CASE("What fails in one process reaches all") {
    for (const std::uint32_t bad : {0u, 2u}) {
        CAPTURE(bad);
        const Failures all = failures_of(3, [&](PictureTeam& team, std::uint32_t rank) {
            if (rank == bad) throw Error(ErrorCode::io, "this one has no scene");
            if (team.is_lead())
                static_cast<void>(team.render(*renderer(), room(), small_picture(), nullptr));
            else
                team.work(*renderer(), room(), small_picture(), nullptr);
        });
        for (std::uint32_t rank = 0; rank < 3; ++rank) {
            REQUIRE(all.codes[rank].has_value());
            CHECK(*all.codes[rank] == ErrorCode::io);
            CHECK(all.words[rank].find("this one has no scene") != std::string::npos);
        }
    }
}

TEST_CASE("A render that is cancelled at the lead ends everywhere") {
    mir::Monitor monitor;
    monitor.cancelled = true;
    const Failures all = failures_of(2, [&](PictureTeam& team, std::uint32_t) {
        if (team.is_lead())
            static_cast<void>(team.render(*renderer(), room(), small_picture(), &monitor));
        else
            team.work(*renderer(), room(), small_picture(), nullptr);
    });
    for (const auto& code : all.codes) CHECK(code == ErrorCode::cancelled);
}

TEST_CASE("Processes with another scene, other settings or nothing to share are refused") {
    mir::Scene other = room();
    other.meshes.front().positions.front().x += 0.125f;
    const auto failing = [&](const mir::Renderer& by, const mir::Scene& scene,
                             const RenderSettings& settings) {
        return failures_of(2, [&](PictureTeam& team, std::uint32_t) {
            if (team.is_lead())
                static_cast<void>(team.render(by, room(), small_picture(), nullptr));
            else
                team.work(*renderer(), scene, settings, nullptr);
        });
    };
    RenderSettings s = small_picture();
    SECTION("another scene") {
        CHECK(failing(*renderer(), other, s).words[0].find("process 1: it has another scene") == 0);
    }
    SECTION("other settings") {
        s.vpls = 13;
        CHECK(failing(*renderer(), room(), s).words[0].find("another setting") !=
              std::string::npos);
    }
    SECTION("no way to share") {
        CHECK(failing(Failing(), room(), s).codes[1] == ErrorCode::unsupported);
    }
    SECTION("some rows") {
        RenderSettings rows = s;
        rows.rows = {0, 3};
        const Failures all = failures_of(2, [&](PictureTeam& team, std::uint32_t) {
            if (team.is_lead())
                static_cast<void>(team.render(*renderer(), room(), rows, nullptr));
            else
                team.work(*renderer(), room(), s, nullptr);
        });
        CHECK(all.codes[1] == ErrorCode::invalid_argument);
    }
}
