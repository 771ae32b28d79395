// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_subtree.hpp"

#include <memory>
#include <mutex>
#include <vector>

namespace mir::detail {

/// One grower for each thread that asks at the same time, made when first needed.
class KdGrowerPool {
 public:
    explicit KdGrowerPool(const KdPlan& plan) : plan_(plan) {}

    KdGrower& take() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty()) {
            all_.push_back(std::make_unique<KdGrower>(plan_));
            idle_.push_back(all_.back().get());
        }
        KdGrower& grower = *idle_.back();
        idle_.pop_back();
        return grower;
    }
    void give_back(KdGrower& grower) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(&grower);
    }

 private:
    const KdPlan& plan_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<KdGrower>> all_;
    std::vector<KdGrower*> idle_;
};

}  // namespace mir::detail
