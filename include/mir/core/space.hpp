// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

namespace mir {

/// Where the memory behind a view lives. `any`: a value without pointers, usable on both sides.
enum class Space { host, device, any };

/// A value that may be passed to a kernel. Its bytes are all there is to it.
template <class T>
concept DeviceCopyable = std::is_trivially_copyable_v<T>;

/// True when code running in space `S` may dereference a `T`.
template <class T, Space S>
concept AccessibleFrom = T::space == S || T::space == Space::any;

}  // namespace mir
