// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/concepts/executor.hpp"
#include "mir/resident/wait_at_end.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

namespace mir {

/// Kernel over elements: copies them.
template <class T>
struct CopyElements {
    const T* from = nullptr;  ///< read
    T* to = nullptr;          ///< written

    /// Element i.
    MIR_HD void operator()(std::uint32_t i) const { to[i] = from[i]; }
};

namespace detail {

/// Rows on their way from a backend.
template <Backend B, class T>
struct RowsUnderWay {
    RowsUnderWay(const B& backend, std::size_t size)
        : there(backend.template buffer<T>(size)), here(backend.template host_buffer<T>(size)) {}

    typename B::template Buffer<T> there;
    typename B::template HostBuffer<T> here;
    std::size_t first = 0;  ///< row
    std::size_t rows = 0;
    std::optional<typename B::Event> arrived;
};

}  // namespace detail

/// Brings `rows` rows of `width` elements home and calls take(i, row) once for each row i, on the
/// executor's threads. Host memory from which copies are fastest takes longer to get than to fill;
/// so a few MiB of it are used again and again, while rows that arrived are taken. `from` is in the
/// backend's memory. All work is done when it returns.
/// @throws What the backend and `take` throw.
template <Backend B, Executor E, class T, class Take>
void bring_rows(const B& backend, typename B::Queue& queue, E& executor, const T* from,
                std::size_t rows, std::size_t width, const Take& take,
                std::size_t part_bytes = std::size_t{1} << 23) {
    if (rows == 0 || width == 0) return;
    const std::size_t part = std::clamp<std::size_t>(part_bytes / (width * sizeof(T)), 1, rows);
    using Part = detail::RowsUnderWay<B, T>;
    Part parts[2] = {Part(backend, part * width), Part(backend, part * width)};
    const WaitAtEnd wait(queue);
    const auto arrive = [&](Part& p) {
        if (!p.arrived) return;
        p.arrived->sync();
        p.arrived.reset();
        const std::span<const T> here = p.here.span();
        executor.for_each(
            p.rows, [&](std::size_t i) { take(p.first + i, here.subspan(i * width, width)); });
    };
    for (std::size_t first = 0, i = 0; first < rows; first += part, ++i) {
        Part& p = parts[i % 2];
        p.first = first;
        p.rows = std::min(part, rows - first);
        queue.for_each(static_cast<std::uint32_t>(p.rows * width),
                       CopyElements<T>{from + first * width, p.there.data()});
        queue.download(p.there, p.here.span().first(p.rows * width));
        p.arrived.emplace(queue.record());
        arrive(parts[(i + 1) % 2]);
    }
    for (Part& p : parts) arrive(p);
}

}  // namespace mir
