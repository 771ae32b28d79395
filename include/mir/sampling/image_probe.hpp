// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/instruction_set.hpp"
#include "mir/sampling/probe_rays.hpp"
#include "mir/shading/contribution.hpp"
#include "mir/shading/luxel_tracer.hpp"
#include "mir/shading/surface_table.hpp"
#include "mir/shading/vpl_shading.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace mir {

/// What a VPL gives to luxels of a probe, added up one by one: in the same order, the same bits on
/// host and device.
struct LitSum {
    double r = 0.0;  ///< W m^-2 sr^-1, of all luxels so far
    double g = 0.0;  ///< the same
    double b = 0.0;  ///< the same

    /// Adds a luxel.
    MIR_HD void add(Rgb radiance) {
        r += radiance.r;
        g += radiance.g;
        b += radiance.b;
    }
    /// Mean over `luxels` luxels, as if the groups that were added stood for all.
    [[nodiscard]] MIR_HD Rgb mean(std::uint32_t luxels, std::size_t groups,
                                  std::size_t added_groups) const {
        const double share =
            1.0 / luxels * (static_cast<double>(groups) / static_cast<double>(added_groups));
        return {static_cast<float>(r * share), static_cast<float>(g * share),
                static_cast<float>(b * share)};
    }
};

/// Estimates what a VPL gives to the image, from a few luxels. That is the quantity that Georgiev
/// and Slusallek, "Simple and robust iterative importance sampling of virtual point lights",
/// Eurographics 2010, decide by. Unbiased over seeds. Owns what it needs of the scene except for
/// what `V` refers to; const use from any thread.
template <Bsdf B, Visibility V>
class ImageProbe {
 public:
    /// Traces the rays. `shading` holds the bound that the geometry terms get.
    /// @throws Error(invalid_argument) when the rays' luxels or aspect are out of range.
    template <RayCaster R>
    ImageProbe(const ProbeRays& rays, const R& caster, const SurfaceTable<B>& surfaces,
               V visibility, VplShading<B> shading = {});

    /// Mean radiance over all luxels from a VPL of 1 W sr^-1 at `place`. Its intensity is not read;
    /// luxels that see nothing count: (1/M') sum_l f_1 G V, sr^-1 m^-2.
    [[nodiscard]] Rgb response(const Vpl& place) const;

    /// Parts of at most sixteen luxels, which are asked together.
    [[nodiscard]] std::size_t parts() const { return groups_.size(); }
    /// An estimate of response() by part `turn`, modulo parts(). Its mean over parts is response().
    [[nodiscard]] Rgb response_of_part(const Vpl& place, std::uint64_t turn) const;

    /// Mean image luminance of a VPL at `place`, W m^-2 sr^-1. Its intensity is `j` (W sr^-1).
    [[nodiscard]] float flux(const Vpl& place, Rgb j) const {
        return luminance(response(place) * j);
    }

    /// Calls f(hit, surface, radiance) for each luxel that `place` lights, in a fixed order. The
    /// radiance is that of 1 W sr^-1, sr^-1 m^-2.
    template <class F>
    void for_each_lit(const Vpl& place, F&& f) const;

    /// M', luxels that see nothing included.
    [[nodiscard]] std::uint32_t luxels() const { return luxels_; }
    /// Luxels that see a surface which reflects; their points and surfaces follow, i < receivers().
    [[nodiscard]] std::uint32_t receivers() const { return filled_; }
    /// Place and normal of receiver i, lifted off its surface.
    [[nodiscard]] const Hit& hit(std::uint32_t i) const {
        return groups_[i / width].hits[i % width];
    }
    /// Surface of receiver i, as the luxel sees it.
    [[nodiscard]] const typename VplShading<B>::Surface& surface(std::uint32_t i) const {
        return groups_[i / width].surfaces[i % width];
    }

 private:
    static constexpr std::uint32_t width = PointPacket::width;

    /// Sixteen luxels, the last group's rest empty.
    struct Group {
        PointPacket points{};
        Hit hits[width];
        typename VplShading<B>::Surface surfaces[width];
    };

    void add(const Hit& hit, const typename VplShading<B>::Surface& surface);
    template <class F>
    void for_each_lit(const Group& group, const Vpl& place, F&& f) const;
    [[nodiscard]] Rgb mean_of(std::span<const Group> groups, const Vpl& place) const;
    [[nodiscard]] std::uint32_t visible(const Group& group, Vec3 from, std::uint32_t mask) const;

