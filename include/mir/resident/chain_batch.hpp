// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/metropolis/chain_run.hpp"
#include "mir/metropolis/chain_slices.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace mir {

/// Memory of Markov chains that run on a backend at a time. It also holds what they bring home from
/// one slice of their runs. It must outlive the work given to queues. One thread at a time.
template <Backend B>
class ChainBatch {
 public:
    /// Room for `chains` chains that bring home `most` each.
    /// @throws What the backend throws when it has no memory left.
    ChainBatch(const B& backend, std::uint64_t chains, const SliceExtent& most)
        : memory_(backend.template buffer<ChainMemory>(chains)),
          reports_(backend.template buffer<SliceReport>(chains)),
          records_(backend.template buffer<VplRecord>(chains * most.records)),
          samples_(backend.template buffer<TraceSample>(chains * most.samples)),
          reports_here_(chains),
          records_here_(chains * most.records),
          samples_here_(chains * most.samples) {}

    /// What a chain takes of the backend's memory.
    [[nodiscard]] static std::uint64_t bytes_of_one(const SliceExtent& most) {
        return sizeof(ChainMemory) + sizeof(SliceReport) + most.records * sizeof(VplRecord) +
               most.samples * sizeof(TraceSample);
    }

    /// Most chains that there is room for.
    [[nodiscard]] std::uint32_t chains() const {
        return static_cast<std::uint32_t>(reports_here_.size());
    }

    /// Zeroes what chains may leave empty in a slice. Also what lies between members, which
    /// bring_home() copies too. Before the first kernel.
    void clear(typename B::Queue& queue) {
        queue.clear(reports_);
        queue.clear(records_);
        queue.clear(samples_);
    }

    /// Lets a kernel of at most chains() chains use the memory.
    template <class Walk>
    void lend(ChainSlices<Walk>& slices) {
        slices.memory = memory_.data();
        slices.reports = reports_.data();
        slices.records = records_.data();
        slices.samples = samples_.data();
    }

    /// Waits for a slice and adds to each run what its chain brings. There are as many chains as
    /// runs. Only that is copied, and what chains leave empty that bring less than others. True
    /// when all chains have ended.
    bool bring_home(typename B::Queue& queue, std::span<ChainRun> runs) {
        const auto reports = std::span(reports_here_).first(runs.size());
        queue.download(reports_, reports);
        queue.record().sync();
        std::uint64_t records = 0, samples = 0;
        for (const SliceReport& r : reports) {
            records = std::max(records, r.records);
            samples = std::max(samples, r.samples);
        }
        queue.download(records_, std::span(records_here_).first(records * runs.size()));
        queue.download(samples_, std::span(samples_here_).first(samples * runs.size()));
        queue.record().sync();
        for (std::size_t i = 0; i < runs.size(); ++i) add(i, runs.size(), runs[i]);
        return std::all_of(reports.begin(), reports.end(),
                           [](const SliceReport& r) { return r.has_ended; });
    }

 private:
    template <class T>
    using Buffer = typename B::template Buffer<T>;

    void add(std::size_t i, std::size_t columns, ChainRun& run) const {
        const SliceReport& report = reports_here_[i];
        for (std::uint64_t j = 0; j < report.records; ++j)
            run.records.push_back(records_here_[j * columns + i]);
        for (std::uint64_t j = 0; j < report.samples; ++j)
            run.trace.add(samples_here_[j * columns + i]);
        run.tally = report.tally;
    }

    Buffer<ChainMemory> memory_;
    Buffer<SliceReport> reports_;
    Buffer<VplRecord> records_;
    Buffer<TraceSample> samples_;
    std::vector<SliceReport> reports_here_;
    std::vector<VplRecord> records_here_;
    std::vector<TraceSample> samples_here_;
};

}  // namespace mir
