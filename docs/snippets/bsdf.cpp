// SPDX-License-Identifier: MIT
//
// Quoted by docs/extending.md: a reflection model of a user's own.
#include "mir/validation/bsdf.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/validation/bsdf_samples.hpp"
#include "support/catch.hpp"

// region: model
namespace dusty {

/// Lommel-Seeliger reflection, the law of dusty bodies such as the moon:
/// f = w / (4 pi (cos_i + cos_o)), with the single-scattering albedo w in 0..1.
struct LommelSeeliger {
    struct Params {
        mir::Rgb w;
    };

    static mir::Rgb eval(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        if (!(glm::dot(n, wo) > 0.0f)) return {};
        const float sum = glm::dot(n, wi) + glm::dot(n, wo);
        return p.w * (0.25f * mir::inv_pi / mir::larger(sum, 1e-6f));
    }
    static float pdf(const Params&, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        return glm::dot(n, wo) > 0.0f ? mir::cosine_hemisphere_pdf(glm::dot(n, wi)) : 0.0f;
    }
    static mir::BsdfSample sample(const Params& p, mir::Vec3 n, mir::Vec3 wo, mir::Vec2 u, float) {
        const mir::Vec3 wi = mir::Frame::around(n).to_world(mir::square_to_cosine_hemisphere(u));
        return {wi, eval(p, n, wi, wo) * mir::pi, pdf(p, n, wi, wo)};
    }
    static mir::Rgb albedo(const Params& p, mir::Vec3 n, mir::Vec3 wo) {
        const float c = mir::larger(glm::dot(n, wo), 1e-6f);
        return p.w * (0.5f * (1.0f - c * std::log(1.0f + 1.0f / c)));
    }
    static bool is_black(const Params& p) { return mir::is_black(p.w); }
};
static_assert(mir::Bsdf<LommelSeeliger>);

}  // namespace dusty
// endregion: model

// region: params
namespace dusty {

/// Found by mir::SurfaceTable through its second argument.
inline LommelSeeliger::Params material_params(const mir::Material& m, LommelSeeliger) {
    return {m.base_color};
}

}  // namespace dusty
// endregion: params

// region: axioms
TEST_CASE("Lommel-Seeliger keeps the axioms of Bsdf") {
    const std::vector<dusty::LommelSeeliger::Params> list = {
        {{1, 1, 1}}, {{0, 0, 0}}, {{0.2f, 0.5f, 1.0f}}};
    const auto report = mir::validation::check_bsdf<dusty::LommelSeeliger>(list);
    INFO(report.text());
    CHECK(report.passed());
}

// H0, level and seed: see check_bsdf_samples().
TEST_CASE("Lommel-Seeliger samples follow their density", "[statistical]") {
    const auto report =
        mir::validation::check_bsdf_samples<dusty::LommelSeeliger>({{0.2f, 0.5f, 1.0f}}, 0.5f);
    INFO(report.text());
    CHECK(report.passed());
}
// endregion: axioms

TEST_CASE("A scene is reconstructed with Lommel-Seeliger surfaces") {
    using Bsdf = dusty::LommelSeeliger;
    const mirtest::Stage<Bsdf, mirtest::BruteForceScene> stage({32, 32}, {16, 16}, 5);
    mir::InlineExecutor executor;
    // region: shading
    const mir::VplShading<dusty::LommelSeeliger> shading{.bound = 2.0f};
    const mir::Image<mir::Rgb> image =
        mir::reconstruct(mir::sched::CpuBlocks{executor}, stage.gbuffer(), stage.vpls(),
                         stage.visibility(), shading);
    // endregion: shading
    std::size_t lit = 0;
    for (const mir::Rgb& c : image.pixels()) lit += mir::is_black(c) ? 0 : 1;
    CHECK(lit > 100);
}
