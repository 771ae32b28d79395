// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"

namespace mir {

/// Elements of the host in a backend's memory. Move only if the backend's buffers are.
template <Backend B, DeviceCopyable T>
class UploadedArray {
 public:
    /// Starts the copy on `queue`; `from` must live until it is done.
    UploadedArray(const B& backend, typename B::Queue& queue, std::span<const T> from)
        : elements_(backend.template buffer<T>(from.size())) {
        if (!from.empty()) queue.upload(from, elements_);
    }

    /// For kernels that follow on the queue.
    [[nodiscard]] const T* data() const { return elements_.data(); }
    /// Number of elements.
    [[nodiscard]] std::size_t size() const { return elements_.size(); }

 private:
    typename B::template Buffer<T> elements_;
};

}  // namespace mir
