// SPDX-License-Identifier: MIT
#include "mir/runtime/light_budget.hpp"
#include "render_facts.hpp"
#include "render_output.hpp"

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace mirtool {
namespace {

/// What Metropolis sampling came to: draws of the bootstrap alone, or chains that mutate.
void print_chains(const mir::ChainHealth& h) {
    const auto states = static_cast<unsigned long long>(h.recorded_states);
    if (h.mutations == 0) {
        std::fprintf(stderr,
                     "mir: Metropolis: %llu independent starts drawn from %llu paths, no mutation "
                     "needed\n",
                     states, static_cast<unsigned long long>(h.luminance.paths));
        return;
    }
    std::fprintf(
        stderr,
        "mir: Metropolis: %llu chains, %llu mutations (%.0f %% of the large and %.0f %% of "
        "the other steps accepted), %llu states recorded\n",
        static_cast<unsigned long long>(h.chains), static_cast<unsigned long long>(h.mutations),
        100.0 * h.large.rate(), 100.0 * (h.small.proposed > 0 ? h.small : h.bidirectional).rate(),
        states);
}

void print_health(const mir::ChainHealth& h) {
    print_chains(h);
    std::fprintf(stderr, "mir: P_c %.4g +- %.2g from %llu paths; %llu states worth %.0f",
                 h.luminance.mean, h.luminance.standard_error,
                 static_cast<unsigned long long>(h.luminance.paths),
                 static_cast<unsigned long long>(h.recorded_states), h.effective_samples);
    // Chains that record once say nothing about how they mix.
    if (std::isfinite(h.split_r_hat)) std::fprintf(stderr, ", R-hat %.2f", h.split_r_hat);
    std::fprintf(stderr, "\n");
}

/// "1.2 +- 0.3 %", three digits of what is small.
std::string share_text(double share, std::optional<double> error) {
    char text[64];
    if (error)
        std::snprintf(text, sizeof text, "%.3g +- %.1g %%", 100.0 * share, 100.0 * *error);
    else
        std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
    return text;
}

std::string missing_text(const std::vector<mir::MissingLight>& missing) {
    std::string text;
    for (const mir::MissingLight& m : missing)
        text += (text.empty() ? "" : ", ") + share_text(m.share.share, m.share.standard_error) +
                " by " + m.why;
    return text;
}

void print_light(const mir::RenderResult& r, const mir::RenderSettings& settings) {
    const auto print = [](const std::string& light, const std::string& share,
                          const std::string& bringer, const std::string& missing) {
        std::fprintf(stderr, "mir: %-34s  %-15s  %s%s%s\n", light.c_str(), share.c_str(),
                     bringer.c_str(), missing.empty() ? "" : "; missing of it: ", missing.c_str());
    };
    print("light", "of the picture", "brought by", "");
    for (const mir::LightClass& c : mir::light_budget(r, settings))
        print(c.light, share_text(c.share, c.standard_error), c.brought_by,
              missing_text(c.missing));
    if (const auto& d = r.statistics.gather_difference)
        std::fprintf(stderr,
                     "mir: light of discs against paths: %+.3g +- %.1g %%, spread %.3g %%\n",
                     100.0 * d->mean, 100.0 * d->standard_error, 100.0 * d->spread);
}

/// "sampling 0.28, gbuffer 0.37": the stages that can be seen in hundredths of a second.
std::string stages_of(const mir::StageSeconds& seconds) {
    std::string text;
    for (const mir::RenderStage& stage : mir::render_stages) {
        if (seconds.*stage.seconds < 0.005) continue;
        char took[32];
        std::snprintf(took, sizeof took, " %.2f", seconds.*stage.seconds);
        text += (text.empty() ? "" : ", ") + std::string(stage.name) + took;
    }
    return text.empty() ? "no stage took 0.01 s" : text;
}

}  // namespace

void print_summary(const mir::RenderResult& r, const mir::RenderSettings& settings) {
    const mir::RenderStatistics& s = r.statistics;
    if (s.relative_error)
        std::fprintf(stderr, "mir: %u passes, relative error %.2g %%\n", s.passes,
                     100.0 * *s.relative_error);
    std::fprintf(stderr, "mir: %llu triangles, %llu luxels",
                 static_cast<unsigned long long>(s.triangles),
                 static_cast<unsigned long long>(s.luxels));
    if (s.vpls > 0)
        std::fprintf(stderr, ", %u VPLs from %llu light paths, %s", s.vpls,
                     static_cast<unsigned long long>(s.light_paths), s.scheduler.c_str());
    std::fprintf(stderr, "\nmir: %.2f s (%s)", s.seconds.total, stages_of(s.seconds).c_str());
    if (s.vpls > 0)
        std::fprintf(stderr, ", %.1f M contributions/s", 1e-6 * contributions_per_second(s));
    std::fputc('\n', stderr);
    if (s.health) print_health(*s.health);
    print_light(r, settings);
    for (const std::string& warning : r.warnings)
        std::fprintf(stderr, "mir: warning: %s\n", warning.c_str());
}

}  // namespace mirtool
