// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/scene/material.hpp"
#include "mir/shading/lambert.hpp"

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace mirtest {

/// What a host's own code throws: no std::exception, so that nobody catches it by accident.
struct HostFailure {
    std::uint64_t number = 0;
};

/// Throws HostFailure in the n-th of its calls, counted from 1, from whatever thread; 0: never.
class FailingCall {
 public:
    static inline constexpr std::uint64_t never = 0;

    void arm(std::uint64_t n) {
        calls_ = 0;
        wanted_ = n;
    }
    void operator()() {
        if (++calls_ == wanted_) throw HostFailure{wanted_};
    }
    [[nodiscard]] std::uint64_t calls() const { return calls_; }

 private:
    std::atomic<std::uint64_t> calls_{0};
    std::atomic<std::uint64_t> wanted_{never};
};

/// Where in a loop an executor fails.
enum class FailingMoment : std::uint8_t { before, in_the_middle, at_the_end };

/// Loops on the executor beneath, of which one fails by itself: before the first body, in place of
/// a body in the middle, or when all are done. Model of Executor.
template <mir::Executor E>
class FailingExecutor {
 public:
    explicit FailingExecutor(E& executor) : executor_(executor) {}
    FailingExecutor(const FailingExecutor&) = delete;
    FailingExecutor& operator=(const FailingExecutor&) = delete;
    ~FailingExecutor() = default;

    void arm(std::uint64_t loop, FailingMoment moment) {
        loops_.arm(FailingCall::never);
        loop_ = loop;
        moment_ = moment;
    }
    [[nodiscard]] std::uint64_t loops() const { return loops_.calls(); }

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        if (loops_.calls() + 1 != loop_) {
            loops_();
            return executor_.for_each(n, body);
        }
        const HostFailure failure{loop_};
        loop_ = FailingCall::never;
        if (moment_ == FailingMoment::before) throw failure;
        executor_.for_each(n, [&](std::size_t i) {
            if (moment_ == FailingMoment::in_the_middle && i == n / 2) throw failure;
            body(i);
        });
        throw failure;
    }
    [[nodiscard]] std::size_t concurrency() const { return executor_.concurrency(); }

 private:
    E& executor_;
    FailingCall loops_;
    std::uint64_t loop_ = FailingCall::never;
    FailingMoment moment_ = FailingMoment::before;
};

/// Lambert, whose functions fail when told to. Model of Bsdf.
struct FailingLambert {
    using Params = mir::Lambert::Params;
    static inline FailingCall call;  // NOLINT(*-avoid-non-const-global-variables)

    static mir::Rgb eval(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        call();
        return mir::Lambert::eval(p, n, wi, wo);
    }
    static float pdf(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        call();
        return mir::Lambert::pdf(p, n, wi, wo);
    }
    static mir::BsdfSample sample(const Params& p, mir::Vec3 n, mir::Vec3 wo, mir::Vec2 u,
                                  float lobe) {
        call();
        return mir::Lambert::sample(p, n, wo, u, lobe);
    }
    static mir::Rgb albedo(const Params& p, mir::Vec3 n, mir::Vec3 wo) {
        call();
        return mir::Lambert::albedo(p, n, wo);
    }
    static bool is_black(const Params& p) {
        call();
        return mir::Lambert::is_black(p);
    }
};

/// For SurfaceTable.
inline FailingLambert::Params material_params(const mir::Material& m, FailingLambert) {
    return {m.base_color};
}

/// Segments and packets of a visibility that fails when told to. Model of PacketVisibility.
template <mir::PacketVisibility V>
struct FailingVisibility {
    static constexpr mir::Space space = mir::Space::host;
    V beneath;
    FailingCall* call;

    [[nodiscard]] bool visible(mir::Vec3 a, mir::Vec3 b) const {
        (*call)();
        return beneath.visible(a, b);
    }
    [[nodiscard]] std::uint32_t visible_packet(mir::Vec3 origin, const mir::PointPacket& points,
                                               std::uint32_t active) const {
        (*call)();
        return beneath.visible_packet(origin, points, active);
    }
};

/// A ray caster that fails when told to. Model of RayCaster.
template <mir::RayCaster R>
struct FailingRayCaster {
    R beneath;
    FailingCall* call;

    [[nodiscard]] std::optional<mir::SurfacePoint> closest_hit(mir::Ray ray) const {
        (*call)();
        return beneath.closest_hit(ray);
    }
};

/// The luxels of a buffer, which fail to be shown when told to. Model of TiledGBuffer.
template <mir::TiledGBuffer G>
struct FailingLuxels {
    const G& beneath;
    FailingCall* call;

    [[nodiscard]] mir::Extent extent() const { return beneath.extent(); }
    [[nodiscard]] const std::vector<mir::Tile>& tiles() const { return beneath.tiles(); }
    [[nodiscard]] auto view(mir::TileIndex t) const {
        (*call)();
        return beneath.view(t);
    }
};

}  // namespace mirtest
