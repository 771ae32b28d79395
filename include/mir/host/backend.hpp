// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/concepts/executor.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace mir::host {

/// Memory of the host as a backend. It copies from any memory equally well, so this is also its
/// host buffer.
template <class T>
class Buffer {
    static_assert(std::is_trivially_copyable_v<T>);

 public:
    /// `size` elements, all zero.
    explicit Buffer(std::size_t size = 0) : elements_(size) {}

    /// The first element; valid until the buffer is assigned to or ends.
    [[nodiscard]] T* data() { return elements_.data(); }
    /// The same to read.
    [[nodiscard]] const T* data() const { return elements_.data(); }
    /// Number of elements.
    [[nodiscard]] std::size_t size() const { return elements_.size(); }
    /// All elements.
    [[nodiscard]] std::span<T> span() { return elements_; }

 private:
    std::vector<T> elements_;
};

/// Work is done when it is given, so every event has passed.
struct Event {
    /// Returns at once.
    void sync() const {}
};

/// Does everything at once, loops on the executor's threads.
template <Executor E>
class Queue {
 public:
    /// `executor` must outlive it.
    explicit Queue(E& executor) : executor_(&executor) {}

    /// Copies all of `from` to the front of `to`.
    /// @throws Error(invalid_argument) when it does not fit.
    template <class T>
    void upload(std::span<const T> from, Buffer<T>& to) {
        expects(from.size() <= to.size(), "a copy is larger than the buffer it goes to");
        std::copy(from.begin(), from.end(), to.data());
    }
    /// Fills `to` from the front of `from`.
    /// @throws Error(invalid_argument) when there is not that much.
    template <class T>
    void download(const Buffer<T>& from, std::span<T> to) {
        expects(to.size() <= from.size(), "a copy is larger than the buffer it comes from");
        std::copy_n(from.data(), to.size(), to.data());
    }
    /// Sets every byte to zero.
    template <class T>
    void clear(Buffer<T>& buffer) {
        if (buffer.size() == 0) return;
        std::memset(static_cast<void*>(buffer.data()), 0, buffer.size() * sizeof(T));
    }
    /// Calls kernel(i) once for each i in [0, n), 256 neighbours on one thread.
    /// @throws What the kernel throws.
    template <class Kernel>
    void for_each(std::uint32_t n, const Kernel& kernel) {
        const std::uint32_t chunks = (n + grain - 1) / grain;
        executor_->for_each(chunks, [&](std::size_t c) {
            const auto first = static_cast<std::uint32_t>(c) * grain;
            const std::uint32_t last = std::min(n, first + grain);
            for (std::uint32_t i = first; i < last; ++i) kernel(i);
        });
    }
    /// Bit i % 32 of words[(i / 32) columns + j] becomes kernel(kernel.row(i), j).
    /// @throws Error(invalid_argument) unless rows is a multiple of 32.
    template <class Kernel>
    void fill_bits(std::uint32_t rows, std::uint32_t columns, const Kernel& kernel,
                   std::uint32_t* words) {
        expects(rows % 32 == 0, "bits are made 32 rows at a time; pad the rows");
        executor_->for_each(rows / 32, [&](std::size_t group) {
            std::uint32_t* out = words + group * columns;
            std::fill_n(out, columns, 0u);
            for (std::uint32_t k = 0; k < 32; ++k) {
                const auto row = kernel.row(static_cast<std::uint32_t>(group) * 32 + k);
                for (std::uint32_t j = 0; j < columns; ++j)
                    out[j] |= static_cast<std::uint32_t>(kernel(row, j)) << k;
            }
        });
    }
    /// Calls kernel(group, i, space) once for each i in [0, n). The lanes of a group are a loop on
    /// one thread.
    template <class Kernel>
    void for_each_group(std::uint32_t n, const Kernel& kernel) {
        executor_->for_each(n, [&](std::size_t i) {
            typename Kernel::Workspace space;
            kernel(LaneGroup{}, static_cast<std::uint32_t>(i), space);
        });
    }
    /// On the calling thread.
    void sort_by_key(std::uint32_t n, std::uint64_t* keys, std::uint32_t* values,
                     Buffer<std::byte>& /*scratch*/) {
        std::vector<std::pair<std::uint64_t, std::uint32_t>> pairs(n);
        for (std::uint32_t i = 0; i < n; ++i) pairs[i] = {keys[i], values[i]};
        std::stable_sort(pairs.begin(), pairs.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::uint32_t i = 0; i < n; ++i) std::tie(keys[i], values[i]) = pairs[i];
    }
    /// On the calling thread.
    void sum_before(std::uint32_t n, const std::uint32_t* from, std::uint32_t* sums,
                    Buffer<std::byte>& /*scratch*/) {
        std::exclusive_scan(from, from + n, sums, 0u);
    }
    /// None is needed.
    [[nodiscard]] std::size_t scratch_bytes(std::uint32_t /*n*/) const { return 0; }
    /// An event that has passed.
    [[nodiscard]] Event record() { return {}; }
    /// Returns at once.
    void wait(const Event&) {}

 private:
    static constexpr std::uint32_t grain = 256;

    E* executor_;
};

/// The host as a Backend, so that every scheduler runs without a GPU.
template <Executor E>
class Backend {
 public:
    static constexpr Space space = Space::host;  ///< buffers lie in host memory
    /// Memory of the backend.
    template <class T>
    using Buffer = host::Buffer<T>;
    /// Memory of the host, which is the same here.
    template <class T>
    using HostBuffer = host::Buffer<T>;
    /// What record() gives.
    using Event = host::Event;
    /// What work is given to.
    using Queue = host::Queue<E>;

    /// `executor` must outlive the backend and what it hands out.
    explicit Backend(E& executor) : executor_(&executor) {}

    /// A queue on the backend's executor.
    [[nodiscard]] Queue queue() const { return Queue(*executor_); }
    /// `size` elements, all zero.
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        return Buffer<T>(size);
    }
    /// `size` elements, all zero.
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return HostBuffer<T>(size);
    }

 private:
    E* executor_;
};

static_assert(mir::Backend<Backend<InlineExecutor>>);

}  // namespace mir::host
