// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/backend.hpp"
#include "mir/host/tbb_executor.hpp"

#include <algorithm>
#include <memory>

namespace mirbench {

/// Bytes of the buffers of a MeteredBackend.
struct MemoryMeter {
    std::size_t now = 0;   ///< of those that live
    std::size_t most = 0;  ///< that lived at a time
};

/// Host memory as a backend that tells how much is taken: structures ask for the same on any.
/// One thread gives it work.
class MeteredBackend {
 public:
    static constexpr mir::Space space = mir::Space::host;

    template <class T>
    class Buffer : public mir::host::Buffer<T> {
     public:
        Buffer(std::size_t size, MemoryMeter& meter)
            : mir::host::Buffer<T>(size), end_(&meter, End{size * sizeof(T)}) {
            meter.now += size * sizeof(T);
            meter.most = std::max(meter.most, meter.now);
        }

     private:
        struct End {
            std::size_t bytes;
            void operator()(MemoryMeter* meter) const { meter->now -= bytes; }
        };
        std::unique_ptr<MemoryMeter, End> end_;
    };
    /// Not the backend's own, so not counted.
    template <class T>
    using HostBuffer = mir::host::Buffer<T>;
    using Event = mir::host::Event;
    using Queue = mir::host::Queue<mir::TbbExecutor>;

    /// Both must outlive the backend and what it hands out.
    MeteredBackend(mir::TbbExecutor& executor, MemoryMeter& meter)
        : executor_(&executor), meter_(&meter) {}

    [[nodiscard]] Queue queue() const { return Queue(*executor_); }
    template <class T>
    [[nodiscard]] Buffer<T> buffer(std::size_t size) const {
        return {size, *meter_};
    }
    template <class T>
    [[nodiscard]] HostBuffer<T> host_buffer(std::size_t size) const {
        return HostBuffer<T>(size);
    }

 private:
    mir::TbbExecutor* executor_;
    MemoryMeter* meter_;
};

static_assert(mir::Backend<MeteredBackend>);

}  // namespace mirbench
