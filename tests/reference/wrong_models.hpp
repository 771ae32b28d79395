// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/bsdf.hpp"
#include "mir/reference/path_rules.hpp"
#include "mir/shading/lambert.hpp"

#include <cmath>

// Path tracing rules and BSDFs with one mistake each. Tests that accept the right ones must reject
// these.

namespace mirtest {

/// Light that both techniques find counts twice.
struct DoubleCounting : mir::BalanceRules {
    static float mis(float, float) { return 1.0f; }
};

/// Weights that do not add up to one: the other density is taken for its square root.
struct UnevenWeights : mir::BalanceRules {
    static float mis(float own, float other) { return 1.0f / (1.0f + std::sqrt(other) / own); }
};

/// Densities per area are used as densities per solid angle.
struct NoJacobian : mir::BalanceRules {
    static float per_steradian(float per_area, float, float) { return per_area; }
};

/// The Jacobian without the emitter's cosine.
struct NoEmitterCosine : mir::BalanceRules {
    static float per_steradian(float per_area, float d2, float) { return per_area * d2; }
};

/// Paths that survive roulette are not made brighter for those that end.
struct NoCompensation : mir::BalanceRules {
    static mir::Rgb roulette(mir::Rgb throughput, float u) {
        return u < mir::smaller(max_channel(throughput), 1.0f) ? throughput : mir::Rgb{};
    }
};

/// Light is dimmed by the receiver's cosine twice where lamps are sampled.
struct CosineTwice : mir::Lambert {
    static mir::Rgb eval(const Params& p, mir::Vec3 n, mir::Vec3 wi, mir::Vec3 wo) {
        return Lambert::eval(p, n, wi, wo) * (2.0f * glm::dot(n, wi));
    }
};

/// The density of a sample is that of uniform directions.
struct WrongSampleDensity : mir::Lambert {
    static mir::BsdfSample sample(const Params& p, mir::Vec3 n, mir::Vec3 wo, mir::Vec2 u,
                                  float lobe) {
        mir::BsdfSample s = Lambert::sample(p, n, wo, u, lobe);
        s.pdf = 0.5f * mir::inv_pi;
        return s;
    }
};

/// A tenth of all paths is lost.
struct LosesPaths : mir::Lambert {
    static mir::BsdfSample sample(const Params& p, mir::Vec3 n, mir::Vec3 wo, mir::Vec2 u,
                                  float lobe) {
        return lobe < 0.1f ? mir::BsdfSample{} : Lambert::sample(p, n, wo, u, lobe);
    }
};

static_assert(mir::Bsdf<CosineTwice> && mir::Bsdf<WrongSampleDensity> && mir::Bsdf<LosesPaths>);

}  // namespace mirtest
