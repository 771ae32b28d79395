// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace mirtest {

/// Argument that makes the test program a child in which a kernel fails, since the GPU is lost for
/// the process in which one does.
inline constexpr std::string_view fail_in_kernel = "--fail-in-kernel";

/// The child: lets a kernel fail, prints a line for each error that follows and for the image that
/// the host still makes. 0 when it lived to the end.
int report_kernel_failure();

}  // namespace mirtest
