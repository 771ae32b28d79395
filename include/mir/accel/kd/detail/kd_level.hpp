// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_subtree.hpp"
#include "mir/core/instruction_set.hpp"

#include <vector>

namespace mir::detail {

/// Fragments that follow each other in memory.
using KdRun = std::span<const KdFragment>;

/// A node of the upper part of a tree while it is being cut. Its fragments lie in several runs.
struct KdWideNode {
    KdCell cell;
    std::uint32_t node = 0;
    std::uint32_t depth = 0;
    std::size_t count = 0;
    std::vector<KdRun> runs;
    KdContent content;
    bool is_whole = false;  ///< no plane is worth its cost

    KdGrid grid;
    KdBorder border;
    KdSplit split;

    void add(KdRun run) {
        if (run.empty()) return;
        runs.push_back(run);
        count += run.size();
    }
};

/// Some runs of one node: what one thread works on at a time. Results of all chunks are joined in
/// their order, so they do not depend on the number of threads.
struct KdChunk {
    static constexpr std::size_t enough = 16384;  ///< fragments

    std::size_t node = 0;
    std::span<const KdRun> runs;
    std::size_t count = 0;
    std::size_t room = 0;  ///< where its results go: `count` places from here

    RawArray<KdBins> bins;  ///< one
    RawArray<std::int32_t> events;
    KdSides sides;
    RawArray<KdFragment> parts_below;  ///< of clipped fragments
    RawArray<KdFragment> parts_above;
    KdContent content_below;
    KdContent content_above;

    void count_bins(const KdGrid& grid) {
        bins.resize(1);
        bins[0].clear(grid.bins);
        run_with(best_instruction_set(), [&] {
            for (const KdRun run : runs) bins[0].count(run, grid);
        });
    }

    void find_events(const KdGrid& grid, const KdBorder& border) {
        events.replace(0);
        for (const KdRun run : runs) collect_events(run, grid, border, events);
    }

    /// Writes both sides of the node's plane to `results`. Those below go to the begin of this
    /// chunk's room and those above to its end.
    void deal(const KdWideNode& cut, const ClipTriangle* triangles, KdFragment* results,
              KdScratch& scratch) {
        run_with(best_instruction_set(), [&] { deal_runs(cut, triangles, results, scratch); });
    }

 private:
    void deal_runs(const KdWideNode& cut, const ClipTriangle* triangles, KdFragment* results,
                   KdScratch& scratch) {
        scratch.arena.replace(count);
        scratch.both.replace(count);
        KdFragment* const below = results + room;
        KdFragment* const above = scratch.arena.data();
        for (const KdRun run : runs) {
            const KdSides dealt =
                deal_fragments(run, cut.split.axis, cut.split.at, below + sides.below,
                               above + sides.above, scratch.both.data() + sides.both);
            sides.below += dealt.below;
            sides.above += dealt.above;
            sides.both += dealt.both;
        }
        std::copy_n(above, sides.above, below + count - sides.above);
        clip({scratch.both.data(), sides.both}, cut, triangles);
        content_below.add({below, sides.below});
        content_above.add({above, sides.above});
    }

    void clip(KdRun both, const KdWideNode& cut, const ClipTriangle* triangles) {
        parts_below.resize(both.size());
        parts_above.resize(both.size());
        KdSides parts;
        clip_straddlers(both, triangles, cut.cell, cut.split, parts, parts_below.data(),
                        parts_above.data());
        parts_below.resize(parts.below);
        parts_above.resize(parts.above);
        content_below.add(parts_below.span());
        content_above.add(parts_above.span());
    }
};

/// Chunks of all nodes. Every run is at most KdChunk::enough long, or a chunk of its own.
inline std::vector<KdChunk> chunks_of(const std::vector<KdWideNode>& nodes) {
    std::vector<KdChunk> chunks;
    std::size_t room = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const std::span<const KdRun> runs = nodes[n].runs;
        for (std::size_t first = 0; first < runs.size();) {
            KdChunk& chunk = chunks.emplace_back();
            chunk.node = n;
            std::size_t last = first;
            while (last < runs.size() && chunk.count < KdChunk::enough)
                chunk.count += runs[last++].size();
            chunk.runs = runs.subspan(first, last - first);
            chunk.room = room;
            room += chunk.count;
            first = last;
        }
    }
    return chunks;
}

}  // namespace mir::detail
