// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/visibility.hpp"

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>

namespace mir {

namespace detail {

/// What a ray engine is asked, one virtual call a question.
class RayQuestions {
 public:
    RayQuestions() = default;
    RayQuestions(const RayQuestions&) = delete;
    RayQuestions& operator=(const RayQuestions&) = delete;
    virtual ~RayQuestions() = default;

    [[nodiscard]] virtual std::optional<SurfacePoint> closest_hit(Ray ray) const = 0;
    [[nodiscard]] virtual std::optional<SurfacePoint> closest_hit(Ray ray, float reach) const = 0;
    [[nodiscard]] virtual bool visible(Vec3 a, Vec3 b) const = 0;
    [[nodiscard]] virtual std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                                       std::uint32_t active) const = 0;
};

/// The calls, answered by a ray caster and a visibility.
template <RayCaster R, Visibility V>
class RayAnswers final : public RayQuestions {
 public:
    RayAnswers(const R& caster, const V& visibility) : caster_(caster), visibility_(visibility) {}

    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray) const override {
        return caster_.closest_hit(ray);
    }
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray, float reach) const override {
        if constexpr (ShortRayCaster<R>)
            return caster_.closest_hit(ray, reach);
        else
            return caster_.closest_hit(ray);
    }
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const override { return visibility_.visible(a, b); }
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const override {
        if constexpr (PacketVisibility<V>) {
            return visibility_.visible_packet(origin, points, active);
        } else {
            std::uint32_t seen = 0;
            for (std::uint32_t i = 0; i < PointPacket::width; ++i)
                if ((active >> i & 1u) != 0 &&
                    visibility_.visible(origin, {points.x[i], points.y[i], points.z[i]}))
                    seen |= 1u << i;
            return seen;
        }
    }

 private:
    R caster_;
    V visibility_;
};

}  // namespace detail

/// Asks an AnyEngine what a ray sees first. Model of ShortRayCaster; thread-safe. The AnyEngine
/// must outlive it.
struct AnyRayCaster {
    const detail::RayQuestions* calls;  ///< of the AnyEngine, never null

    /// The answer of the engine's own ray caster.
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray) const {
        return calls->closest_hit(ray);
    }
    /// `reach` in metres.
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray ray, float reach) const {
        return calls->closest_hit(ray, reach);
    }
};

/// Asks an AnyEngine whether points see each other. Model of PacketVisibility, with the answers of
/// the engine's own; thread-safe. The AnyEngine must outlive it.
struct AnyVisibility {
    static constexpr Space space = Space::host;  ///< called on the host

    const detail::RayQuestions* calls;  ///< of the AnyEngine, never null

    /// The answer of the engine's own visibility.
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return calls->visible(a, b); }
    /// Point by point through visible() where the engine answers no packets.
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const PointPacket& points,
                                               std::uint32_t active) const {
        return calls->visible_packet(origin, points, active);
    }
};

static_assert(ShortRayCaster<AnyRayCaster>);
static_assert(PacketVisibility<AnyVisibility>);

/// An engine of the host behind virtual calls. Code that traces ray by ray and takes a compiler
/// long uses it: it is compiled once, not once for each engine. Loops over luxels and VPLs by the
/// million keep the engine's own type, because they are compiled for vector registers with the
/// traversal inside. Const use from any thread; what the engine's handles read must outlive it.
/// Copies share them.
class AnyEngine {
 public:
    /// `engine` offers ray_caster() and visibility().
    template <class Engine>
    explicit AnyEngine(const Engine& engine)
        : AnyEngine(engine.ray_caster(), engine.visibility()) {}

    /// Valid as long as this or a copy of it.
    [[nodiscard]] AnyRayCaster ray_caster() const { return {calls_.get()}; }
    /// Valid as long as this or a copy of it.
    [[nodiscard]] AnyVisibility visibility() const { return {calls_.get()}; }

 private:
    template <RayCaster R, Visibility V>
    AnyEngine(const R& caster, const V& visibility)
        : calls_(std::make_shared<detail::RayAnswers<R, V>>(caster, visibility)) {}

    std::shared_ptr<const detail::RayQuestions> calls_;
};

}  // namespace mir
