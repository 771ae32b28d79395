// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <initializer_list>
#include <memory>
#include <utility>

namespace mirpy::gpu {

/// Memory of a GPU that Python holds.
template <class T>
struct Output {
    Output(const mir::cuda::Backend& backend, std::size_t size)
        : device(backend.device()), buffer(backend.buffer<T>(size)) {}
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;
    /// Others may have given work to streams of theirs that still reads it.
    ~Output() {
        mir::cuda::release_on(device, [] { static_cast<void>(cudaDeviceSynchronize()); });
    }

    int device;
    mir::cuda::Buffer<T> buffer;
};

/// An array of `shape` over that memory, for whoever knows DLPack. The work that fills it must be
/// done: any stream may read it.
template <class T>
nanobind::object array_over(std::unique_ptr<Output<T>> output,
                            std::initializer_list<std::size_t> shape) {
    namespace nb = nanobind;
    const int device = output->device;
    T* const first = output->buffer.data();
    const nb::capsule owner(output.release(), [](void* p) noexcept {
        delete static_cast<Output<T>*>(p);  // NOLINT(cppcoreguidelines-owning-memory)
    });
    return nb::cast(nb::ndarray<nb::array_api, T>(first, shape, owner, {}, nb::dtype<T>(),
                                                  nb::device::cuda::value, device));
}

}  // namespace mirpy::gpu
