// SPDX-License-Identifier: MIT
#include "mir/io/pass_journal.hpp"

#include "mir/runtime/progressive_render.hpp"
#include "mir/scenes.hpp"
#include "runtime/noise_renderer.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>
#include <iterator>

using mirtest::NoiseRenderer;

namespace {

const mir::Scene scene;

mir::RenderSettings settings() {
    mir::RenderSettings s;
    s.image = {3, 2};
    s.seed = 5;
    return s;
}

/// `sums` and what it lacks of `last` passes.
mir::PassSums continued(mir::PassSums sums, std::uint32_t last) {
    NoiseRenderer renderer;
    renderer.bounces = {1, 0, 2};
    renderer.earlier = sums.passes();
    mir::ProgressiveRender render(renderer, scene, settings(), {.passes = last}, nullptr,
                                  std::move(sums));
    while (!render.is_complete()) render.next_pass();
    return render.sums();
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

void check_refused(const mir::PassJournal& journal, const std::string& part) {
    try {
        static_cast<void>(journal.read());
        FAIL("it was read");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::invalid_argument);
        CHECK(std::string(e.what()).find(part) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("a render that goes on from a journal has the bits of one that was never stopped") {
    const mirtest::TemporaryFolder folder("pass_journal");
    const mir::PassJournal journal(folder / "a.journal", scene, settings());
    CHECK(journal.read().passes() == 0);
    CHECK(folder.files() == 0);
    for (std::uint32_t stop = 1; stop < 5; ++stop) {
        journal.write(continued(journal.read(), stop));
        CHECK(journal.read().passes() == stop);
        CHECK(folder.files() == 1);
    }
    const mir::RenderResult a = continued({}, 5).result();
    const mir::RenderResult b = continued(journal.read(), 5).result();
    for (const auto layer : {&mir::RenderResult::beauty, &mir::RenderResult::emission,
                             &mir::RenderResult::direct, &mir::RenderResult::indirect})
        CHECK(mirtest::same_bits(a.*layer, b.*layer));
    REQUIRE(b.bounces.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) CHECK(mirtest::same_bits(a.bounces[i], b.bounces[i]));
    CHECK(mirtest::same_bits(a.guides.albedo, b.guides.albedo));
    CHECK(mirtest::same_bits(a.guides.normal, b.guides.normal));
    CHECK(mirtest::same_bits(a.guides.position, b.guides.position));
    CHECK(mirtest::same_bits(a.guides.depth, b.guides.depth));
    CHECK(a.warnings == b.warnings);
    CHECK(a.statistics.relative_error == b.statistics.relative_error);
    CHECK(a.statistics.path_luminance == b.statistics.path_luminance);
    CHECK(a.statistics.light_paths == b.statistics.light_paths);
    CHECK(a.statistics.health->luminance.standard_error ==
          b.statistics.health->luminance.standard_error);
}

TEST_CASE("a journal belongs to its scene and settings") {
    const mirtest::TemporaryFolder folder("pass_journal");
    const mir::PassJournal journal(folder / "a.journal", scene, settings());
    journal.write(continued({}, 2));
    check_refused({folder / "a.journal", mir::builtin::make("furnace"), settings()},
                  "another scene");
    using Change = void (*)(mir::RenderSettings&);
    for (const Change change :
         {Change([](mir::RenderSettings& s) { s.seed = 6; }),
          Change([](mir::RenderSettings& s) {
              s.image = {2, 3};
          }),
          Change([](mir::RenderSettings& s) { s.vpls = 255; }),
          Change([](mir::RenderSettings& s) {
              s.bound = {mir::BoundPolicy::Kind::fixed, 0.5f};
          }),
          Change([](mir::RenderSettings& s) { s.filter.half_width = 1.5f; }),
          Change([](mir::RenderSettings& s) { s.compensate = 1; }),
          Change([](mir::RenderSettings& s) { s.vsl.enabled = true; }),
          Change([](mir::RenderSettings& s) { s.vsl.scale = 0.5f; }),
          Change([](mir::RenderSettings& s) { s.removed_layer = true; }),
          Change([](mir::RenderSettings& s) { s.pick_error_layer = true; }),
          Change([](mir::RenderSettings& s) { s.only_luxel.x = 0.25f; }),
          Change([](mir::RenderSettings& s) { s.picks = 64; }),
          Change([](mir::RenderSettings& s) { s.bounce_layers = true; }),
          Change([](mir::RenderSettings& s) { s.path.samples = 3; }),
          Change([](mir::RenderSettings& s) { s.micro.gather.threshold = 0.5f; }),
          Change([](mir::RenderSettings& s) { s.micro.luxels = mir::MicroGather::buffers; }),
          Change([](mir::RenderSettings& s) { s.micro.buffer_side = 8; }),
          Change([](mir::RenderSettings& s) { s.micro.buffer_warp = mir::BufferWarp::importance; }),
          Change([](mir::RenderSettings& s) { s.metropolis.chain.tries = 3; }),
          Change([](mir::RenderSettings& s) { s.metropolis.bootstrap.relative_error = 0.1; })}) {
        mir::RenderSettings other = settings();
        change(other);
        check_refused({folder / "a.journal", scene, other}, "other settings");
    }
    mir::RenderSettings same = settings();
    same.threads = 3;
    same.scheduler = "cpu";
    same.tile = mir::Extent{16, 16};
    same.limits.vpls = 1000;
    CHECK(mir::PassJournal(folder / "a.journal", scene, same).read().passes() == 2);
}

TEST_CASE("a journal that was cut or altered anywhere is refused") {
    const mirtest::TemporaryFolder folder("pass_journal");
    const mir::PassJournal journal(folder / "a.journal", scene, settings());
    journal.write(continued({}, 3));
    const std::string good = bytes_of(folder / "a.journal");
    REQUIRE(good.size() > 1000);
    for (std::size_t i = 0; i < good.size(); i += 7) {
        INFO("byte " << i << " of " << good.size());
        write_bytes(folder / "a.journal", good.substr(0, i));
        check_refused(journal, "delete the file");
        for (const int mask : {0x01, 0x80}) {
            std::string bad = good;
            bad[i] = static_cast<char>(bad[i] ^ mask);
            write_bytes(folder / "a.journal", bad);
            check_refused(journal, "delete the file");
        }
    }
    write_bytes(folder / "a.journal", good + "x");
    check_refused(journal, "it is damaged");
    write_bytes(folder / "a.journal", good);
    CHECK(journal.read().passes() == 3);
}

TEST_CASE("a journal that cannot be written is refused before any work") {
    CHECK_THROWS_AS(mir::PassJournal("/nonexistent/a.journal", scene, settings()), mir::Error);
}
