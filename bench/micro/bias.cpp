// SPDX-License-Identifier: MIT
// Not a benchmark: bounces gathered from discs against those of the path tracer, for several
// numbers of discs, thresholds and rays: docs/decisions/042. CSV on standard output.
// Arguments: `builtin:NAME` or a scene file, and the numbers of Plan in their order.
#include "scene_study.hpp"

#include <cstdio>
#include <optional>

namespace mirstudy {
namespace {

/// What one row is measured with.
struct Choice {
    std::uint32_t surfels = 16384;
    mir::DiscExtent extent = mir::DiscExtent::piece;
    mir::GatherOptions gather;
};

/// What all rows share.
struct Plan {
    std::uint32_t samples = 2048;  ///< paths per luxel of the reference
    std::uint32_t fewest = 1024;   ///< discs wanted at first
    std::uint32_t sizes = 3;       ///< numbers of discs, each four times the last
    std::uint32_t bounce = 4;      ///< the last one looked at, 2 to 4
    std::uint32_t lamp_samples = 64;
};

const char* name_of(mir::DiscExtent extent) {
    if (extent == mir::DiscExtent::piece) return "piece";
    return extent == mir::DiscExtent::cover ? "cover" : "equal_area";
}

class BiasStudy {
 public:
    BiasStudy(SceneStudy& s, const Plan& plan)
        : s_(s), plan_(plan), truth_(reference(s, plan.samples)) {}

    void run_all() {
        using mir::DiscExtent;
        using mir::StopShape;
        std::printf("scene,discs,extent,rays,shape,threshold,bounce,mean,rms,worst\n");
        for (std::uint32_t i = 0; i < plan_.sizes; ++i) run_exact(i, DiscExtent::piece);
        const std::uint32_t most = plan_.fewest << 2 * (plan_.sizes - 1);
        for (const float threshold : {0.25f, 1.0f, 4.0f, 16.0f, 64.0f})
            run({most, DiscExtent::piece, {.rays = 256, .threshold = threshold}});
        for (const float threshold : {0.25f, 16.0f})
            run({most,
                 DiscExtent::piece,
                 {.rays = 256, .threshold = threshold, .shape = StopShape::sphere}});
        for (const std::uint32_t rays : {16u, 64u, 1024u})
            run({most, DiscExtent::piece, {.rays = rays}});
        for (const auto extent : {DiscExtent::equal_area, DiscExtent::cover})
            for (std::uint32_t i = 0; i < plan_.sizes; ++i) run_exact(i, extent);
    }

 private:
    void run_exact(std::uint32_t size, mir::DiscExtent extent) {
        run({plan_.fewest << 2 * size, extent, {.rays = 256, .threshold = 0.0f}});
    }

    void run(const Choice& c) {
        if (!tree_ || c.surfels != surfels_ || c.extent != extent_) {
            tree_.emplace(make_tree(s_, c.surfels, c.extent));
            bounces_.clear();
            surfels_ = c.surfels;
            extent_ = c.extent;
        }
        // The first reflection knows no rays between discs.
        if (bounces_.empty() || plan_.bounce > 2)
            bounces_ = light_discs(s_, *tree_, c.gather,
                                   {std::uint8_t(plan_.bounce - 1), plan_.lamp_samples});
        for (std::uint32_t b = 2; b <= plan_.bounce; ++b) {
            const TileError e = compare(gather(s_, *tree_, bounces_[b - 2], c.gather),
                                        truth_.bounce(static_cast<std::uint8_t>(b)));
            std::printf("%s,%zu,%s,%u,%s,%g,%u,%.3f,%.3f,%.3f\n", s_.scene.name.c_str(),
                        tree_->surfels().size(), name_of(c.extent), c.gather.rays,
                        c.gather.shape == mir::StopShape::disc ? "disc" : "sphere",
                        double(c.gather.threshold), b, e.mean, e.rms, e.worst);
        }
        std::fflush(stdout);
    }

    SceneStudy& s_;
    Plan plan_;
    mir::ReferenceImage truth_;
    std::optional<mir::SurfelTree> tree_;
    std::vector<std::vector<mir::SurfelRadiance>> bounces_;
    std::uint32_t surfels_ = 0;
    mir::DiscExtent extent_ = mir::DiscExtent::piece;
};

}  // namespace
}  // namespace mirstudy

int main(int argc, char** argv) try {
    const std::string name = argc > 1 ? argv[1] : "builtin:cornell-box";
    const auto number = [&](int i, std::uint32_t usual) {
        return argc > i ? static_cast<std::uint32_t>(std::stoul(argv[i])) : usual;
    };
    mirstudy::Plan plan;
    plan = {number(2, plan.samples), number(3, plan.fewest), number(4, plan.sizes),
            number(5, plan.bounce), number(6, plan.lamp_samples)};
    mir::expects(plan.sizes >= 1 && plan.bounce >= 2 && plan.bounce <= 4,
                 "there must be one size of discs at least, and the last bounce be 2 to 4");
    mirstudy::SceneStudy study(name);
    study.scene.name = mirtool::stem_of(name);
    mirstudy::BiasStudy(study, plan).run_all();
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "micro_bias: %s\n", e.what());
    return 1;
}
