// SPDX-License-Identifier: MIT
#include "luxel_order.hpp"

#include "support/shafts/cluster_order.hpp"

#include <numeric>

namespace mirpaper {
namespace {

using Places = std::vector<mir::LuxelIndex>;  ///< blocked index of the luxel at each place

Places by_rows(const GBuffer& whole) {
    const auto layout = mir::BlockedLayout::of(whole.tiles().front());
    Places places;
    for (std::uint32_t y = 0; y < whole.extent().height; ++y)
        for (std::uint32_t x = 0; x < whole.extent().width; ++x) places.push_back(layout(x, y));
    return places;
}

Places places_of(LuxelOrder order, const GBuffer& whole, Executor& executor) {
    const mir::BlockedLayout layout = mir::BlockedLayout::of(whole.tiles().front());
    if (order == LuxelOrder::squares) {
        Places places(layout.size());
        std::iota(places.begin(), places.end(), 0u);
        return places;
    }
    if (order == LuxelOrder::clusters) return mir::cluster_order(whole.view(0).hits, {}, executor);
    return by_rows(whole);
}

template <class T>
std::vector<std::uint32_t> words_at(const Places& places, std::uint32_t count,
                                    mir::SoaView<const T> from) {
    std::vector<std::uint32_t> words(std::size_t{mir::SoaView<T>::words} * count);
    const mir::SoaView<T> to{words.data(), count};
    for (std::uint32_t i = 0; i < places.size(); ++i) to.store(i, from.load(places[i]));
    return words;
}

}  // namespace

LuxelWords luxels_in(LuxelOrder order, const GBuffer& whole, Executor& executor) {
    const auto view = whole.view(0);
    const Places places = places_of(order, whole, executor);
    const std::uint32_t count = view.size();
    const auto layout = order == LuxelOrder::squares
                            ? std::optional(mir::BlockedLayout::of(whole.tiles().front()))
                            : std::nullopt;
    return {count, layout, words_at<mir::Hit>(places, count, view.hits),
            words_at<GBuffer::Surface>(places, count, view.surfaces)};
}

}  // namespace mirpaper
