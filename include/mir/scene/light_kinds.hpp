// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/lights/any_source.hpp"
#include "mir/scene/scene.hpp"

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace mir {

/// A kind of light that a Scene lists. What it is there, what samples it, and where it is held.
template <class L, LightSource S, std::vector<L> Scene::*List>
struct LightKind {
    using Light = L;                    ///< as a Scene has it
    using Source = S;                   ///< in the form that is sampled
    static constexpr auto list = List;  ///< member of Scene
};

/// A closed list of kinds.
template <class... Kinds>
struct LightKindList {
    using Source = AnySource<typename Kinds::Source...>;   ///< a light of any kind
    static constexpr std::size_t size = sizeof...(Kinds);  ///< number of kinds
    /// What messages call a light of each kind.
    static constexpr std::array<const char*, size> names{Kinds::Light::kind...};

    /// Calls f(list) with each list of `scene`, in the order of the kinds.
    template <class S, class F>
    static void for_each_list(S& scene, const F& f) {
        (f(scene.*Kinds::list), ...);
    }
    /// Number of the kind whose lights are of type `Light`.
    template <class Light>
    static constexpr std::size_t index_of() {
        std::size_t index = 0;
        static_cast<void>(
            (... || (std::is_same_v<Light, typename Kinds::Light> || (++index, false))));
        return index;
    }
};

/// Lights that a Scene lists, because no mesh makes them. Another kind is one more line; a
/// LightTable counts them in this order.
using ListedLights =
    LightKindList<LightKind<PointLight, PointSource, &Scene::point_lights>,
                  LightKind<SpotLight, SpotSource, &Scene::spot_lights>,
                  LightKind<DirectionalLight, DirectionalSource, &Scene::directional_lights>>;

/// One of them, as kernels read it.
using ListedSource = ListedLights::Source;

/// Calls f(light) with each light that the scene lists.
template <class S, class F>
void for_each_listed_light(S& scene, const F& f) {
    ListedLights::for_each_list(scene, [&f](auto& list) {
        for (auto& light : list) f(light);
    });
}

}  // namespace mir
