// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_record.hpp"

namespace mir {

/// What a sampler recorded, and what is left to do to it.
struct SampledVpls {
    VplRecords records;                                 ///< as they come from the sampler
    Normalisation normalisation = Normalisation::none;  ///< none: intensities are final
};

}  // namespace mir
