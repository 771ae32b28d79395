// SPDX-License-Identifier: MIT
#pragma once

#include "machine.hpp"
#include "options.hpp"
#include "row.hpp"

#include <functional>

namespace mirpaper {

/// What a figure is measured with.
struct Lab {
    const Options& options;
    Executor& executor;
    std::vector<std::unique_ptr<Machine>>& machines;
    std::function<void(const Row&)> add;  ///< takes a finished row
};

/// One figure of the paper, or one that it could not have.
struct Figure {
    std::string name;
    std::vector<std::string> scenes;
    std::vector<std::uint32_t> vpls;
    void (*measure)(Lab& lab, PaperScene& scene, const Figure& figure) = nullptr;

    /// The same with the scenes and VPLs that the user asked for.
    [[nodiscard]] Figure with(const Options& options) const;
};

/// Every figure there is, as the paper has them.
std::vector<Figure> all_figures();

}  // namespace mirpaper
