// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/runtime/settings.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// A Backend, and what a renderer wants to know of the machine behind it.
template <Backend M>
struct BackendMachine {
    M backend;                                    ///< where frames are made
    std::string name;                             ///< of the backend, as users write it
    std::string device;                           ///< make of the machine
    std::function<std::uint64_t()> usable_bytes;  ///< free, or kept for the next image
    std::function<void()> trim;                   ///< gives back what is kept
};

/// Opens the machine of a number. May throw.
template <Backend M>
using OpenMachine = std::function<BackendMachine<M>(std::uint32_t number)>;
/// Numbers of the machines that DeviceChoice::all means. May throw.
using UsableMachines = std::function<std::vector<std::uint32_t>()>;

/// The machines of one kind, opened on first use and kept.
/// Thread-safe.
template <Backend M>
class BackendMachines {
 public:
    /// Opens none yet.
    BackendMachines(OpenMachine<M> open, UsableMachines usable)
        : open_(std::move(open)), usable_(std::move(usable)) {}

    /// The machines of a choice, in its order; at least one.
    /// @throws What opening them throws.
    [[nodiscard]] std::vector<BackendMachine<M>> chosen(const DeviceChoice& choice) {
        std::vector<std::uint32_t> numbers = choice.all ? usable_() : choice.numbers;
        if (numbers.empty()) numbers.push_back(0);
        const std::lock_guard lock(mutex_);
        std::vector<BackendMachine<M>> machines;
        for (const std::uint32_t number : numbers) {
            auto found = opened_.find(number);
            if (found == opened_.end()) found = opened_.emplace(number, open_(number)).first;
            machines.push_back(found->second);
        }
        return machines;
    }

 private:
    OpenMachine<M> open_;
    UsableMachines usable_;
    std::mutex mutex_;
    std::map<std::uint32_t, BackendMachine<M>> opened_;
};

}  // namespace mir
