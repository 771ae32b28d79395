// SPDX-License-Identifier: MIT
#include "paper_scene.hpp"

#include "mir/accel/exact/accept_box.hpp"
#include "mir/accel/kd/kd_build.hpp"
#include "mir/core/morton.hpp"
#include "mir/paths/path_world.hpp"
#include "mir/sampling/metropolis_sampler.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/scenes.hpp"

#include <algorithm>

namespace mirpaper {
namespace {

/// States recorded for up to a quarter as many VPLs; rejections make some of them share a point.
constexpr std::uint32_t smallest_pool = 4096;
constexpr std::uint32_t largest_pool = 1u << 20;

/// `count` of the pool's VPLs, as far apart in the chains as they can be.
std::vector<std::uint32_t> evenly_chosen(std::uint32_t count, std::uint32_t of) {
    std::vector<std::uint32_t> chosen(count);
    for (std::uint32_t i = 0; i < count; ++i)
        chosen[i] = static_cast<std::uint32_t>(std::uint64_t{i} * of / count);
    return chosen;
}

void sort_along_morton(std::vector<std::uint32_t>& chosen, const mir::VplList& pool,
                       const mir::Bounds& bounds) {
    const mir::Vec3 size = glm::max(bounds.high - bounds.low, mir::Vec3(1e-20f));
    const auto code = [&](std::uint32_t i) {
        return mir::morton_code((pool.vpls()[i].position - bounds.low) / size);
    };
    std::stable_sort(chosen.begin(), chosen.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return code(a) < code(b); });
}

}  // namespace

PaperScene::PaperScene(const std::string& name, mir::Extent size, const mir::KdTreeOptions& tree,
                       const mir::WideBvhOptions& wide, Executor& executor)
    : name_(name),
      executor_(&executor),
      scene_(mir::builtin::make(name)),
      hash_(mir::SceneHash(scene_).hex()),
      geometry_(scene_),
      tree_(geometry_, tree, executor),
      wide_(wide),
      lights_(scene_, geometry_),
      surfaces_(scene_),
      luxels_(size, size) {
    fill_luxels(executor);
    visible_area_ = mir::visible_area(scene_.cameras.front(), aspect(),
                                      mir::LuxelTracer{caster(), surfaces_.view()});
}

float PaperScene::sigma() const {
    return static_cast<float>(mir::sigma_of(mir::magnitude_of(geometry_.bounds())));
}

float PaperScene::aspect() const {
    const mir::Extent size = luxels_.extent();
    return static_cast<float>(size.width) / static_cast<float>(size.height);
}

void PaperScene::fill_luxels(Executor& executor) {
    mir::fill_gbuffer<Bsdf>(luxels_, 0, camera_rays(), caster(), surfaces_, executor);
}

mir::VplList PaperScene::sample(std::uint32_t states) const {
    using World = mir::PathWorld<Bsdf, mir::KdRayCaster<mir::Space::host>,
                                 mir::KdTreeVisibility<mir::Space::host>>;
    const World world{geometry_,    lights_,
                      surfaces_,    caster(),
                      visibility(), scene_.cameras.front(),
                      aspect(),     shading(states).bound};
    mir::MetropolisOptions options;
    options.states = states;
    options.chains = 256;
    options.stride = 8;          // the places matter here, not their variance
    options.suffix_refresh = 0;  // nor their exact intensity
    options.bootstrap.max_paths = options.bootstrap.min_paths;
    options.bootstrap.relative_error = 1.0;
    return mir::aggregate(mir::MetropolisSampler(world, options).sample(*executor_));
}

const mir::VplList& PaperScene::pool(std::uint32_t at_least) {
    const std::uint64_t wanted = std::max<std::uint64_t>(smallest_pool, 2ull * at_least);
    for (std::uint64_t states = wanted; states <= largest_pool; states *= 2) {
        const auto key = static_cast<std::uint32_t>(states);
        if (!pools_.contains(key)) pools_.emplace(key, sample(key));
        if (pools_.at(key).size() >= at_least) return pools_.at(key);
    }
    throw mir::Error(mir::ErrorCode::unsupported,
                     "the chains found fewer than " + std::to_string(at_least) + " VPLs in '" +
                         name_ + "' (too few paths carry light there); ask for fewer --vpls");
}

const mir::VplList& PaperScene::vpls(std::uint32_t count) {
    mir::VplList& list = vpls_[count];
    if (!list.empty()) return list;
    const mir::VplList& from = pool(count);
    std::vector<std::uint32_t> chosen = evenly_chosen(count, from.size());
    sort_along_morton(chosen, from, geometry_.bounds());
    for (const std::uint32_t i : chosen) list.push_back(from.vpls()[i], from.origins()[i]);
    return list;
}

Shading PaperScene::shading(std::uint32_t vpls) const {
    return {mir::default_bound(visible_area_, vpls)};
}

}  // namespace mirpaper
