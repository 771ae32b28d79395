// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/kernels/fused.hpp"
#include "mir/kernels/shade_one_vpl.hpp"
#include "mir/kernels/shading_pass.hpp"
#include "mir/kernels/visibility_pass.hpp"
#include "mir/kernels/word_shading.hpp"
#include "mir/shaft/device/backend_shafts.hpp"
#include "timeline.hpp"

#include <chrono>
#include <optional>

namespace mirpaper {

/// How the moments of a backend's queues are noted. This one is for backends that are done when
/// they return; others specialise it.
template <class B>
struct Marks {
    using Clock = std::chrono::steady_clock;
    using Mark = Clock::time_point;

    static Mark mark(typename B::Queue&) { return Clock::now(); }
    static double seconds(const Mark& from, const Mark& to) {
        return std::chrono::duration<double>(to - from).count();
    }
};

/// How much of a run is noted: each mark costs an event.
enum class Detail {
    ends,  ///< the beginning of the first operation and the end of the last download
    all    ///< beginning and end of every operation
};

/// What happened on the queues of a TracingBackend. Read it when all queues are done. One thread.
template <class B>
class Trace {
 public:
    using Mark = typename Marks<B>::Mark;

    explicit Trace(Detail detail) : detail_(detail) {}

    template <class Operation>
    void run(Work work, typename B::Queue& queue, const Operation& operation) {
        if (detail_ == Detail::all || !first_) begin(queue);
        operation();
        if (detail_ == Detail::all || work == Work::download) end(work, queue);
    }

    /// From the first operation to the end of the last download, seconds.
    [[nodiscard]] double seconds() const {
        return first_ && last_ ? Marks<B>::seconds(*first_, *last_) : 0.0;
    }
    [[nodiscard]] StageSeconds stages() const {
        std::vector<Interval> intervals;
        for (const Span& s : spans_)
            intervals.push_back(
                {s.work, Marks<B>::seconds(*first_, s.begin), Marks<B>::seconds(*first_, s.end)});
        return summarise(intervals);
    }

 private:
    struct Span {
        Work work;
        Mark begin;
        Mark end;
    };

    void begin(typename B::Queue& queue) {
        if (!first_) first_.emplace(Marks<B>::mark(queue));
        if (detail_ == Detail::all) open_.emplace(Marks<B>::mark(queue));
    }
    void end(Work work, typename B::Queue& queue) {
        if (detail_ == Detail::all)
            spans_.push_back({work, std::move(*open_), Marks<B>::mark(queue)});
        if (work == Work::download) last_.emplace(Marks<B>::mark(queue));
    }

    Detail detail_;
    std::optional<Mark> first_;
    std::optional<Mark> last_;
    std::optional<Mark> open_;
    std::vector<Span> spans_;
};

/// What a kernel does.
template <class Kernel>
inline constexpr Work work_of = Work::other;
template <class G, class P, class V, class F>
inline constexpr Work work_of<mir::FusedKernel<G, P, V, F>> = Work::fused;
template <class G, class P, class S, class F>
inline constexpr Work work_of<mir::ShadingPass<G, P, S, F>> = Work::shading;
template <class G, class P, class F>
inline constexpr Work work_of<mir::WordShading<G, P, F>> = Work::shading;
template <class G, class P, class F>
inline constexpr Work work_of<mir::ShadeOneVpl<G, P, F>> = Work::shading;
template <class G, class P, class V>
inline constexpr Work work_of<mir::VisibilityPass<G, P, V>> = Work::visibility;
template <>
inline constexpr Work work_of<mir::GroupRecords> = Work::records;
template <>
inline constexpr Work work_of<mir::PageOrder> = Work::order;
template <>
inline constexpr Work work_of<mir::PageWords> = Work::order;
template <>
inline constexpr Work work_of<mir::FacingRecords> = Work::records;
template <class P>
inline constexpr Work work_of<mir::FacingPass<P>> = Work::facing;
template <mir::Space S, class P>
inline constexpr Work work_of<mir::BlockShafts<S, P>> = Work::blocks;
template <mir::Space S, class P>
inline constexpr Work work_of<mir::ClusterShafts<S, P>> = Work::clusters;
template <mir::Space S, class P>
inline constexpr Work work_of<mir::ClusterLists<S, P>> = Work::lists;
template <class P, class V>
inline constexpr Work work_of<mir::OpenSegments<P, V>> = Work::segments;

/// Another backend's queue that notes what it does.
template <mir::Backend B>
class TracingQueue {
 public:
    TracingQueue(const B& backend, Trace<B>& trace) : queue_(backend.queue()), trace_(&trace) {}

    void upload(const auto& from, auto& to) {
        trace_->run(Work::upload, queue_, [&] { queue_.upload(from, to); });
    }
    void download(const auto& from, const auto& to) {
        trace_->run(Work::download, queue_, [&] { queue_.download(from, to); });
    }
    void clear(auto& buffer) {
        trace_->run(Work::other, queue_, [&] { queue_.clear(buffer); });
    }
    template <class Kernel>
    void for_each(std::uint32_t n, const Kernel& kernel) {
        trace_->run(work_of<Kernel>, queue_, [&] { queue_.for_each(n, kernel); });
    }
    template <class Kernel>
    void fill_bits(std::uint32_t rows, std::uint32_t columns, const Kernel& kernel,
                   std::uint32_t* words) {
        trace_->run(work_of<Kernel>, queue_,
                    [&] { queue_.fill_bits(rows, columns, kernel, words); });
    }
    template <class Kernel>
    void for_each_group(std::uint32_t n, const Kernel& kernel) {
        trace_->run(work_of<Kernel>, queue_, [&] { queue_.for_each_group(n, kernel); });
    }
    void sort_by_key(std::uint32_t n, std::uint64_t* keys, std::uint32_t* values, auto& scratch) {
        trace_->run(Work::other, queue_, [&] { queue_.sort_by_key(n, keys, values, scratch); });
    }
    void sum_before(std::uint32_t n, const std::uint32_t* from, std::uint32_t* sums,
                    auto& scratch) {
        trace_->run(Work::other, queue_, [&] { queue_.sum_before(n, from, sums, scratch); });
    }
    [[nodiscard]] std::size_t scratch_bytes(std::uint32_t n) const {
        return queue_.scratch_bytes(n);
    }
    [[nodiscard]] typename B::Event record() { return queue_.record(); }
    void wait(const typename B::Event& event) { queue_.wait(event); }

 private:
    typename B::Queue queue_;
    Trace<B>* trace_;
};

/// Another backend, with a note of every operation: schedulers stay as they are. The trace must
/// outlive the queues.
template <mir::Backend B>
class TracingBackend {
 public:
    static constexpr mir::Space space = B::space;
    template <class T>
    using Buffer = typename B::template Buffer<T>;
    template <class T>
    using HostBuffer = typename B::template HostBuffer<T>;
    using Event = typename B::Event;
    using Queue = TracingQueue<B>;

    TracingBackend(const B& backend, Trace<B>& trace) : backend_(backend), trace_(&trace) {}

    [[nodiscard]] Queue queue() const { return Queue(backend_, *trace_); }
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        return backend_.template buffer<T>(size);
    }
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return backend_.template host_buffer<T>(size);
    }

 private:
    B backend_;
    Trace<B>* trace_;
};

}  // namespace mirpaper
