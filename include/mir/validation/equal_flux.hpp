// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/number_text.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/validation/detail/worse.hpp"
#include "mir/validation/report.hpp"

#include <cmath>
#include <vector>

namespace mir::validation {

/// Metropolis instant radiosity's claim: every recorded state brings equal light to the image. Each
/// VPL alone lights the luxels; the luminance that it brings, over the states that it stands for,
/// must be the same for all that any luxel sees, to a relative 1e-3. Source: Segovia, Iehl and
/// Peroche, "Metropolis instant radiosity", 2007. Takes the time of one image.
template <TiledGBuffer G, Visibility V, Shading F, Executor E>
Report check_equal_flux(const G& gbuffer, const VplList& vpls, V visibility, F shading,
                        E& executor) {
    std::vector<double> flux;
    for (VplIndex j = 0; j < vpls.size(); ++j) {
        const VplSpan<Space::host> one{vpls.vpls().data() + j, 1};
        double sum = 0.0;
        const Image<Rgb> image =
            reconstruct(sched::Cpu{executor}, gbuffer, one, visibility, shading);
        for (const Rgb& c : image.pixels()) sum += static_cast<double>(luminance(c));
        if (!(sum <= 0.0))
            flux.push_back(sum / static_cast<double>(vpls.origins()[j].multiplicity));
    }
    double mean = 0.0;
    for (const double f : flux) mean += f / static_cast<double>(flux.size());
    double worst = 0.0;
    for (const double f : flux) worst = detail::worse(worst, std::fabs(f / mean - 1.0));
    Report report;
    report.expect(2 * flux.size() > vpls.size(), "luxels see most of the VPLs",
                  std::to_string(flux.size()) + " of " + std::to_string(vpls.size()));
    report.expect(worst < 1e-3, "every recorded state brings the same light to the image",
                  "one differs from their mean by " + number_text(worst) + " of it");
    return report;
}

}  // namespace mir::validation