    std::vector<Group> groups_;
    std::uint32_t filled_ = 0;
    std::uint32_t luxels_ = 0;
    V visibility_;
    VplShading<B> shading_;
};

template <Bsdf B, Visibility V>
template <RayCaster R>
ImageProbe<B, V>::ImageProbe(const ProbeRays& rays, const R& caster,
                             const SurfaceTable<B>& surfaces, V visibility, VplShading<B> shading)
    : visibility_(visibility), shading_(shading) {
    expects(rays.luxels >= 1 && rays.luxels <= 65536,
            "the luxels of an image probe must be 1 to 65536 (256 are usual)");
    expects(std::isfinite(rays.aspect) && rays.aspect > 0.0f,
            "the aspect ratio of an image probe is not a positive number; pass width / height");
    const Extent cells = rays.cells();
    luxels_ = static_cast<std::uint32_t>(cells.area());
    const LuxelTracer tracer{caster, surfaces.view()};
    for (std::uint32_t i = 0; i < luxels_; ++i) {
        const SeenLuxel seen = tracer(rays(i % cells.width, i / cells.width));
        if (seen.is_background) continue;
        const auto surface = tracer.surface(seen);
        if (shading.reflects(surface)) add(tracer.hit(seen), surface);
    }
}

template <Bsdf B, Visibility V>
void ImageProbe<B, V>::add(const Hit& hit, const typename VplShading<B>::Surface& surface) {
    const std::uint32_t k = filled_++ % width;
    if (k == 0) groups_.emplace_back();
    Group& group = groups_.back();
    group.points.x[k] = hit.position.x;
    group.points.y[k] = hit.position.y;
    group.points.z[k] = hit.position.z;
    group.hits[k] = hit;
    group.surfaces[k] = surface;
}

template <Bsdf B, Visibility V>
std::uint32_t ImageProbe<B, V>::visible(const Group& group, Vec3 from, std::uint32_t mask) const {
    if (mask == 0) return 0;
    if constexpr (PacketVisibility<V>) {
        return visibility_.visible_packet(from, group.points, mask);
    } else {
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < width; ++k)
            if ((mask >> k & 1u) != 0 && visibility_.visible(from, group.hits[k].position))
                seen |= 1u << k;
        return seen;
    }
}

template <Bsdf B, Visibility V>
template <class F>
void ImageProbe<B, V>::for_each_lit(const Group& group, const Vpl& place, F&& f) const {
    const Vpl unit{place.position, place.normal, {1.0f, 1.0f, 1.0f}};
    Rgb shaded[width];
    std::uint32_t reflecting = 0;
    run_with(best_instruction_set(), [&] {
        for (std::uint32_t k = 0; k < width; ++k) {
            if (!faces(group.hits[k], unit)) continue;
            shaded[k] = shading_(group.hits[k], group.surfaces[k], unit);
            if (!is_black(shaded[k])) reflecting |= 1u << k;
        }
    });
    const std::uint32_t lit = visible(group, unit.position, reflecting);
    for (std::uint32_t k = 0; k < width; ++k)
        if ((lit >> k & 1u) != 0) f(group.hits[k], group.surfaces[k], shaded[k]);
}

template <Bsdf B, Visibility V>
template <class F>
void ImageProbe<B, V>::for_each_lit(const Vpl& place, F&& f) const {
    for (const Group& group : groups_) for_each_lit(group, place, f);
}

/// As if the groups stood for all luxels, those included that reflect nothing.
template <Bsdf B, Visibility V>
Rgb ImageProbe<B, V>::mean_of(std::span<const Group> groups, const Vpl& place) const {
    LitSum sum;
    for (const Group& group : groups)
        for_each_lit(group, place,
                     [&](const Hit&, const auto&, Rgb radiance) { sum.add(radiance); });
    return sum.mean(luxels_, groups_.size(), groups.size());
}

template <Bsdf B, Visibility V>
Rgb ImageProbe<B, V>::response(const Vpl& place) const {
    return groups_.empty() ? Rgb{} : mean_of(groups_, place);
}

template <Bsdf B, Visibility V>
Rgb ImageProbe<B, V>::response_of_part(const Vpl& place, std::uint64_t turn) const {
    if (groups_.empty()) return {};
    return mean_of(std::span(groups_).subspan(turn % groups_.size(), 1), place);
}

}  // namespace mir
