// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/host/backend.hpp"

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <vector>

namespace mirtest {

/// What a LazyBackend put off: a list of operations per queue. Operations happen when somebody
/// waits for them and not before, so that whoever forgets to wait reads what is not there.
class PutOff {
 public:
    /// Queues whose bit is set in `eager` work at once, as far as events let them; those behind the
    /// 32nd never do.
    explicit PutOff(std::uint32_t eager) : eager_(eager) {}

    std::size_t add_queue() {
        queues_.emplace_back();
        return queues_.size() - 1;
    }
    void add(std::size_t queue, std::function<void()> operation) {
        queues_[queue].operations.push_back(std::move(operation));
        if (queue < 32 && (eager_ >> queue & 1u) != 0) run(queue, size(queue));
    }
    [[nodiscard]] std::size_t size(std::size_t queue) const {
        return queues_[queue].operations.size();
    }

    /// Whether no operation of any queue is left.
    [[nodiscard]] bool is_done() const {
        return std::all_of(queues_.begin(), queues_.end(),
                           [](const Operations& q) { return q.done == q.operations.size(); });
    }

    /// Does the first `count` operations of a queue, those that were not done yet.
    void run(std::size_t queue, std::size_t count) {
        while (queues_[queue].done < count) {
            const auto operation = queues_[queue].operations[queues_[queue].done++];
            operation();
        }
    }

 private:
    struct Operations {
        std::vector<std::function<void()>> operations;
        std::size_t done = 0;
    };

    std::uint32_t eager_;
    std::vector<Operations> queues_;
};

/// The host as a Backend that is as late as its events allow, single-threaded. New memory is full
/// of ones, which no result is.
class LazyBackend {
 public:
    static constexpr mir::Space space = mir::Space::host;

    template <class T>
    class Buffer : public mir::host::Buffer<T> {
     public:
        explicit Buffer(std::size_t size) : mir::host::Buffer<T>(size) {
            if (size > 0) std::memset(static_cast<void*>(this->data()), 0xFF, size * sizeof(T));
        }
    };
    template <class T>
    using HostBuffer = Buffer<T>;

    struct Event {
        PutOff* work;
        std::size_t queue;
        std::size_t count;

        void sync() const { work->run(queue, count); }
    };

    class Queue {
     public:
        explicit Queue(PutOff& work) : work_(&work), index_(work.add_queue()) {}
        Queue(const Queue&) = delete;
        Queue& operator=(const Queue&) = delete;
        ~Queue() { work_->run(index_, work_->size(index_)); }

        template <class T>
        void upload(std::span<const T> from, Buffer<T>& to) {
            later([from, out = to.data()] { std::copy(from.begin(), from.end(), out); });
        }
        template <class T>
        void download(const Buffer<T>& from, std::span<T> to) {
            later([in = from.data(), to] { std::copy_n(in, to.size(), to.data()); });
        }
        template <class T>
        void clear(Buffer<T>& buffer) {
            later([out = static_cast<void*>(buffer.data()), bytes = buffer.size() * sizeof(T)] {
                if (bytes > 0) std::memset(out, 0, bytes);
            });
        }
        template <class Kernel>
        void for_each(std::uint32_t n, const Kernel& kernel) {
            later([n, kernel] { at_once().for_each(n, kernel); });
        }
        template <class Kernel>
        void fill_bits(std::uint32_t rows, std::uint32_t columns, const Kernel& kernel,
                       std::uint32_t* words) {
            later([=] { at_once().fill_bits(rows, columns, kernel, words); });
        }
        template <class Kernel>
        void for_each_group(std::uint32_t n, const Kernel& kernel) {
            later([n, kernel] { at_once().for_each_group(n, kernel); });
        }
        void sort_by_key(std::uint32_t n, std::uint64_t* keys, std::uint32_t* values,
                         Buffer<std::byte>& scratch) {
            later([=, &scratch] { at_once().sort_by_key(n, keys, values, scratch); });
        }
        void sum_before(std::uint32_t n, const std::uint32_t* from, std::uint32_t* sums,
                        Buffer<std::byte>& scratch) {
            later([=, &scratch] { at_once().sum_before(n, from, sums, scratch); });
        }
        [[nodiscard]] std::size_t scratch_bytes(std::uint32_t n) const {
            return at_once().scratch_bytes(n);
        }
        [[nodiscard]] Event record() { return {work_, index_, work_->size(index_)}; }
        void wait(const Event& event) {
            later([event] { event.sync(); });
        }

     private:
        static mir::host::Queue<mir::InlineExecutor> at_once() {
            static mir::InlineExecutor executor;
            return mir::host::Queue<mir::InlineExecutor>(executor);
        }
        void later(std::function<void()> operation) { work_->add(index_, std::move(operation)); }

        PutOff* work_;
        std::size_t index_;
    };

    explicit LazyBackend(PutOff& work) : work_(&work) {}

    [[nodiscard]] Queue queue() const { return Queue(*work_); }
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        return Buffer<T>(size);
    }
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return Buffer<T>(size);
    }

 private:
    PutOff* work_;
};

static_assert(mir::Backend<LazyBackend>);

}  // namespace mirtest
