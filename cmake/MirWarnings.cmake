# SPDX-License-Identifier: MIT
include_guard()

# Warnings of this project's own targets; never seen by a project that uses the library.
function(mir_set_warnings target)
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -Wpedantic
        -Wshadow
        -Wconversion                # narrowing that is meant is written as a cast
        -Wno-sign-conversion        # index arithmetic is unsigned, differences are not
        -Wnon-virtual-dtor
        -Wold-style-cast
        -Woverloaded-virtual
        -Wcast-align
        -Wformat=2
        -Wimplicit-fallthrough
        $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false alarms in std::string (GCC bug 105651)
        $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond;-Wduplicated-branches;-Wlogical-op>)
    if(MIR_WARNINGS_AS_ERRORS)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()

# Scalar, packet and hand-vectorised versions of one formula must agree in bits, so products are not
# fused into sums behind our back (g++ does so by default where the processor can). The other two
# give up errno and floating-point traps, which nobody reads here and which keep loops with square
# roots and selects from being vectorised; neither changes a result.
function(mir_strict_floats target)
    target_compile_options(${target} PRIVATE
        -ffp-contract=off -fno-math-errno -fno-trapping-math)
endfunction()
