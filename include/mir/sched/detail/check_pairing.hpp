// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/concepts/gbuffer.hpp"
#include "mir/concepts/known_visibility.hpp"

namespace mir::sched::detail {

/// The luxels of a tile, as a G-buffer hands them out.
template <class G>
using ViewOf = decltype(std::declval<const G&>().view(TileIndex{}));

/// True when the luxels are already in the device's memory. Nothing has to be copied then.
template <class G, class B>
concept ResidentGBuffer = B::space == Space::device&& ViewOf<G>::space == Space::device;

/// Stops inputs that a scheduler over backend `B` cannot work on, in words.
template <class In, Backend B>
constexpr void check_pairing() {
    using V = decltype(In::visibility);
    using G = std::remove_cvref_t<decltype(std::declval<In>().gbuffer)>;
    static_assert(KnownVisibility<V> || AccessibleFrom<V, B::space>,
                  "mir: this Visibility cannot be traced by the scheduler's backend (its data is "
                  "in other memory); give the backend's own, or use sched::Cpu");
    static_assert(ResidentGBuffer<G, B> || PackedGBuffer<G>,
                  "mir: this scheduler needs a G-buffer in words, such as BlockedGBuffer; use "
                  "sched::Cpu for others");
}

}  // namespace mir::sched::detail
