// SPDX-License-Identifier: MIT
#pragma once

#include "support/lazy_backend.hpp"

#include <memory>
#include <optional>

namespace mirtest {

/// What a WatchedBackend is asked for.
struct Watch {
    std::optional<std::size_t> failing_allocation = std::nullopt;  ///< counted from 0
    std::optional<std::size_t> failing_operation =
        std::nullopt;  ///< a copy or a kernel, counted from 0
    std::size_t allocations = 0;
    std::size_t operations = 0;
    std::size_t buffers = 0;           ///< that live now
    std::size_t ended_too_soon = 0;    ///< buffers that ended before all work was done
    std::size_t bytes_taken = 0;       ///< by all buffers together
    std::size_t bytes_downloaded = 0;  ///< by all queues together
};

/// A LazyBackend that counts, and in which one thing may fail. Single-threaded.
class WatchedBackend {
 public:
    static constexpr mir::Space space = mir::Space::host;

    template <class T>
    class Buffer : public LazyBackend::Buffer<T> {
     public:
        Buffer(std::size_t size, PutOff& work, Watch& watch)
            : LazyBackend::Buffer<T>(size), end_(&watch, End{&work}) {}

     private:
        struct End {
            PutOff* work;
            void operator()(Watch* watch) const {
                --watch->buffers;
                watch->ended_too_soon += work->is_done() ? 0 : 1;
            }
        };
        std::unique_ptr<Watch, End> end_;
    };
    template <class T>
    using HostBuffer = Buffer<T>;
    using Event = LazyBackend::Event;

    class Queue : public LazyBackend::Queue {
     public:
        Queue(PutOff& work, Watch& watch) : LazyBackend::Queue(work), watch_(&watch) {}

        /// These throw Error(device) when it is the turn of Watch::failing_operation.
        template <class T>
        void upload(std::span<const T> from, Buffer<T>& to) {
            count();
            LazyBackend::Queue::upload(from, to);
        }
        template <class T>
        void download(const Buffer<T>& from, std::span<T> to) {
            count();
            watch_->bytes_downloaded += to.size_bytes();
            LazyBackend::Queue::download(from, to);
        }
        template <class T>
        void clear(Buffer<T>& buffer) {
            count();
            LazyBackend::Queue::clear(buffer);
        }
        template <class Kernel>
        void for_each(std::uint32_t n, const Kernel& kernel) {
            count();
            LazyBackend::Queue::for_each(n, kernel);
        }
        void sort_by_key(std::uint32_t n, std::uint64_t* keys, std::uint32_t* values,
                         Buffer<std::byte>& scratch) {
            count();
            LazyBackend::Queue::sort_by_key(n, keys, values, scratch);
        }
        void sum_before(std::uint32_t n, const std::uint32_t* from, std::uint32_t* sums,
                        Buffer<std::byte>& scratch) {
            count();
            LazyBackend::Queue::sum_before(n, from, sums, scratch);
        }

     private:
        void count() {
            if (watch_->operations++ == watch_->failing_operation)
                throw mir::Error(mir::ErrorCode::device, "work was refused by a test; go on");
        }

        Watch* watch_;
    };

    WatchedBackend(PutOff& work, Watch& watch) : work_(&work), watch_(&watch) {}

    [[nodiscard]] Queue queue() const { return {*work_, *watch_}; }
    /// @throws Error(out_of_memory) when it is the turn of Watch::failing_allocation.
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        if (watch_->allocations++ == watch_->failing_allocation)
            throw mir::Error(mir::ErrorCode::out_of_memory, "memory was refused by a test; go on");
        ++watch_->buffers;
        watch_->bytes_taken += size * sizeof(T);
        return {size, *work_, *watch_};
    }
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return buffer<T>(size);
    }

 private:
    PutOff* work_;
    Watch* watch_;
};

static_assert(mir::Backend<WatchedBackend>);

}  // namespace mirtest
