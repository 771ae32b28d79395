// SPDX-License-Identifier: MIT
#include "mir/data/soa.hpp"

#include "support/catch.hpp"

#include <string>
#include <vector>

namespace {

struct Particle {
    float x = 0.0f;
    std::uint32_t id = 0;
    std::int32_t charges[3] = {};
    friend bool operator==(const Particle&, const Particle&) = default;
};

Particle numbered(std::uint32_t i) {
    const auto n = static_cast<std::int32_t>(i);
    return {0.5f * static_cast<float>(i), i, {n, -n, 7}};
}

struct Odd {
    char bytes[3];
};
struct Wide {
    double value;
};

static_assert(mir::WordCopyable<Particle> && mir::WordCopyable<float>);
static_assert(!mir::WordCopyable<Odd>);
static_assert(!mir::WordCopyable<Wide>);
static_assert(!mir::WordCopyable<std::string>);
static_assert(mir::DeviceCopyable<mir::SoaView<Particle>>);

template <class View>
concept Stores = requires(View v, Particle p) {
    v.store(0u, p);
};
static_assert(Stores<mir::SoaView<Particle>> && !Stores<mir::SoaView<const Particle>>);

}  // namespace

TEST_CASE("What is stored is loaded again, neighbours untouched") {
    constexpr std::uint32_t count = 33;
    std::vector<std::uint32_t> memory(mir::SoaView<Particle>::words * count);
    const mir::SoaView<Particle> view{memory.data(), count};
    for (std::uint32_t i = 0; i < count; ++i) view.store(i, numbered(i));
    for (std::uint32_t i = 0; i < count; ++i) REQUIRE(view.load(i) == numbered(i));
    view.store(7, numbered(1000));
    for (std::uint32_t i = 0; i < count; ++i) REQUIRE(view.load(i) == numbered(i == 7 ? 1000 : i));
}

TEST_CASE("Word k of element i lies at place k * stride + i") {
    std::vector<std::uint32_t> memory(mir::SoaView<Particle>::words * 4);
    const mir::SoaView<Particle> view{memory.data(), 4};
    view.store(2, {1.0f, 42, {3, 4, 5}});
    CHECK(mir::SoaView<Particle>::words == 5);
    CHECK(memory[0 * 4 + 2] == 0x3f800000u);
    CHECK(memory[1 * 4 + 2] == 42u);
    CHECK(memory[4 * 4 + 2] == 5u);
    CHECK(memory[1 * 4 + 1] == 0u);
}

TEST_CASE("A view of const elements reads what another view wrote") {
    std::vector<std::uint32_t> memory(mir::SoaView<Particle>::words * 4);
    mir::SoaView<Particle>{memory.data(), 4}.store(3, numbered(9));
    const mir::SoaView<const Particle> reader{memory.data(), 4};
    CHECK(reader.load(3) == numbered(9));
    CHECK(reader.load(0) == Particle{});
}
