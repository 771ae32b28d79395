// SPDX-License-Identifier: MIT
#include "luxel_order.hpp"

#include <algorithm>
#include <numeric>

namespace mirpaper {
namespace {

using Places = std::vector<mir::LuxelIndex>;  ///< blocked index of the luxel at each place
constexpr std::uint32_t run = 32;
/// What a right angle between normals is worth against metres: turned luxels see other VPLs.
constexpr float normal_weight = 0.35f;
constexpr int axes = 6;

Places by_rows(const GBuffer& whole) {
    const auto layout = mir::BlockedLayout::of(whole.tiles().front());
    Places places;
    for (std::uint32_t y = 0; y < whole.extent().height; ++y)
        for (std::uint32_t x = 0; x < whole.extent().width; ++x) places.push_back(layout(x, y));
    return places;
}

/// Cuts runs of places in halves along the longest of six axes, until a run of 32 is left.
class Clusters {
 public:
    explicit Clusters(mir::SoaView<const mir::Hit> hits) : hits_(hits) {}

    void cut(mir::LuxelIndex* first, mir::LuxelIndex* last) const {
        const auto count = static_cast<std::uint32_t>(last - first);
        if (count <= run) return;
        const int axis = longest_axis(first, last);
        mir::LuxelIndex* const middle = first + std::size_t{(count / 2 + run - 1) / run} * run;
        if (middle == last) return;
        std::nth_element(first, middle, last, [&](mir::LuxelIndex a, mir::LuxelIndex b) {
            const float at_a = coordinate(a, axis);
            const float at_b = coordinate(b, axis);
            return at_a < at_b || (at_a == at_b && a < b);
        });
        cut(first, middle);
        cut(middle, last);
    }

 private:
    [[nodiscard]] float coordinate(mir::LuxelIndex i, int axis) const {
        const mir::Hit hit = hits_.load(i);
        return axis < 3 ? hit.position[axis] : normal_weight * hit.normal[axis - 3];
    }

    [[nodiscard]] int longest_axis(const mir::LuxelIndex* first,
                                   const mir::LuxelIndex* last) const {
        mir::Bounds positions;
        mir::Bounds normals;
        for (const mir::LuxelIndex* i = first; i != last; ++i) {
            const mir::Hit hit = hits_.load(*i);
            positions.add(hit.position);
            normals.add(normal_weight * hit.normal);
        }
        const mir::Vec3 p = positions.high - positions.low;
        const mir::Vec3 n = normals.high - normals.low;
        const float lengths[axes] = {p.x, p.y, p.z, n.x, n.y, n.z};
        return static_cast<int>(std::max_element(lengths, lengths + axes) - lengths);
    }

    mir::SoaView<const mir::Hit> hits_;
};

Places places_of(LuxelOrder order, const GBuffer& whole) {
    const mir::BlockedLayout layout = mir::BlockedLayout::of(whole.tiles().front());
    if (order == LuxelOrder::squares) {
        Places places(layout.size());
        std::iota(places.begin(), places.end(), 0u);
        return places;
    }
    Places places = by_rows(whole);
    if (order == LuxelOrder::clusters) {
        const Clusters clusters(whole.view(0).hits);
        clusters.cut(places.data(), places.data() + places.size());
    }
    return places;
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

LuxelWords luxels_in(LuxelOrder order, const GBuffer& whole) {
    const auto view = whole.view(0);
    const Places places = places_of(order, whole);
    const std::uint32_t count = view.size();
    return {count, words_at<mir::Hit>(places, count, view.hits),
            words_at<GBuffer::Surface>(places, count, view.surfaces)};
}

}  // namespace mirpaper
