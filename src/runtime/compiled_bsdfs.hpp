// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/gbuffer.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/surface_table.hpp"

#include <utility>
#include <variant>

namespace mir {

/// Models of Bsdf, in the order in which a scene is offered them.
template <Bsdf... Bs>
struct BsdfList {
    /// One of With<B> for each model.
    template <template <class> class With>
    using Variant = std::variant<With<Bs>...>;
};

/// The models that renderers are compiled for. A scene gets the first that suits() it. CMake reads
/// this line too, for what nvcc compiles.
using CompiledBsdfs = BsdfList<Lambert, CookTorrance>;

/// Whether a model shows every material of a scene.
template <Bsdf B>
bool suits(const Scene& /*scene*/, B) {
    return true;
}
/// Three parameters a luxel instead of eight.
inline bool suits(const Scene& scene, Lambert) { return is_lambertian(scene); }

/// The materials of a scene in the parameters of the model that it gets.
using AnySurfaces = CompiledBsdfs::Variant<SurfaceTable>;

namespace detail {
template <Bsdf B, Bsdf... Others>
AnySurfaces first_surfaces(const Scene& scene) {
    if constexpr (sizeof...(Others) > 0)
        if (!suits(scene, B{})) return first_surfaces<Others...>(scene);
    return AnySurfaces(std::in_place_type<SurfaceTable<B>>, scene);
}
template <Bsdf... Bs>
AnySurfaces surfaces_of(const Scene& scene, BsdfList<Bs...>) {
    return first_surfaces<Bs...>(scene);
}
}  // namespace detail

/// Chooses the model for a scene, which must outlive what is returned.
/// @throws Error(invalid_input) as SurfaceTable does.
[[nodiscard]] inline AnySurfaces surfaces_of(const Scene& scene) {
    return detail::surfaces_of(scene, CompiledBsdfs{});
}

/// Luxels whose surfaces are of one model. A view.
template <Bsdf B>
struct LuxelsOf {
    const BlockedGBuffer<typename B::Params>& gbuffer;  ///< in the host's memory
};
/// Luxels of any model.
using AnyLuxels = CompiledBsdfs::Variant<LuxelsOf>;

}  // namespace mir
