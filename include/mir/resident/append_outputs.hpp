// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "mir/resident/wait_at_end.hpp"

#include <numeric>
#include <span>
#include <vector>

namespace mir {

/// Kernel over items that leave any number of outputs each: how many.
template <class Item>
struct CountOutputs {
    Item item;                        ///< item(i, out) calls out.add(output) for each
    std::uint32_t* counts = nullptr;  ///< written, by item

    /// Item i.
    MIR_HD void operator()(std::uint32_t i) const {
        Counter counter;
        item(i, counter);
        counts[i] = counter.count;
    }

 private:
    struct Counter {
        std::uint32_t count = 0;

        template <class T>
        MIR_HD void add(const T& /*output*/) {
            ++count;
        }
    };
};

/// Kernel over the same items: writes their outputs, one item after the other.
template <class Item, class T>
struct WriteOutputs {
    Item item;                              ///< as in CountOutputs
    const std::uint32_t* places = nullptr;  ///< of each item's first output
    T* outputs = nullptr;                   ///< written

    /// Item i.
    MIR_HD void operator()(std::uint32_t i) const {
        Writer writer{outputs + places[i]};
        item(i, writer);
    }

 private:
    struct Writer {
        T* to;

        MIR_HD void add(const T& output) { *to++ = output; }
    };
};

/// Number of outputs of each item, at home. All work is done when it returns.
/// @throws What the backend throws.
template <Backend B, class Item>
[[nodiscard]] std::vector<std::uint32_t> count_outputs(const B& backend, typename B::Queue& queue,
                                                       std::uint32_t items, const Item& item) {
    auto there = backend.template buffer<std::uint32_t>(items);
    std::vector<std::uint32_t> here(items);
    const WaitAtEnd wait(queue);
    queue.for_each(items, CountOutputs<Item>{item, there.data()});
    queue.download(there, std::span(here));
    queue.record().sync();
    return here;
}

/// Appends the outputs of items 0, 1, ... < `items`, made on a backend. Each item runs twice, to
/// count its outputs and to write them, so that their order is that of the items. Outputs of one
/// call must be fewer than 2^32. All work is done when it returns.
/// @throws What the backend throws.
template <Backend B, class Item, DeviceCopyable T>
void append_outputs(const B& backend, typename B::Queue& queue, std::uint32_t items,
                    const Item& item, std::vector<T>& out) {
    if (items == 0) return;
    std::vector<std::uint32_t> places = count_outputs(backend, queue, items, item);
    const std::uint32_t last = places.back();
    std::exclusive_scan(places.begin(), places.end(), places.begin(), 0u);
    const std::size_t count = std::size_t{places.back()} + last;
    if (count == 0) return;
    const UploadedArray<B, std::uint32_t> places_there(backend, queue, places);
    auto there = backend.template buffer<T>(count);
    const WaitAtEnd wait(queue);
    // What lies between members is copied home too.
    queue.clear(there);
    queue.for_each(items, WriteOutputs<Item, T>{item, places_there.data(), there.data()});
    out.resize(out.size() + count);
    queue.download(there, std::span(out).last(count));
    queue.record().sync();
}

}  // namespace mir
