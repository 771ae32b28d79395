// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/space.hpp"
#include "mir/data/tile.hpp"
#include "mir/data/vpl.hpp"

#include <span>
#include <vector>

namespace mir {

/// View of consecutive VPLs; the model of VplSet. Size and elements do not change while it exists.
template <Space S>
struct VplSpan {
    static constexpr Space space = S;  ///< of the memory of the VPLs

    const Vpl* first = nullptr;  ///< may be null when there are none
    std::uint32_t count = 0;     ///< number of VPLs

    /// Number of VPLs.
    [[nodiscard]] MIR_HD std::uint32_t size() const { return count; }
    /// VPL `j` < size(): not checked.
    [[nodiscard]] MIR_HD const Vpl& operator[](VplIndex j) const { return first[j]; }
};

/// The VPLs of a vector, which must outlive the view.
inline VplSpan<Space::host> span_of(const std::vector<Vpl>& vpls) {
    return {vpls.data(), static_cast<std::uint32_t>(vpls.size())};
}

/// The share that one light path has in a geometric VPL.
struct PathVpl {
    VplIndex vpl = 0;         ///< the geometric VPL
    Rgb intensity;            ///< its part of J, W sr^-1; until normalised, as the sampler gave it
    float weight = 1.0f;      ///< recorded states that it stands for
    std::uint8_t bounce = 2;  ///< scattering events up to the camera: 1 direct, 2 one bounce
    std::uint16_t light_group = 0;  ///< group of the light that feeds it
};

/// Owner of geometric VPLs, of the path VPLs of each, and of their origins. They stand in the order
/// of generation, which is the order of every sum.
class VplList {
 public:
    /// Adds a path VPL, which becomes a geometric VPL of its own. `weight` counts recorded states.
    void push_back(const Vpl& vpl, const VplOrigin& origin, std::uint8_t bounce = 2,
                   std::uint16_t light_group = 0, float weight = 1.0f);

    /// Adds a path VPL. It joins the last geometric VPL when that is the same point of the same
    /// side of the surface, else it becomes one of its own (algorithm 2 of the paper).
    void append(const Vpl& vpl, const VplOrigin& origin, std::uint8_t bounce = 2,
                std::uint16_t light_group = 0, float weight = 1.0f);

    /// Makes room for so many path VPLs, each of which may be a geometric one.
    void reserve(std::size_t count) {
        vpls_.reserve(count);
        origins_.reserve(count);
        path_vpls_.reserve(count);
    }

    /// Gives every path VPL a new intensity, in their order; geometric VPLs get the sums. Those
    /// that become black keep their place.
    /// @throws Error(invalid_argument) unless there is one intensity for each path VPL.
    void relight(std::span<const Rgb> intensities);

    /// Number of geometric VPLs, black ones included.
    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(vpls_.size()); }
    /// True when there is no VPL.
    [[nodiscard]] bool empty() const { return vpls_.empty(); }
    /// Geometric VPLs. Valid, as the spans below, until the list changes.
    [[nodiscard]] std::span<const Vpl> vpls() const { return vpls_; }
    /// Where each of vpls() comes from.
    [[nodiscard]] std::span<const VplOrigin> origins() const { return origins_; }
    /// Neighbours share a geometric VPL; several of one bounce and group may.
    [[nodiscard]] std::span<const PathVpl> path_vpls() const { return path_vpls_; }

    /// All VPLs. Valid until the list changes.
    [[nodiscard]] VplSpan<Space::host> span() const { return span_of(vpls_); }

    /// All VPLs at their places, with the intensity of one bounce alone. Black where it has none.
    [[nodiscard]] std::vector<Vpl> bounce(std::uint8_t b) const {
        return only([b](const PathVpl& p) { return p.bounce == b; });
    }

    /// All VPLs at their places, with the intensity of one light group alone.
    [[nodiscard]] std::vector<Vpl> light_group(std::uint16_t group) const {
        return only([group](const PathVpl& p) { return p.light_group == group; });
    }

    /// Largest bounce of any path VPL, 0 for an empty list.
    [[nodiscard]] std::uint8_t max_bounce() const;

 private:
    template <class Wanted>
    [[nodiscard]] std::vector<Vpl> only(const Wanted& wanted) const;

    std::vector<Vpl> vpls_;
    std::vector<VplOrigin> origins_;
    std::vector<PathVpl> path_vpls_;
};

inline void VplList::push_back(const Vpl& vpl, const VplOrigin& origin, std::uint8_t bounce,
                               std::uint16_t light_group, float weight) {
    path_vpls_.push_back({size(), vpl.intensity, weight, bounce, light_group});
    vpls_.push_back(vpl);
    origins_.push_back(origin);
    origins_.back().multiplicity = weight;
}

inline void VplList::append(const Vpl& vpl, const VplOrigin& origin, std::uint8_t bounce,
                            std::uint16_t light_group, float weight) {
    const bool joins =
        !empty() && same_place(origins_.back(), origin) && vpls_.back().normal == vpl.normal;
    if (!joins) return push_back(vpl, origin, bounce, light_group, weight);
    path_vpls_.push_back({size() - 1, vpl.intensity, weight, bounce, light_group});
    vpls_.back().intensity += vpl.intensity;
    origins_.back().multiplicity += weight;
}

inline void VplList::relight(std::span<const Rgb> intensities) {
    expects(intensities.size() == path_vpls_.size(),
            "a list of VPLs was given intensities of another list (each path VPL needs one); give "
            "as many as there are path VPLs");
    for (Vpl& vpl : vpls_) vpl.intensity = {};
    for (std::size_t i = 0; i < path_vpls_.size(); ++i) {
        path_vpls_[i].intensity = intensities[i];
        vpls_[path_vpls_[i].vpl].intensity += intensities[i];
    }
}

template <class Wanted>
std::vector<Vpl> VplList::only(const Wanted& wanted) const {
    std::vector<Vpl> some = vpls_;
    for (Vpl& vpl : some) vpl.intensity = {};
    for (const PathVpl& p : path_vpls_)
        if (wanted(p)) some[p.vpl].intensity += p.intensity;
    return some;
}

inline std::uint8_t VplList::max_bounce() const {
    std::uint8_t largest = 0;
    for (const PathVpl& p : path_vpls_) largest = std::max(largest, p.bounce);
    return largest;
}

}  // namespace mir
