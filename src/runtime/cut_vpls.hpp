// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuts/vpl_tree.hpp"
#include "mir/runtime/any_executor.hpp"

#include <memory>
#include <mutex>
#include <optional>

namespace mir {

/// VPLs that luxels gather by cuts. The host's tree over them is made when it is asked for first;
/// frames on backends make their own. Copies share it. Const use from any thread.
class CutVpls {
 public:
    /// The VPLs must outlive it.
    CutVpls(VplSpan<Space::host> vpls, AnyExecutor executor)
        : shared_(std::make_shared<Shared>(vpls, executor)) {}

    /// All of them.
    [[nodiscard]] VplSpan<Space::host> vpls() const { return shared_->vpls; }
    /// @throws Error what VplTree throws.
    [[nodiscard]] const VplTree& tree() const {
        std::call_once(shared_->once,
                       [&] { shared_->tree.emplace(shared_->vpls, shared_->executor); });
        return *shared_->tree;
    }
    /// True for this and its copies.
    [[nodiscard]] bool is(const CutVpls& other) const { return shared_ == other.shared_; }

 private:
    struct Shared {
        Shared(VplSpan<Space::host> all, AnyExecutor threads) : vpls(all), executor(threads) {}

        VplSpan<Space::host> vpls;
        AnyExecutor executor;
        std::once_flag once;
        std::optional<VplTree> tree;
    };

    std::shared_ptr<Shared> shared_;
};

}  // namespace mir
