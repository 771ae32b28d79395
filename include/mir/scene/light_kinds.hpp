// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/lights/any_source.hpp"
#include "mir/scene/scene.hpp"

namespace mir {

/// A kind of light that a Scene lists: what samples it, and where the scene holds it.
template <LightSource S, auto List>
struct LightKind {
    using Source = S;                   ///< as it is sampled
    static constexpr auto list = List;  ///< member of Scene
};

/// A closed list of kinds.
template <class... Kinds>
struct LightKindList {
    using Source = AnySource<typename Kinds::Source...>;   ///< a light of any kind
    static constexpr std::size_t size = sizeof...(Kinds);  ///< number of kinds

    /// Calls f(list) with each list of `scene`, in the order of the kinds.
    template <class S, class F>
    static void for_each_list(S& scene, const F& f) {
        (f(scene.*Kinds::list), ...);
    }
    /// Number of the kind whose lights are of type `Light`.
    template <class Light>
    static constexpr std::size_t index_of() {
        std::size_t index = 0;
        static_cast<void>((... || (is_kind_of<Light, Kinds>() || (++index, false))));
        return index;
    }

 private:
    template <class Light, class Kind>
    static constexpr bool is_kind_of() {
        return std::is_same_v<decltype(Kind::list), std::vector<Light> Scene::*const>;
    }
};

/// Lights that a Scene lists, because no mesh makes them. Another kind is one more line; a
/// LightTable counts them in this order.
using ListedLights = LightKindList<LightKind<PointSource, &Scene::point_lights>,
                                   LightKind<SpotSource, &Scene::spot_lights>,
                                   LightKind<DirectionalSource, &Scene::directional_lights>>;

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
