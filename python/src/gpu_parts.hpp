// SPDX-License-Identifier: MIT
#pragma once

#include "scene.hpp"
#include "vpls.hpp"

#include <nanobind/nanobind.h>

#include <optional>

namespace mirpy::gpu {

/// True for an array in the memory of a GPU, if the module was built for that.
bool holds(nanobind::handle array);

/// visibility() of arrays of a GPU.
nanobind::object visibility(PyScene& scene, nanobind::handle points, nanobind::handle normals,
                            nanobind::handle targets, nanobind::handle target_normals);
/// reconstruct() of arrays of a GPU.
nanobind::object reconstruct(PyScene& scene, nanobind::handle gbuffer, nanobind::handle vpls,
                             const std::optional<float>& bound);
/// reshade() of arrays of a GPU.
nanobind::object reshade(nanobind::handle gbuffer, nanobind::handle vpls, nanobind::handle bits,
                         const std::optional<float>& bound, float ray_offset);
/// Vpls.on_gpu().
/// @throws mir::Error(unsupported) if the module was built without CUDA.
nanobind::dict copy_of(const PyVpls& vpls, int device);

}  // namespace mirpy::gpu
