// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/concepts/sampler.hpp"
#include "mir/concepts/scheduler.hpp"
#include "mir/concepts/shading.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/concepts/vpl_set.hpp"

/// The poorest legal model of each concept: it has what the concept names and nothing besides, not
/// even a default constructor or an assignment. A generic function that compiles with these asks
/// for no more than it says. They compute nothing useful and belong in tests, of this library and
/// of code that extends it. All are safe to use from any thread.
namespace mir::archetype {

/// The only way to make an archetype: `Visibility{make}`.
struct Make {};
inline constexpr Make make{};  ///< the one value of Make

/// Base of archetypes that may be passed to kernels: copy construction, no assignment, no default.
class Value {
 public:
    explicit constexpr Value(Make) {}
    constexpr Value(const Value&) = default;
    constexpr Value(Value&&) = default;
    Value& operator=(const Value&) = delete;
    Value& operator=(Value&&) = delete;
    ~Value() = default;
};

/// Base of archetypes that are only ever referred to.
class Pinned {
 public:
    explicit constexpr Pinned(Make) {}
    Pinned(const Pinned&) = delete;
    Pinned& operator=(const Pinned&) = delete;
    ~Pinned() = default;
};

/// Reflects nothing. Never an object itself: a Bsdf is a set of static functions.
struct Bsdf {
    Bsdf() = delete;

    /// One word, which nobody reads.
    struct Params {
        std::uint32_t unused = 0;
    };

    static Rgb eval(const Params&, Vec3, Vec3, Vec3) { return {}; }
    static float pdf(const Params&, Vec3, Vec3, Vec3) { return 0.0f; }
    static BsdfSample sample(const Params&, Vec3, Vec3, Vec2, float) { return {}; }
    static Rgb albedo(const Params&, Vec3, Vec3) { return {}; }
    static bool is_black(const Params&) { return true; }
};

/// Nothing hides anything. Cannot answer packets.
struct Visibility : Value {
    using Value::Value;
    static constexpr Space space = Space::host;

    [[nodiscard]] bool visible(Vec3, Vec3) const { return true; }
};

/// Visibility that lives on a device, for checks that host schedulers refuse it.
struct DeviceVisibility : Value {
    using Value::Value;
    static constexpr Space space = Space::device;

    [[nodiscard]] bool visible(Vec3, Vec3) const { return true; }
};

/// Visibility with the packet face.
struct PacketVisibility : Visibility {
    using Visibility::Visibility;

    [[nodiscard]] std::uint32_t visible_packet(Vec3, const PointPacket&,
                                               std::uint32_t active) const {
        return active;
    }
};

/// Visibility with the block face.
struct BlockVisibility : PacketVisibility {
    using PacketVisibility::PacketVisibility;
    using Block = Pinned;

    [[nodiscard]] Block block(const SoaView<const Hit>&, InstructionSet) const {
        return Block{make};
    }
    void visible_block(const Block&, Vec3, BlockMask&) const {}
};

/// Surface data of Shading and GBuffer. Whoever shades must know it only by reference.
struct Surface : Pinned {
    using Pinned::Pinned;
};

/// Adds the VPL's intensity, unchanged, so that something can be seen in an image.
struct Shading : Value {
    using Value::Value;
    using Surface = archetype::Surface;

    Rgb operator()(const Hit&, const Surface&, const Vpl& vpl) const { return vpl.intensity; }
};

/// Shading that ends at a distance of ten metres.
struct ReachLimitedShading : Shading {
    using Shading::Shading;

    [[nodiscard]] float reach_squared() const { return 100.0f; }
};

/// Shading that looks at surfaces first.
struct SurfaceSelectiveShading : Shading {
    using Shading::Shading;

    [[nodiscard]] bool reflects(const Surface&) const { return true; }
};

/// Becomes a Vpl when asked, and is nothing else.
struct VplReference {
    Rgb intensity;

    // Implicit, because convertible_to asks for it. Above the plane of GBuffer, shining down.
    operator Vpl() const { return {{0, 0, 1}, {0, 0, -1}, intensity}; }
};

/// Two equal VPLs.
struct VplSet : Value {
    using Value::Value;
    static constexpr Space space = Space::host;

    [[nodiscard]] std::uint32_t size() const { return 2; }
    [[nodiscard]] VplReference operator[](VplIndex) const { return {{1.0f, 2.0f, 4.0f}}; }
};

/// One block of luxels at the origin that face +z. Has no planes.
struct GBuffer : Value {
    using Value::Value;
    static constexpr Space space = Space::host;
    using Surface = archetype::Surface;

    [[nodiscard]] std::uint32_t size() const { return 256; }
    [[nodiscard]] Hit hit(LuxelIndex) const { return {{0, 0, 0}, {0, 0, 1}}; }
    [[nodiscard]] Surface surface(LuxelIndex) const { return Surface{make}; }
};

/// An image of one 16 x 16 tile.
class TiledGBuffer : Pinned {
 public:
    using Pinned::Pinned;

    [[nodiscard]] Extent extent() const { return {16, 16}; }
    [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
    [[nodiscard]] GBuffer view(TileIndex) const { return GBuffer{make}; }

 private:
    std::vector<Tile> tiles_{{0, 0, 16, 16}};
};

/// An empty world.
struct RayCaster : Value {
    using Value::Value;

    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray) const { return std::nullopt; }
};

/// Runs loops in reverse, which is as legal as any other order.
struct Executor : Pinned {
    using Pinned::Pinned;

    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        while (n-- > 0) body(n);
    }
    [[nodiscard]] unsigned char concurrency() const { return 1; }
};

/// Writes nothing and cannot be moved out of open().
struct Pipeline : Pinned {
    using Pinned::Pinned;

    void submit(TileIndex) {}
    void finish() {}
};

/// Opens pipelines for any inputs.
struct Scheduler : Pinned {
    using Pinned::Pinned;

    template <class In>
    Pipeline open(const In&, Image<Rgb>&) const {
        return Pipeline{make};
    }
};

/// Places no VPL.
struct Sampler : Pinned {
    using Pinned::Pinned;
    static constexpr Normalisation normalisation = Normalisation::none;

    template <class E>
    [[nodiscard]] VplRecords sample(E&) const {
        return {};
    }
};

}  // namespace mir::archetype
