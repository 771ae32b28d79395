// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

namespace mir {

/// Vector instruction sets that host loops are compiled for. All but the first have fused products
/// and sums.
enum class InstructionSet { baseline, avx2, avx512 };

/// The best one that this processor has. Results never depend on it: no contraction is allowed but
/// where the source asks for it, and every operation used is exact to the last bit in all of them.
inline InstructionSet best_instruction_set() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
        __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512vl") != 0)
        return InstructionSet::avx512;
    if (__builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0)
        return InstructionSet::avx2;
#endif
    return InstructionSet::baseline;
}

namespace detail {

/// Calls `body(set)`, the set being a constant, or `body()` if it does not care.
template <InstructionSet Set, class Body>
void call_with(const Body& body) {
    using Constant = std::integral_constant<InstructionSet, Set>;
    if constexpr (std::is_invocable_v<const Body&, Constant>)
        body(Constant{});
    else
        body();
}

#if defined(__x86_64__)
// `flatten` pulls the whole loop into a function that may use the wider registers, so one template
// serves every instruction set and no file needs its own compiler flags.
template <class Body>
[[gnu::flatten, gnu::target("avx2,fma")]] void run_avx2(const Body& body) {
    call_with<InstructionSet::avx2>(body);
}

#if defined(__clang__)
template <class Body>
[[gnu::flatten, gnu::target("fma,avx512f,avx512dq,avx512bw,avx512vl")]] void run_avx512(
    const Body& body) {
    call_with<InstructionSet::avx512>(body);
}
#else
template <class Body>
[[gnu::flatten, gnu::target("fma,avx512f,avx512dq,avx512bw,avx512vl,prefer-vector-width=512")]] void
run_avx512(const Body& body) {
    call_with<InstructionSet::avx512>(body);
}
#endif
#endif

}  // namespace detail

/// Calls `body()`, or `body(std::integral_constant<InstructionSet, set>)`, compiled for `set`,
/// which the processor must have.
template <class Body>
void run_with(InstructionSet set, const Body& body) {
#if defined(__x86_64__)
    if (set == InstructionSet::avx512) return detail::run_avx512(body);
    if (set == InstructionSet::avx2) return detail::run_avx2(body);
#endif
    static_cast<void>(set);
    detail::call_with<InstructionSet::baseline>(body);
}

}  // namespace mir
