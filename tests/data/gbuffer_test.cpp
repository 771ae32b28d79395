// SPDX-License-Identifier: MIT
#include "mir/data/gbuffer.hpp"

#include "mir/data/image.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"

#include <memory>

namespace {

using Buffer = mir::BlockedGBuffer<mir::Lambert::Params>;

/// Allocator that counts, as one that pins memory would be passed.
template <class T>
struct CountingAllocator {
    using value_type = T;
    std::size_t* allocated;

    explicit CountingAllocator(std::size_t* counter) : allocated(counter) {}
    template <class U>
    CountingAllocator(const CountingAllocator<U>& other) : allocated(other.allocated) {}
    T* allocate(std::size_t n) {
        *allocated += n * sizeof(T);
        return std::allocator<T>().allocate(n);
    }
    void deallocate(T* p, std::size_t n) { std::allocator<T>().deallocate(p, n); }
    friend bool operator==(const CountingAllocator&, const CountingAllocator&) = default;
};

}  // namespace

TEST_CASE("A luxel comes back with all its surface data, in its own tile only") {
    Buffer buffer({40, 20}, {16, 16});
    const mir::Hit hit{{1, 2, 3}, {0, 1, 0}};
    const Buffer::Surface surface{{0, 0.6f, 0.8f}, {1, 0, 0}, {4, 5, 6}, {{0.1f, 0.2f, 0.3f}}};
    buffer.store(1, 37, hit, surface);
    const auto found = buffer.view(1).surface(37);
    CHECK(buffer.view(1).hit(37).position == hit.position);
    CHECK(buffer.view(1).hit(37).normal == hit.normal);
    CHECK(found.normal == surface.normal);
    CHECK(found.wo == surface.wo);
    CHECK(found.emission == surface.emission);
    CHECK(found.bsdf.reflectance == surface.bsdf.reflectance);
    std::size_t filled = 0;
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < buffer.view(t).size(); ++i)
            filled += is_empty(buffer.view(t).hit(i)) ? 0 : 1;
    CHECK(filled == 1);
}

TEST_CASE("The words of a tile are those that its view reads, hits before surfaces") {
    Buffer buffer({40, 20}, {16, 16});
    CHECK(buffer.extent() == mir::Extent{40, 20});
    std::size_t words = 0;
    for (mir::TileIndex t = 0; t < buffer.tiles().size(); ++t) {
        const auto view = buffer.view(t);
        const auto hits = buffer.hit_words_of(t);
        const auto surfaces = buffer.surface_words_of(t);
        REQUIRE(hits.data() == view.hits.planes);
        REQUIRE(surfaces.data() == view.surfaces.planes);
        REQUIRE(hits.size() == view.size() * sizeof(mir::Hit) / 4);
        REQUIRE(surfaces.size() == view.size() * sizeof(Buffer::Surface) / 4);
        REQUIRE(surfaces.data() == hits.data() + hits.size());
        words += hits.size() + surfaces.size();
    }
    CHECK(buffer.bytes() == words * 4);
}

TEST_CASE("The allocator of a G-buffer hands out its memory") {
    std::size_t allocated = 0;
    using Alloc = CountingAllocator<std::uint32_t>;
    const mir::BlockedGBuffer<mir::Lambert::Params, Alloc> buffer({16, 16}, {16, 16},
                                                                  Alloc(&allocated));
    CHECK(allocated == buffer.bytes());
    CHECK(allocated > 0);
}

TEST_CASE("A G-buffer without luxels is refused") {
    CHECK_THROWS_AS(Buffer({0, 4}, {16, 16}), mir::Error);
    CHECK_THROWS_AS(Buffer({4, 4}, {16, 0}), mir::Error);
}

TEST_CASE("An image keeps its rows") {
    mir::Image<int> image({3, 2}, 7);
    image(2, 1) = 9;
    CHECK(image.width() == 3);
    CHECK(image.height() == 2);
    CHECK(image.pixels().size() == 6);
    CHECK(image.pixels()[5] == 9);
    CHECK(image(0, 0) == 7);
    CHECK(mir::Image<int>().pixels().empty());
}
