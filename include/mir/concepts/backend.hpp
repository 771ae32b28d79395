// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/core/space.hpp"
#include "mir/data/tile.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mir {

/// The poorest kernel: what Backend::Queue::for_each() must accept.
struct NoOpKernel {
    /// Does nothing with the index.
    MIR_HD void operator()(LuxelIndex) const {}
};

/// The poorest bit kernel: what Backend::Queue::fill_bits() must accept.
struct NoBitKernel {
    /// What the kernel wants to know of row i: its index.
    [[nodiscard]] MIR_HD std::uint32_t row(LuxelIndex i) const { return i; }
    /// Always false, a zero bit.
    [[nodiscard]] MIR_HD bool operator()(std::uint32_t /*row*/, std::uint32_t /*column*/) const {
        return false;
    }
};

/// The poorest kernel for groups: what Backend::Queue::for_each_group() must accept.
struct NoOpGroupKernel {
    /// Memory of the group: empty.
    struct Workspace {};
    /// Does nothing with the index.
    MIR_HD void operator()(const LaneGroup&, std::uint32_t /*i*/, Workspace&) const {}
};

/// What reads and writes memory and runs kernels in order. `upload` copies all of `from` to the
/// front of a buffer; `download` fills `to` from the front of one; `clear` sets every byte of a
/// buffer to zero; `for_each(n, kernel)` calls kernel(i) once for each i in [0, n), in any order;
/// `fill_bits(rows, columns, kernel, words)` sets bit i % 32 of words[(i / 32) columns + j] to
/// kernel(kernel.row(i), j), where rows is a multiple of 32; `for_each_group(n, kernel)` calls
/// kernel(group, i, space) once for each i in [0, n), in any order, each by 32 lanes (LaneGroup)
/// with a Kernel::Workspace of their own in fast memory, whose content is undefined;
/// `sort_by_key(n, keys, values, scratch)` puts n pairs into ascending order of their keys, equal
/// keys in the order they had; `sum_before(n, from, sums, scratch)` makes sums[i] the sum of
/// from[0] to from[i - 1], modulo 2^32. Both work in a scratch buffer of at least scratch_bytes(n)
/// bytes, whose contents are lost. Each may return before it is done; what it reads must live until
/// then.
template <class Q, class B>
concept BackendQueue = requires(Q q, const typename B::Event done,
                                typename B::template Buffer<std::uint32_t> buffer,
                                std::span<const std::uint32_t> from, std::span<std::uint32_t> to,
                                std::uint32_t n, std::uint32_t* words, std::uint64_t* keys,
                                typename B::template Buffer<std::byte> scratch) {
    q.upload(from, buffer);
    q.download(buffer, to);
    q.clear(buffer);
    q.for_each(n, NoOpKernel{});
    q.fill_bits(n, n, NoBitKernel{}, words);
    q.for_each_group(n, NoOpGroupKernel{});
    q.sort_by_key(n, keys, words, scratch);
    q.sum_before(n, words, words, scratch);
    { q.scratch_bytes(n) } -> std::same_as<std::size_t>;
    { q.record() } -> std::same_as<typename B::Event>;
    q.wait(done);
    done.sync();
};

/// A machine that kernels run on. It is a copyable handle that hands out queues, memory of its own
/// and host memory from which copies are fastest. It knows nothing about VPLs.
///
/// Axioms (tests/conformance/backend_suite.hpp):
///  1. the work of one queue happens in the order in which it was given;
///  2. queue.wait(event) holds back what follows until the event has passed; event.sync() holds
///     back the caller;
///  3. upload, then download, is the identity; clear, then download, brings zeros;
///  4. for_each and for_each_group visit each index once, fill_bits writes each word once;
///  5. a queue that ends waits for its work;
///  6. sort_by_key gives what a stable sort gives, sum_before what adding one by one gives.
template <class B>
concept Backend = std::copy_constructible<B> && BackendQueue<typename B::Queue, B> &&
    requires(const B b, std::size_t n) {
    { B::space } -> std::convertible_to<Space>;
    { b.queue() } -> std::same_as<typename B::Queue>;
    { b.template buffer<std::uint32_t>(n).data() } -> std::same_as<std::uint32_t*>;
    { b.template host_buffer<std::uint32_t>(n).span() } -> std::same_as<std::span<std::uint32_t>>;
};

}  // namespace mir
