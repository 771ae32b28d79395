// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/backend.hpp"
#include "strided_floats.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <array>
#include <initializer_list>
#include <string>
#include <vector>

namespace mirpy::gpu {

/// The backend of a GPU, made when it is first asked for. Needs the GIL.
/// @throws mir::Error(no_device) where there is no such GPU.
const mir::cuda::Backend& backend_of(int device);

/// Number of the GPU that an array lies on; -1: of none.
int device_of(nanobind::handle array);

/// The work of one call on a GPU, in a stream of its own, and the arrays that it is lent. To be
/// made and to end with the GIL held.
class Call {
 public:
    using Array = nanobind::ndarray<nanobind::ro>;
    using Shape = std::initializer_list<long>;

    explicit Call(int device) : backend_(backend_of(device)), queue_(backend_.queue()) {}
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;
    /// Waits before the arrays go back.
    ~Call();

    [[nodiscard]] const mir::cuda::Backend& backend() const { return backend_; }
    [[nodiscard]] mir::cuda::Queue& queue() { return queue_; }

    /// An array of the GPU, where its owner keeps it. The stream waits for what that still does
    /// with it.
    /// @throws ArgumentError that calls it `place`, unless it has this shape and so many bits of
    ///         such a kind.
    const Array& lend(nanobind::handle value, const std::string& place, Shape shape,
                      nanobind::dlpack::dtype_code kind, int bits);
    /// Has the first of such errors thrown by finish() if an element is NaN or infinite.
    void check_finite(const StridedFloats& array, const std::array<std::size_t, 3>& sizes,
                      const std::string& place);
    /// Waits for all work, without the GIL.
    /// @throws ArgumentError for an array that did not stand its check; mir::Error(device)
    void finish();

 private:
    struct Check {
        mir::cuda::Buffer<std::uint32_t> mark;
        std::string place;
    };

    const mir::cuda::Backend& backend_;
    std::vector<Array> lent_;
    std::vector<Check> checks_;
    mir::cuda::Queue queue_;
};

/// An array of float32 in the memory of a GPU, as a call is lent it.
class Floats {
 public:
    /// @throws ArgumentError as Call::lend(), for other types than float32.
    Floats(Call& call, nanobind::handle value, const std::string& place, Call::Shape shape);

    /// Of one axis.
    [[nodiscard]] std::size_t size(std::size_t axis) const { return sizes_[axis]; }
    /// For kernels of the call.
    [[nodiscard]] StridedFloats view() const { return view_; }

 private:
    StridedFloats view_;
    std::array<std::size_t, 3> sizes_{1, 1, 1};
};

}  // namespace mirpy::gpu
