// SPDX-License-Identifier: MIT
#include "mir/runtime/renderer.hpp"
#include "runtime/frame_features.hpp"
#include "support/catch.hpp"

namespace {

using mir::BackendKind;
using mir::Registry;
using mir::RenderSettings;

/// Tells by the picture's scheduler who rendered.
struct NamedRenderer : mir::Renderer {
    explicit NamedRenderer(std::string name) : name_(std::move(name)) {}

    mir::RenderResult render(const mir::Scene&, const RenderSettings&,
                             mir::Monitor*) const override {
        mir::RenderResult r{{}, {}, {}, {}, {}, mir::Guides({1, 1}), {}, {}, {}};
        r.statistics.scheduler = name_;
        return r;
    }

    std::string name_;
};

Registry::Backend backend(BackendKind kind, const std::string& name) {
    Registry::Backend b{kind, name, [] {}, "usual", {}};
    b.schedulers.emplace("usual", [name] { return std::make_unique<NamedRenderer>(name); });
    return b;
}

/// A GPU and a processor; `gpu` may be changed before they are asked.
struct Machine {
    Registry::Backend gpu = backend(BackendKind::cuda, "cuda");

    [[nodiscard]] Registry::Choice choose(const RenderSettings& s) const {
        Registry registry;
        registry.add(gpu);
        registry.add(backend(BackendKind::cpu, "cpu"));
        return registry.make_for(s);
    }
};

std::string name_of(const Registry::Choice& choice) {
    return choice.renderer->render({}, {}, nullptr).statistics.scheduler;
}

/// As the renderers of GPUs do.
std::string reason_against_gpu(const RenderSettings& s) {
    return mir::reason_against(s, mir::FrameFeatures{});
}

[[noreturn]] void too_old() {
    throw mir::Error(mir::ErrorCode::no_device, "the driver is too old");
}

}  // namespace

TEST_CASE("the first backend renders what it can") {
    Machine machine;
    machine.gpu.refuses = reason_against_gpu;
    const Registry::Choice choice = machine.choose({});
    CHECK(name_of(choice) == "cuda");
    CHECK(choice.remarks.empty());
}

TEST_CASE("settings for the processor alone are rendered there, and it is said why") {
    Machine machine;
    machine.gpu.refuses = reason_against_gpu;
    std::vector<RenderSettings> all(4);
    all[0].pick_error_layer = true;
    all[1].vsl.enabled = true;
    all[2].glossy.enabled = true;
    all[3].acceleration = mir::Acceleration::embree;
    for (RenderSettings& s : all) {
        const Registry::Choice choice = machine.choose(s);
        CHECK(name_of(choice) == "cpu");
        REQUIRE(choice.remarks.size() == 1);
        CHECK(choice.remarks[0] == "backend cuda was not used: " + reason_against_gpu(s));
        s.backend = BackendKind::cuda;
        CHECK(name_of(machine.choose(s)) == "cuda");  // which answers by itself
    }
}

TEST_CASE("a GPU that is there and cannot be used is named, one that is not there is not") {
    Machine machine;
    machine.gpu.require = too_old;
    const Registry::Choice choice = machine.choose({});
    CHECK(name_of(choice) == "cpu");
    REQUIRE(choice.remarks.size() == 1);
    CHECK(choice.remarks[0] == "backend cuda was not used: the driver is too old");
    machine.gpu.is_present = [] { return false; };
    CHECK(machine.choose({}).remarks.empty());
    RenderSettings s;
    s.backend = BackendKind::cuda;
    CHECK_THROWS_AS(machine.choose(s), mir::Error);
}

TEST_CASE("a scheduler that no backend has is an error that lists them") {
    RenderSettings s;
    s.scheduler = "none";
    try {
        static_cast<void>(Machine{}.choose(s));
        FAIL("nothing was thrown");
    } catch (const mir::Error& e) {
        CHECK(e.code() == mir::ErrorCode::unsupported);
        CHECK(std::string(e.what()).find("usual") != std::string::npos);
    }
}
