// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_array.hpp"
#include "mir/scene/environment_table.hpp"

namespace mir {

/// The environment of a scene in a backend's memory.
template <Backend B>
class UploadedEnvironment {
 public:
    /// Starts the copies on `queue`; `environment` must live until they are done.
    UploadedEnvironment(const B& backend, typename B::Queue& queue,
                        const EnvironmentTable& environment)
        : texels_(backend, queue, environment.texels()),
          cells_(backend, queue, environment.by_luminance().cumulative()),
          rows_(backend, queue, environment.by_luminance().rows().cumulative()),
          values_(environment.view()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] EnvironmentView<B::space> view() const {
        const DiscreteDistributionView<Space::host>& rows = values_.by_luminance.rows;
        return {texels_.data(),
                values_.width,
                values_.height,
                values_.turns,
                values_.light_group,
                {cells_.data(), values_.width, {rows_.data(), rows.size, rows.total}}};
    }

 private:
    UploadedArray<B, Rgb> texels_;
    UploadedArray<B, double> cells_;
    UploadedArray<B, double> rows_;
    EnvironmentView<Space::host> values_;  ///< of which only the values are used
};

}  // namespace mir
