// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/settings.hpp"

#include <bit>
#include <cstdint>
#include <type_traits>

namespace mir {

/// Fingerprint of the settings that a picture depends on. All but threads, devices, scheduler,
/// tile and limits. Not cryptographic. Source: FNV-1a, 64 bits, over the values as 64-bit words.
/// Structured bindings name every member, so that a new one cannot be forgotten.
class SettingsHash {
 public:
    /// Reads every setting once.
    explicit SettingsHash(const RenderSettings& settings) {
        const auto& [image, luxels, only_luxel, rows, camera, integrator, path, micro, vpls, sum,
                     picks, sampler, normalisation, prepass, metropolis, roulette, termination,
                     sequence, direct, direct_samples, max_bounce, bound, compensate, caustics,
                     skip_faint, vsl, glossy, filter, seed, threads, backend, devices, acceleration,
                     scheduler, tile, bounce_layers, removed_layer, pick_error_layer,
                     measure_missing, allow_no_light, limits] = settings;
        static_cast<void>(threads), static_cast<void>(devices), static_cast<void>(scheduler);
        static_cast<void>(tile), static_cast<void>(limits);
        add(image.width, image.height, luxels, only_luxel.x, only_luxel.y, camera, integrator, vpls,
            sum, picks, sampler, normalisation, prepass, roulette, termination, sequence, direct,
            direct_samples, max_bounce.value_or(0), bound.kind, bound.value, compensate, caustics,
            skip_faint, filter.kind, filter.half_width, filter.tau, seed, backend, acceleration,
            bounce_layers, removed_layer, pick_error_layer, measure_missing, allow_no_light);
        add(rows.first, rows.count);
        add_vsl(vsl);
        add_glossy(glossy);
        add_path(path);
        add_micro(micro);
        add_metropolis(metropolis);
    }

    /// 64 bits; the same whatever threads, devices, scheduler, tile and limits are.
    [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
    template <class T>
    static std::uint64_t word(T value) {
        if constexpr (std::is_floating_point_v<T>)
            return std::bit_cast<std::uint64_t>(static_cast<double>(value));
        else
            return static_cast<std::uint64_t>(value);
    }
    template <class... T>
    void add(T... values) {
        for (const std::uint64_t w : {word(values)...}) state_ = (state_ ^ w) * 0x100000001b3ull;
    }
    void add_vsl(const VslSettings& settings) {
        const auto& [enabled, samples, scale] = settings;
        add(enabled, samples, scale);
    }
    void add_glossy(const GlossySettings& settings) {
        const auto& [enabled, least_roughness] = settings;
        add(enabled, least_roughness);
    }
    void add_path(const PathSettings& settings) {
        const auto& [samples, light, directions] = settings;
        add(samples, light, directions);
    }
    void add_micro(const MicroSettings& settings) {
        const auto& [surfels, surfel_rays, luxels, gather, side, warp, check] = settings;
        const auto& [rays, directions, threshold, shape] = gather;
        add(surfels, surfel_rays, luxels, rays, directions, threshold, shape, side, warp, check);
    }
    void add_metropolis(const MetropolisTuning& tuning) {
        const auto& [chains, stride, refresh, stop, chain, bootstrap, techniques] = tuning;
        const auto& [mutation, large_steps, tries] = chain;
        const auto& [relative_error, min_paths, max_paths] = bootstrap;
        add(chains, stride, refresh, stop, mutation, large_steps, tries, relative_error, min_paths,
            max_paths, techniques);
    }

    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace mir
