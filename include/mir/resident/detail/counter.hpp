// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"

namespace mir::detail {

/// One word of a backend's memory that kernels write and the host reads.
template <Backend B>
class Counter {
 public:
    explicit Counter(const B& backend)
        : there_(backend.template buffer<std::uint32_t>(1)),
          here_(backend.template host_buffer<std::uint32_t>(1)) {}

    [[nodiscard]] std::uint32_t* data() { return there_.data(); }

    /// Makes it `value`, for what follows on the queue, and waits until that is done.
    void set(typename B::Queue& queue, std::uint32_t value) {
        here_.span()[0] = value;
        queue.upload(std::span<const std::uint32_t>(here_.span()), there_);
        queue.record().sync();
    }

    /// What it holds after all work given to the queue, for which this waits.
    /// @throws Error what failed of that work.
    [[nodiscard]] std::uint32_t read(typename B::Queue& queue) {
        queue.download(there_, here_.span());
        queue.record().sync();
        return here_.span()[0];
    }

 private:
    typename B::template Buffer<std::uint32_t> there_;
    typename B::template HostBuffer<std::uint32_t> here_;
};

}  // namespace mir::detail
