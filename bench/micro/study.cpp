// SPDX-License-Identifier: MIT
// Not a benchmark: what the parts of micro-rendering bring, as ratios of one run, on one thread:
// docs/decisions/043. CSV on standard output. Argument: `builtin:NAME` or a scene file.
#include "scene_study.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace mirstudy {
namespace {

using mir::SphereFit;
using mir::SurfelRay;
using mir::SurfelSplit;
using mir::SurfelTree;

/// Processor time of `slow` divided by that of `fast`, each the least of nine taken in turns.
template <class Slow, class Fast>
double ratio(const Slow& slow, const Fast& fast) {
    const auto time = [](const auto& work, double& least) {
        const std::clock_t begin = std::clock();
        work();
        least = std::min(least, static_cast<double>(std::clock() - begin));
    };
    double a = std::numeric_limits<double>::infinity();
    double b = a;
    for (int i = 0; i < 9; ++i) {
        time(slow, a);
        time(fast, b);
    }
    return a / b;
}

/// Cosine-weighted rays from luxels, `each` from every one; they stop at `threshold` of their own
/// solid angle.
std::vector<SurfelRay> gather_rays(const SceneStudy& s, std::uint32_t each, float threshold) {
    std::vector<SurfelRay> rays;
    const auto luxels = s.gbuffer.view(0);
    const auto layout = mir::BlockedLayout::of(s.gbuffer.tiles()[0]);
    for (std::uint32_t y = 2; y < side; y += 4)
        for (std::uint32_t x = 2; x < side; x += 4) {
            const mir::Hit hit = luxels.hit(layout(x, y));
            if (is_empty(hit)) continue;
            mir::Random random(9, mir::Stream::gather, rays.size());
            for (std::uint32_t k = 0; k < each; ++k) {
                const mir::Vec3 w = mir::square_to_cosine_hemisphere(random.next_2d());
                const float share =
                    threshold * mir::pi / (static_cast<float>(each) * std::max(w.z, 1e-6f));
                rays.push_back(
                    {hit.position, mir::Frame::around(hit.normal).to_world(w), hit.normal, share});
            }
        }
    return rays;
}

void trace(const SurfelTree& tree, std::span<const SurfelRay> rays) {
    // Volatile, so that no search is left out.
    [[maybe_unused]] volatile float found = 0.0f;
    for (const SurfelRay& ray : rays) found = closest_surfel(tree.view(), ray).t;
}

void ask_all(const SurfelTree& tree, std::span<const SurfelRay> rays) {
    [[maybe_unused]] volatile float found = 0.0f;
    for (const SurfelRay& ray : rays) {
        mir::SurfelHit hit;
        for (std::uint32_t i = 0; i < tree.nodes().size(); ++i)
            if (tree.nodes()[i].is_leaf())
                mir::detail::meet_disc(tree.view(), tree.nodes()[i], i, ray, hit);
        found = hit.t;
    }
}

void row(const char* question, const std::string& what, std::size_t discs, double value) {
    std::printf("%s,%s,%zu,%.4g\n", question, what.c_str(), discs, value);
    std::fflush(stdout);
}

double mean_radius(const SurfelTree& tree) {
    double sum = 0.0;
    std::size_t inner = 0;
    for (const mir::SurfelNode& node : tree.nodes()) {
        if (node.is_leaf()) continue;
        sum += double(node.radius);
        ++inner;
    }
    return sum / static_cast<double>(inner);
}

/// Q4, Q6, Q7: the hierarchy against brute force and approximate against exact rays.
void hierarchy(SceneStudy& s) {
    for (const std::uint32_t surfels : {1024u, 4096u, 16384u, 65536u}) {
        const SurfelTree tree = make_tree(s, surfels, mir::DiscExtent::piece);
        const std::size_t n = tree.surfels().size();
        // Few rays for brute force; those of the hierarchy are repeated to take as long.
        const auto few = gather_rays(s, 1, 0.0f);
        row("Q6", "brute force / hierarchy", n,
            16.0 * ratio([&] { ask_all(tree, few); },
                         [&] {
                             for (int i = 0; i < 16; ++i) trace(tree, few);
                         }));
        for (const std::uint32_t rays : {16u, 64u, 256u}) {
            const auto exact = gather_rays(s, rays, 0.0f);
            const auto approximate = gather_rays(s, rays, 1.0f);
            row("Q7", "exact / approximate at " + std::to_string(rays) + " rays", n,
                ratio([&] { trace(tree, exact); }, [&] { trace(tree, approximate); }));
        }
    }
}

/// Q3, Q5: trees and spheres against halves around means.
void trees(SceneStudy& s) {
    const auto tree_of = [&](SurfelSplit split, SphereFit fit) {
        return make_tree(s, 16384, mir::DiscExtent::piece, {.sphere = fit, .split = split});
    };
    const SurfelTree simple = tree_of(SurfelSplit::median, SphereFit::mean);
    const auto compare_with = [&](const char* question, const std::string& name,
                                  const SurfelTree& tree) {
        const std::size_t n = tree.surfels().size();
        row(question, "mean radius: " + name + " / median mean", n,
            mean_radius(tree) / mean_radius(simple));
        for (const float threshold : {0.0f, 1.0f}) {
            const auto rays = gather_rays(s, 64, threshold);
            row(question,
                std::string(threshold > 0.0f ? "approximate" : "exact") + ": median mean / " + name,
                n, ratio([&] { trace(simple, rays); }, [&] { trace(tree, rays); }));
        }
    };
    compare_with("Q3", "orientation mean", tree_of(SurfelSplit::orientation, SphereFit::mean));
    compare_with("Q5", "median ritter", tree_of(SurfelSplit::median, SphereFit::ritter));
    compare_with("Q5", "median smallest", tree_of(SurfelSplit::median, SphereFit::smallest));
    compare_with("Q5", "orientation ritter", tree_of(SurfelSplit::orientation, SphereFit::ritter));
}

/// Q8: D_2 by discs lit with few lamp samples against the same with many.
void lamp_samples(SceneStudy& s) {
    const SurfelTree tree = make_tree(s, 4096, mir::DiscExtent::piece);
    const mir::GatherOptions options{.rays = 64};
    const auto image = [&](std::uint32_t samples) {
        return gather(s, tree, light_discs(s, tree, options, {1, samples}).front(), options);
    };
    const auto truth = image(256);
    for (const std::uint32_t samples : {1u, 4u, 16u, 64u}) {
        const TileError e = compare(image(samples), truth);
        const std::string name = std::to_string(samples) + " lamp samples";
        row("Q8", "mean error (%) of " + name, tree.surfels().size(), e.mean);
        row("Q8", "rms error (%) of " + name, tree.surfels().size(), e.rms);
    }
}

/// Q9: error of pixels when a number of rays is shared by their luxels.
void luxels_of_pixels(SceneStudy& s) {
    const SurfelTree tree = make_tree(s, 16384, mir::DiscExtent::piece);
    const auto radiance = light_discs(s, tree, {.rays = 64}, {1, 64}).front();
    const auto truth = gather(s, tree, radiance, mir::GatherOptions{.rays = 4096, .threshold = 0});
    for (const std::uint32_t rays : {4u, 16u, 64u, 256u}) {
        for (const float threshold : {0.0f, 1.0f}) {
            const mir::GatherOptions options{.rays = rays, .threshold = threshold};
            const TileError e = compare(gather(s, tree, radiance, options), truth);
            row("Q9",
                "rms error (%) of 64 luxels with " + std::to_string(rays) +
                    (threshold > 0.0f ? " approximate rays" : " exact rays"),
                tree.surfels().size(), e.rms);
        }
    }
    for (const std::uint32_t texels : {8u, 16u, 24u}) {
        const mir::BufferGatherOptions options{texels, 1.0f};
        const TileError e = compare(gather(s, tree, radiance, options), truth);
        row("Q9", "rms error (%) of 64 luxels with buffers of side " + std::to_string(texels),
            tree.surfels().size(), e.rms);
    }
}

}  // namespace
}  // namespace mirstudy

int main(int argc, char** argv) try {
    mirstudy::SceneStudy study(argc > 1 ? argv[1] : "builtin:cornell-box");
    std::printf("question,what,discs,value\n");
    mirstudy::hierarchy(study);
    mirstudy::trees(study);
    mirstudy::lamp_samples(study);
    mirstudy::luxels_of_pixels(study);
    return 0;
} catch (const std::exception& e) {
    std::fprintf(stderr, "micro_study: %s\n", e.what());
    return 1;
}
