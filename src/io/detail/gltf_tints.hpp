// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/scene_report.hpp"
#include "mir/scene/scene.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace mir::detail {

/// Vertex colours where a Scene has no place for them. The emission of unlit materials and the
/// alpha of masks. One that is the same all over a mesh goes into a material of its own, others are
/// counted.
class GltfTints {
 public:
    /// `alpha`: one per vertex, or none where all are 1. Gives `mesh` the material that it needs.
    void apply(bool is_unlit, const std::vector<float>& alpha, Scene& scene, SceneReport& report,
               Mesh& mesh) {
        const Material& plain = scene.materials[mesh.material];
        Rgb tint{1.0f, 1.0f, 1.0f};
        float cut = 1.0f;
        if (is_unlit) tint = common(mesh.colors, tint, "COLOR_0 of an unlit material", report);
        if (plain.is_masked()) cut = common(alpha, cut, "alpha of COLOR_0 in a mask", report);
        // What is unlit reflects nothing that a colour could multiply.
        if (is_unlit) mesh.colors = {};
        if (tint == Rgb{1.0f, 1.0f, 1.0f} && cut == 1.0f) return;
        const auto [at, is_new] =
            known_.try_emplace({mesh.material, tint.r, tint.g, tint.b, cut}, 0u);
        if (is_new) {
            Material tinted = plain;
            tinted.emission = {plain.emission.r * tint.r, plain.emission.g * tint.g,
                               plain.emission.b * tint.b};
            tinted.alpha *= cut;
            at->second = scene.add(std::move(tinted));
        }
        mesh.material = at->second;
    }

 private:
    /// What all values are, `otherwise` when there are none or, counted, when they differ.
    template <class Value>
    static Value common(const std::vector<Value>& values, Value otherwise, const char* what,
                        SceneReport& report) {
        if (values.empty()) return otherwise;
        const Value first = values.front();
        if (std::all_of(values.begin(), values.end(), [&](const Value& v) { return v == first; }))
            return first;
        ++report.ignored[what];
        return otherwise;
    }

    using Key = std::tuple<std::uint32_t, float, float, float, float>;
    std::map<Key, std::uint32_t> known_;
};

}  // namespace mir::detail
