// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/environment_table.hpp"
#include "mir/scene/light_table_view.hpp"
#include "mir/scene/lights/lamp_table.hpp"
#include "mir/scene/lights/light_tree.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mir {

/// All lights of a scene, ready to be sampled. Immutable; const use from any thread. The Scene and
/// the WorldGeometry must outlive it.
class LightTable {
 public:
    /// @throws Error(invalid_input) for an emission that is negative or not finite. Also when the
    /// power of a light or of all together is no float; and what EnvironmentTable throws.
    LightTable(const Scene& scene, const WorldGeometry& geometry);

    /// True when nothing emits power: sample_light() has no answer.
    [[nodiscard]] bool empty() const { return by_power_.empty(); }
    /// Luminance of the power emitted by everything, W. Directional lights and the environment
    /// count what passes the bounding sphere of the scene, textured lamps the mean of their image
    /// wherever it is seen, masked ones what they would emit if they were whole.
    [[nodiscard]] double power() const { return by_power_.total(); }

    /// Any light, chosen by power, as an index. Emissive triangles come first, then the scene's
    /// lists in the order of ListedLights, then the environment. Must not be empty().
    [[nodiscard]] std::uint32_t sample_light(float u) const { return view().sample_light(u); }
    /// Probability with which sample_light() picks `light`, an index as it counts; sums to 1.
    [[nodiscard]] float light_probability(std::uint32_t light) const {
        return view().light_probability(light);
    }
    /// f(source) of a light, an index as sample_light() counts, as the LightSource that it is.
    template <class F>
    [[nodiscard]] auto visit(std::uint32_t light, const F& f) const {
        return view().visit(geometry_->view(), light, f);
    }

    /// True when emissive triangles exist, so that sample_emitter() may be called.
    [[nodiscard]] bool has_emitters() const { return !lamps_.by_power().empty(); }
    /// Point on an emissive triangle: triangle by power with `u`, point uniform with `uv`.
    [[nodiscard]] EmitterSample sample_emitter(float u, Vec2 uv) const {
        return lamps_.view().sample(geometry_->view(), u, uv);
    }
    /// Density per m^2 with which sample_emitter() picks a point of `triangle`; 0 for others.
    [[nodiscard]] float emitter_pdf(std::uint32_t triangle) const {
        return lamps_.view().pdf(geometry_->view(), triangle);
    }
    /// Index, as sample_light() counts, of an emissive triangle of the WorldGeometry.
    [[nodiscard]] std::optional<std::uint32_t> light_of(std::uint32_t triangle) const {
        const std::uint32_t light = lamps_.view().index_of(triangle);
        if (light == LampView<Space::host>::none) return std::nullopt;
        return light;
    }

    /// Emissive triangles: element i of its triangles() is light i.
    [[nodiscard]] const LampTable& lamps() const { return lamps_; }
    /// What the scene lists.
    [[nodiscard]] std::span<const ListedSource> listed() const { return listed_; }
    /// Light from all around; empty() where the scene has none or a black one.
    [[nodiscard]] const EnvironmentTable& environment() const { return environment_; }
    /// Weights of the lights as sample_light() counts: luminance of their power, W.
    [[nodiscard]] const DiscreteDistribution& by_power() const { return by_power_; }
    /// Chooses lamps by place. Emissive triangles, and point and spot lights if they are many.
    [[nodiscard]] const LightTree& tree() const { return tree_; }
    /// Most point and spot lights that are summed one by one. More of them join the tree.
    static constexpr std::uint32_t most_summed = 16;
    /// Where the emissive triangles are.
    [[nodiscard]] const WorldGeometry& geometry() const { return *geometry_; }
    /// Bounding sphere that light from outside is sent through. Its radius is half the diagonal of
    /// the bounding box; 0 for a scene without vertices.
    [[nodiscard]] BoundingSphere sphere() const {
        return {geometry_->bounds().centre(), 0.5f * geometry_->bounds().diagonal()};
    }

    /// What kernels on the host read; valid until the table is changed or ends.
    [[nodiscard]] LightTableView<Space::host> view() const {
        return {lamps_.view(),    listed_.data(),    static_cast<std::uint32_t>(listed_.size()),
                by_power_.view(), sphere(),          environment_.view(),
                tree_.view(),     is_listed_in_tree_};
    }

 private:
    [[nodiscard]] std::vector<TreeLamp> tree_lamps();

    const WorldGeometry* geometry_;
    LampTable lamps_;
    std::vector<ListedSource> listed_;
    EnvironmentTable environment_;
    DiscreteDistribution by_power_;
    LightTree tree_;
    bool is_listed_in_tree_ = false;
};

inline LightTable::LightTable(const Scene& scene, const WorldGeometry& geometry)
    : geometry_(&geometry), lamps_(scene, geometry) {
    if (scene.environment) environment_ = EnvironmentTable(*scene.environment);
    std::vector<float> power(lamps_.powers().begin(), lamps_.powers().end());
    for_each_listed_light(scene, [&](const auto& light) {
        const auto source = source_of(light, sphere());
        detail::check_emission(source.start({}, 0.0f).emission, light.kind, light.name);
        listed_.push_back(source);
        power.push_back(detail::checked_power(
            source.power(),
            std::string(light.kind) + " " + detail::in_quotes(light.name) + " emits"));
    });
    if (!environment_.empty()) {
        const EnvironmentView<Space::host> around = environment_.view();
        power.push_back(detail::checked_power(
            EnvironmentSource<Space::host>{{sphere()}, around}.power(),
            "environment " + detail::in_quotes(scene.environment->name) + " emits"));
    }
    by_power_ = DiscreteDistribution(power);
    static_cast<void>(detail::checked_power(by_power_.total(), "all lights together emit"));
    tree_ = LightTree(tree_lamps());
}

/// What the tree holds.
inline std::vector<TreeLamp> LightTable::tree_lamps() {
    std::vector<TreeLamp> all;
    const auto add = [&all](const LightBounds& bounds, std::size_t light) {
        if (bounds.power > 0.0) all.push_back({bounds, static_cast<std::uint32_t>(light)});
    };
    const std::size_t triangles = lamps_.triangles().size();
    for (std::size_t i = 0; i < triangles; ++i) add(lamps_.light_bounds(*geometry_, i), i);
    const std::size_t before = all.size();
    for (std::size_t i = 0; i < listed_.size(); ++i)
        listed_[i].visit([&](const auto& source) {
            if constexpr (TreeLight<std::remove_cvref_t<decltype(source)>>)
                add(source.light_bounds(), triangles + i);
        });
    is_listed_in_tree_ = all.size() - before > most_summed;
    if (!is_listed_in_tree_) all.resize(before);
    return all;
}

}  // namespace mir
