// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/concepts/visibility.hpp"
#include "mir/resident/uploaded_array.hpp"
#include "support/segment_ends.hpp"

#include <vector>

namespace mirtest {

/// Bit kernel: do the ends of segment `row` see each other?
template <mir::Visibility V>
struct SegmentSight {
    const SegmentEnds* segments = nullptr;
    V visibility;

    [[nodiscard]] MIR_HD SegmentEnds row(mir::LuxelIndex i) const { return segments[i]; }
    [[nodiscard]] MIR_HD bool operator()(const SegmentEnds& s, std::uint32_t) const {
        return visibility.visible(s.from, s.to);
    }
};

/// Asks `visibility`, one of the backend's space, for a multiple of 32 segments. Bit i % 32 of word
/// i / 32 is set where the ends of segment i see each other.
template <mir::Backend B, mir::Visibility V>
[[nodiscard]] std::vector<std::uint32_t> segment_bits(const B& backend, const V& visibility,
                                                      std::span<const SegmentEnds> segments) {
    std::vector<std::uint32_t> words(segments.size() / 32);
    auto bits = backend.template buffer<std::uint32_t>(words.size());
    auto queue = backend.queue();
    const mir::UploadedArray<B, SegmentEnds> there(backend, queue, segments);
    queue.fill_bits(static_cast<std::uint32_t>(segments.size()), 1,
                    SegmentSight<V>{there.data(), visibility}, bits.data());
    queue.download(bits, std::span(words));
    queue.record().sync();
    return words;
}

}  // namespace mirtest
