// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_job.hpp"
#include "runtime/traced_scenes.hpp"

#include <memory>
#include <mutex>

namespace mir {

/// The kd-tree of a job for several frames, built for the one that asks first. Thread-safe.
class SharedTree {
 public:
    /// The job must outlive it.
    explicit SharedTree(RenderJob& job) : job_(job) {}

    /// tree_for_backends(); never null.
    [[nodiscard]] std::shared_ptr<const KdTree> get() {
        const std::lock_guard lock(mutex_);
        if (!tree_)
            tree_ = std::make_shared<const KdTree>(tree_for_backends(job_.geometry, job_.executor));
        return tree_;
    }

 private:
    RenderJob& job_;
    std::mutex mutex_;
    std::shared_ptr<const KdTree> tree_;
};

}  // namespace mir
