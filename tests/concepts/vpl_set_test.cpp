// SPDX-License-Identifier: MIT
#include "mir/concepts/vpl_set.hpp"

#include "mir/concepts/archetypes.hpp"
#include "mir/data/vpl_list.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;

static_assert(mir::VplSet<archetype::VplSet>);

struct WithoutSize : archetype::VplSet {
    void size();
};
static_assert(!mir::VplSet<WithoutSize>);

struct WideSize : archetype::VplSet {
    [[nodiscard]] std::uint64_t size() const { return 0; }
};
static_assert(!mir::VplSet<WideSize>);

struct ElementsAreNoVpls : archetype::VplSet {
    int operator[](mir::VplIndex) const { return 0; }
};
static_assert(!mir::VplSet<ElementsAreNoVpls>);

struct WithoutSpace : archetype::VplSet {
    struct Nowhere {};
    static constexpr Nowhere space{};
};
static_assert(!mir::VplSet<WithoutSpace>);

struct OwnsMemory : archetype::VplSet {
    std::vector<mir::Vpl> vpls;
};
static_assert(!mir::VplSet<OwnsMemory>);
static_assert(!mir::VplSet<mir::VplList>);

static_assert(mir::VplSet<mir::VplSpan<mir::Space::host>>);
static_assert(mir::VplSet<mir::VplSpan<mir::Space::device>>);

}  // namespace

TEST_CASE("A span of a list shows its VPLs in their order") {
    mir::VplList list;
    for (std::uint32_t i = 0; i < 5; ++i)
        list.push_back({{static_cast<float>(i), 0, 0}, {0, 0, 1}, {1, 1, 1}}, {});
    const auto span = list.span();
    REQUIRE(span.size() == 5);
    for (mir::VplIndex j = 0; j < span.size(); ++j)
        CHECK(span[j].position.x == static_cast<float>(j));
    CHECK(mir::VplSpan<mir::Space::host>{}.size() == 0);
}
