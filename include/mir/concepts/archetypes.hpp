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

/// The poorest legal model of each concept. It has what the concept names and nothing else, not
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
    /// As `Visibility{make}`: no archetype has a default constructor.
    explicit constexpr Value(Make) {}
    /// The copy that passing by value to a kernel needs.
    constexpr Value(const Value&) = default;
    /// Moves as it copies.
    constexpr Value(Value&&) = default;
    Value& operator=(const Value&) = delete;
    Value& operator=(Value&&) = delete;
    ~Value() = default;
};

/// Base of archetypes that are only ever referred to.
class Pinned {
 public:
    /// Stays where it was made: neither copies nor moves.
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
        std::uint32_t unused = 0;  ///< of no meaning
    };

    /// Black for all directions.
    static Rgb eval(const Params&, Vec3, Vec3, Vec3) { return {}; }
    /// 0 per steradian.
    static float pdf(const Params&, Vec3, Vec3, Vec3) { return 0.0f; }
    /// Always a sample of black weight, which is to be thrown away.
    static BsdfSample sample(const Params&, Vec3, Vec3, Vec2, float) { return {}; }
    /// Black.
    static Rgb albedo(const Params&, Vec3, Vec3) { return {}; }
    /// Always true.
    static bool is_black(const Params&) { return true; }
};

/// Nothing hides anything. Cannot answer packets.
struct Visibility : Value {
    using Value::Value;
    static constexpr Space space = Space::host;  ///< called on the host

    /// Always true.
    [[nodiscard]] bool visible(Vec3, Vec3) const { return true; }
};

/// Visibility that lives on a device, for checks that host schedulers refuse it.
struct DeviceVisibility : Value {
    using Value::Value;
    static constexpr Space space = Space::device;  ///< called on a device only

    /// Always true.
    [[nodiscard]] bool visible(Vec3, Vec3) const { return true; }
};

/// Visibility with the packet interface.
struct PacketVisibility : Visibility {
    using Visibility::Visibility;

    /// Every active point sees the origin: returns `active`.
    [[nodiscard]] std::uint32_t visible_packet(Vec3, const PointPacket&,
                                               std::uint32_t active) const {
        return active;
    }
};

/// Visibility with the block interface.
struct BlockVisibility : PacketVisibility {
    using PacketVisibility::PacketVisibility;
    using Block = Pinned;  ///< what block() finds: nothing

    /// Reads no luxel, so that none need outlive the answer.
    [[nodiscard]] Block block(const SoaView<const Hit>&, InstructionSet) const {
        return Block{make};
    }
    /// Clears no bit.
    void visible_block(const Block&, Vec3, BlockMask&) const {}
};

/// Surface data of Shading and GBuffer. Whoever shades must know it only by reference.
struct Surface : Pinned {
    using Pinned::Pinned;
};

/// Adds the VPL's intensity, unchanged, so that something can be seen in an image.
struct Shading : Value {
    using Value::Value;
    using Surface = archetype::Surface;  ///< data it could read

    /// The number of the VPL's intensity as radiance, W m^-2 sr^-1, for any luxel.
    Rgb operator()(const Hit&, const Surface&, const Vpl& vpl) const { return vpl.intensity; }
};

/// Shading that ends at a distance of ten metres.
struct ReachLimitedShading : Shading {
    using Shading::Shading;

    /// The square of the reach, 100 m^2. The shading itself does not keep to it.
    [[nodiscard]] float reach_squared() const { return 100.0f; }
};

/// Shading that looks at surfaces first.
struct SurfaceSelectiveShading : Shading {
    using Shading::Shading;

    /// Always true.
    [[nodiscard]] bool reflects(const Surface&) const { return true; }
};

/// Shading that may be told the distance.
struct DistanceShading : Shading {
    using Shading::Shading;

    /// 1/d, m^-1, if all lay a metre away.
    [[nodiscard]] static float inverse_distance(Vec3) { return 1.0f; }
    /// Radiance added at any distance. Neither the offset, metres, nor 1/d, m^-1, is read.
    [[nodiscard]] Rgb at_distance(const Hit&, const Surface&, const Vpl& vpl, Vec3, float) const {
        return vpl.intensity;
    }
};

