// SPDX-License-Identifier: MIT
#include "mir/concepts/gbuffer.hpp"

#include "conformance/gbuffer_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;

static_assert(mir::GBuffer<archetype::GBuffer>);
static_assert(mir::TiledGBuffer<archetype::TiledGBuffer>);

struct WithoutHit : archetype::GBuffer {
    void hit();
};
static_assert(!mir::GBuffer<WithoutHit>);

struct WithoutSurface : archetype::GBuffer {
    void surface();
};
static_assert(!mir::GBuffer<WithoutSurface>);

struct OtherSurface : archetype::GBuffer {
    [[nodiscard]] int surface(mir::LuxelIndex) const { return 0; }
};
static_assert(!mir::GBuffer<OtherSurface>);

struct WithoutSize : archetype::GBuffer {
    void size();
};
static_assert(!mir::GBuffer<WithoutSize>);

struct WithoutSpace : archetype::GBuffer {
    struct Nowhere {};
    static constexpr Nowhere space{};
};
static_assert(!mir::GBuffer<WithoutSpace>);

struct OwnsMemory : archetype::GBuffer {
    std::vector<int> memory;
};
static_assert(!mir::GBuffer<OwnsMemory>);

struct WithoutExtent : archetype::TiledGBuffer {
    void extent();
};
static_assert(!mir::TiledGBuffer<WithoutExtent>);

struct WithoutTiles : archetype::TiledGBuffer {
    void tiles();
};
static_assert(!mir::TiledGBuffer<WithoutTiles>);

struct ViewIsNoGBuffer : archetype::TiledGBuffer {
    [[nodiscard]] int view(mir::TileIndex) const { return 0; }
};
static_assert(!mir::TiledGBuffer<ViewIsNoGBuffer>);

using Lambertian = mir::BlockedGBuffer<mir::Lambert::Params>;
static_assert(mir::TiledGBuffer<Lambertian>);
static_assert(mir::GBuffer<mir::GBufferView<mir::Space::host, mir::Lambert::Params>>);
static_assert(mir::GBuffer<mir::GBufferView<mir::Space::device, mir::CookTorrance::Params>>);

template <class Buffer>
void store(Buffer& buffer, mir::TileIndex t, mir::LuxelIndex i, const mir::Hit& hit) {
    typename Buffer::Surface surface;
    surface.normal = hit.normal;
    surface.emission = {static_cast<float>(i), 0.0f, 1.0f};
    buffer.store(t, i, hit, surface);
}

}  // namespace

TEMPLATE_TEST_CASE("BlockedGBuffer keeps the axioms of GBuffer, ragged edges included", "",
                   mir::Lambert, mir::CookTorrance) {
    using Buffer = mir::BlockedGBuffer<typename TestType::Params>;
    const auto fill = [](auto& buffer, mir::TileIndex t, mir::LuxelIndex i, const mir::Hit& h) {
        store(buffer, t, i, h);
    };
    const auto without_surfaces = [](typename Buffer::View view) {
        view.surfaces.planes = nullptr;
        return view;
    };
    const mir::Extent tile = GENERATE(mir::Extent{48, 32}, mir::Extent{16, 16},
                                      mir::Extent{256, 256}, mir::Extent{7, 5});
    Buffer buffer({100, 70}, tile);
    mirtest::starts_empty(buffer);
    mirtest::padding_is_empty(buffer, fill);
    mirtest::hits_are_read_without_surfaces(buffer, fill, without_surfaces);
}
