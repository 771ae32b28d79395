// SPDX-License-Identifier: MIT
#include "gpu_parts.hpp"
#include "mir/core/error.hpp"

namespace nb = nanobind;

namespace mirpy::gpu {
namespace {

[[noreturn]] void refuse() {
    throw mir::Error(mir::ErrorCode::unsupported,
                     "arrays of a GPU were asked for (this module was built without CUDA); build "
                     "it with -C cmake.define.MIR_PYTHON_PRESET=cuda");
}

}  // namespace

bool holds(nb::handle /*array*/) { return false; }

nb::object visibility(PyScene& /*scene*/, nb::handle /*points*/, nb::handle /*normals*/,
                      nb::handle /*targets*/, nb::handle /*target_normals*/) {
    refuse();
}

nb::object reconstruct(PyScene& /*scene*/, nb::handle /*gbuffer*/, nb::handle /*vpls*/,
                       const std::optional<float>& /*bound*/) {
    refuse();
}

nb::object reshade(nb::handle /*gbuffer*/, nb::handle /*vpls*/, nb::handle /*bits*/,
                   const std::optional<float>& /*bound*/, float /*ray_offset*/) {
    refuse();
}

nb::dict copy_of(const PyVpls& /*vpls*/, int /*device*/) { refuse(); }

}  // namespace mirpy::gpu