/// Shading that prepares luxels.
struct PreparedShading : Shading {
    using Shading::Shading;
    /// Nothing of the luxel.
    struct Prepared {};

    using Shading::operator();
    /// As of any luxel.
    Rgb operator()(const Prepared&, const Vpl& vpl) const { return vpl.intensity; }
    /// Reads neither.
    [[nodiscard]] Prepared prepared(const Hit&, const Surface&) const { return {}; }
};

/// Becomes a Vpl when asked, and is nothing else.
struct VplReference {
    Rgb intensity;  ///< W sr^-1

    /// 1 m above the plane of GBuffer, shining down.
    // Implicit, because convertible_to asks for it.
    operator Vpl() const { return {{0, 0, 1}, {0, 0, -1}, intensity}; }
};

/// Two equal VPLs.
struct VplSet : Value {
    using Value::Value;
    static constexpr Space space = Space::host;  ///< of host memory

    /// Number of VPLs.
    [[nodiscard]] std::uint32_t size() const { return 2; }
    /// Intensity (1, 2, 4), for any index.
    [[nodiscard]] VplReference operator[](VplIndex) const { return {{1.0f, 2.0f, 4.0f}}; }
};

/// One block of luxels at the origin that face +z. Has no planes.
struct GBuffer : Value {
    using Value::Value;
    static constexpr Space space = Space::host;  ///< of host memory
    using Surface = archetype::Surface;          ///< what Shading reads

    /// Number of luxels: one block without padding.
    [[nodiscard]] std::uint32_t size() const { return 256; }
    /// At the origin, facing +z, for any index.
    [[nodiscard]] Hit hit(LuxelIndex) const { return {{0, 0, 0}, {0, 0, 1}}; }
    /// A Surface that holds nothing.
    [[nodiscard]] Surface surface(LuxelIndex) const { return Surface{make}; }
};

/// An image of one 16 x 16 tile.
class TiledGBuffer : Pinned {
 public:
    using Pinned::Pinned;

    /// 16 x 16 luxels.
    [[nodiscard]] Extent extent() const { return {16, 16}; }
    /// The one tile, which covers the image. Lives as long as this.
    [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }
    /// The luxels of any tile.
    [[nodiscard]] GBuffer view(TileIndex) const { return GBuffer{make}; }

 private:
    std::vector<Tile> tiles_{{0, 0, 16, 16}};
};

/// An empty world.
struct RayCaster : Value {
    using Value::Value;

    /// Nothing, for any ray.
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(Ray) const { return std::nullopt; }
};

/// Runs loops in reverse, which is as legal as any other order.
struct Executor : Pinned {
    using Pinned::Pinned;

    /// Calls body(n - 1) first and body(0) last, on the calling thread.
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        while (n-- > 0) body(n);
    }
    /// One thread, in a type that is not std::size_t.
    [[nodiscard]] unsigned char concurrency() const { return 1; }
};

/// Writes nothing and cannot be moved out of open().
struct Pipeline : Pinned {
    using Pinned::Pinned;

    /// Leaves the tile's pixels as they were.
    void submit(TileIndex) {}
    /// There is nothing to wait for.
    void finish() {}
};

/// Opens pipelines for any inputs.
struct Scheduler : Pinned {
    using Pinned::Pinned;

    /// Looks at neither the inputs nor the image, so that neither need outlive the pipeline.
    template <class In>
    Pipeline open(const In&, Image<Rgb>&) const {
        return Pipeline{make};
    }
};

/// Places no VPL.
struct Sampler : Pinned {
    using Pinned::Pinned;
    static constexpr Normalisation normalisation =
        Normalisation::none;  ///< intensities would be ready to use

    /// No records, for any executor.
    template <class E>
    [[nodiscard]] VplRecords sample(E&) const {
        return {};
    }
};

}  // namespace mir::archetype
