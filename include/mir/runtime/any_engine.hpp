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

/// What a prepared block of luxels is asked.
class BlockQuestions {
 public:
    BlockQuestions() = default;
    BlockQuestions(const BlockQuestions&) = delete;
    BlockQuestions& operator=(const BlockQuestions&) = delete;
    virtual ~BlockQuestions() = default;

    virtual void visible_block(Vec3 origin, BlockMask& mask) const = 0;
};

/// The call, answered by a visibility.
template <BlockVisibility V>
class BlockAnswers final : public BlockQuestions {
 public:
    BlockAnswers(const V& visibility, const SoaView<const Hit>& luxels, InstructionSet set)
        : visibility_(visibility), block_(visibility.block(luxels, set)) {}

    void visible_block(Vec3 origin, BlockMask& mask) const override {
        visibility_.visible_block(block_, origin, mask);
    }

 private:
    const V& visibility_;
    typename V::Block block_;
};

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
    [[nodiscard]] virtual bool answers_blocks() const = 0;
    /// Null where it does not.
    [[nodiscard]] virtual std::unique_ptr<const BlockQuestions> block(
        const SoaView<const Hit>& luxels, InstructionSet set) const = 0;
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
    [[nodiscard]] bool answers_blocks() const override { return BlockVisibility<V>; }
    [[nodiscard]] std::unique_ptr<const BlockQuestions> block(const SoaView<const Hit>& luxels,
                                                              InstructionSet set) const override {
        if constexpr (BlockVisibility<V>)
            return std::make_unique<BlockAnswers<V>>(visibility_, luxels, set);
        else
            return nullptr;
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

/// Asks an AnyEngine which luxels of a block see a point. Model of BlockVisibility, with the
/// answers of the engine's own; thread-safe. The AnyEngine must outlive it.
struct AnyBlockVisibility : AnyVisibility {
    /// What the engine prepared of a block.
    using Block = std::unique_ptr<const detail::BlockQuestions>;

    /// By the engine's own visibility.
    [[nodiscard]] Block block(const SoaView<const Hit>& luxels, InstructionSet set) const {
        return calls->block(luxels, set);
    }
    /// The answer of the engine's own visibility.
    void visible_block(const Block& block, Vec3 origin, BlockMask& mask) const {
        block->visible_block(origin, mask);
    }
};

static_assert(ShortRayCaster<AnyRayCaster>);
static_assert(PacketVisibility<AnyVisibility>);
static_assert(BlockVisibility<AnyBlockVisibility>);

/// An engine of the host behind virtual calls. Code that takes a compiler long uses it: it is
/// compiled once, not once for each engine. A call answers for a ray, for a packet or for a block
/// of luxels. Const use from any thread; what the engine's handles read must outlive it. Copies
/// share them.
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
    /// Whether the engine's visibility is a BlockVisibility.
    [[nodiscard]] bool answers_blocks() const { return calls_->answers_blocks(); }
    /// Valid as long as this or a copy of it. For engines with answers_blocks() alone.
    [[nodiscard]] AnyBlockVisibility block_visibility() const { return {{calls_.get()}}; }

 private:
    template <RayCaster R, Visibility V>
    AnyEngine(const R& caster, const V& visibility)
        : calls_(std::make_shared<detail::RayAnswers<R, V>>(caster, visibility)) {}

    std::shared_ptr<const detail::RayQuestions> calls_;
};

}  // namespace mir
