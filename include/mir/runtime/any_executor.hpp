// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"

#include <concepts>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace mir {

/// An Executor behind a virtual call for each loop and each body. What loops is compiled once for
/// all executors. Model of Executor. A handle: copies run on the same executor, which must outlive
/// them.
class AnyExecutor {
 public:
    /// Runs everything on `executor`.
    template <Executor E>
        requires(!std::same_as<E, AnyExecutor>)
    explicit AnyExecutor(E& executor)
        : executor_(&executor),
          loop_([](void* e, std::size_t n, Call call) { static_cast<E*>(e)->for_each(n, call); }),
          concurrency_([](const void* e) {
              return static_cast<std::size_t>(static_cast<const E*>(e)->concurrency());
          }) {}

    /// As the executor beneath.
    /// @throws What that and the bodies throw.
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        using Plain = std::remove_reference_t<Body>;
        Plain* const at = std::addressof(body);
        loop_(executor_, n, {&at, [](const void* context, std::size_t i) {
                                 (**static_cast<Plain* const*>(context))(i);
                             }});
    }
    /// That of the executor beneath.
    [[nodiscard]] std::size_t concurrency() const { return concurrency_(executor_); }

 private:
    /// A body of unknown type.
    struct Call {
        const void* context;
        void (*body)(const void*, std::size_t);

        void operator()(std::size_t i) const { body(context, i); }
    };

    void* executor_;
    void (*loop_)(void*, std::size_t, Call);
    std::size_t (*concurrency_)(const void*);
};

static_assert(Executor<AnyExecutor>);

}  // namespace mir
