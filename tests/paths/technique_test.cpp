// SPDX-License-Identifier: MIT
#include "mir/paths/technique.hpp"

#include "support/catch.hpp"

using mir::TechniqueTable;
using mirtest::Approx;

TEST_CASE("the density of a path is that of its techniques, weighed by their probabilities") {
    const TechniqueTable whole(2, 9, mir::PathTechniques::bidirectional);
    const TechniqueTable behind = whole.behind_second_vertex();
    mir::PathMeasure m;  // primes, so that no two products are equal
    m.from_eye[2] = 2;
    m.from_eye[3] = 3;
    m.from_eye[4] = 5;
    m.from_light[2] = 7;
    m.from_light[3] = 11;
    m.next_event = 13;
    m.emission = 17;
    const double by_lights[] = {2 * 3 * 5, 2 * 3 * 13, 2 * 11 * 17, 7 * 11 * 17};
    double mixture = 0.0;
    double suffix = 0.0;
    for (std::uint32_t s = 0; s < 4; ++s) {
        mixture += whole.probability_of({4, s}) * by_lights[s];
        suffix += behind.probability_of({4, s}) * by_lights[s] / 2;  // x2 is given
    }
    CHECK(mixture_density(m, 4, whole) == Approx(whole.probability(4) * mixture));
    CHECK(suffix_density(m, 4, behind) == Approx(behind.probability(4) * suffix));
}
