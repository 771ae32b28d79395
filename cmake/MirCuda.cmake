# SPDX-License-Identifier: MIT
#
# Finds nvcc and, with it, turns CUDA on: MIR_HAS_CUDA says whether. Included once, from the top of a
# project, where languages are enabled.
include_guard()
set(MIR_HAS_CUDA OFF)

set(MIR_WITH_CUDA OFF CACHE STRING
    "Build the CUDA backend: ON, OFF, or AUTO for where nvcc is found (preset cuda says ON)")
set_property(CACHE MIR_WITH_CUDA PROPERTY STRINGS OFF AUTO ON)

# Code of this project's own targets: products are not fused into sums, so that the device computes
# the bits of the host. Headers of other projects are compiled as those wish.
function(mir_strict_device_floats target)
    target_compile_options(${target} PRIVATE
        $<$<COMPILE_LANGUAGE:CUDA>:-fmad=false>
        "$<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=-ffp-contract=off,-fno-math-errno,-fno-trapping-math>")
endfunction()

# Host functions that a kernel calls without being marked for it are errors.
function(mir_set_device_warnings target)
    target_compile_options(${target} PRIVATE
        $<$<COMPILE_LANGUAGE:CUDA>:-Werror=cross-execution-space-call>
        "$<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=-Wall,-Wextra>")
endfunction()

# mir_add_device_objects(NAME source.cu... [LIBRARIES target...])
#
# What nvcc compiles of a program or library, as objects apart from what the C++ compiler does: link
# NAME to it. Kernels are then started by host functions that its sources define.
function(mir_add_device_objects name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES")
    add_library(${name} OBJECT ${arg_UNPARSED_ARGUMENTS})
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${name} PUBLIC mir::cuda ${arg_LIBRARIES})
    mir_strict_device_floats(${name})
    mir_set_device_warnings(${name})
endfunction()

if(NOT MIR_WITH_CUDA)
    if(PROJECT_IS_TOP_LEVEL)
        message(STATUS "mir: the CUDA backend is left out: MIR_WITH_CUDA is OFF (preset cuda has it)")
    endif()
    return()
endif()

# CMake itself looks on the PATH alone.
find_program(MIR_NVCC nvcc HINTS ENV CUDACXX ENV CUDA_HOME ENV CUDA_PATH
             PATHS /usr/local/cuda /opt/cuda PATH_SUFFIXES bin)
mark_as_advanced(MIR_NVCC)
if(NOT CMAKE_CUDA_COMPILER AND NOT MIR_NVCC)
    set(reason "nvcc was not found (neither on PATH nor below CUDA_HOME, CUDA_PATH or /usr/local/cuda)")
    if(NOT MIR_WITH_CUDA STREQUAL "AUTO")
        message(FATAL_ERROR "mir: ${reason}; install the CUDA toolkit, 12.0 or newer, or configure "
                            "with -DMIR_WITH_CUDA=AUTO to build the rest")
    endif()
    message(STATUS "mir: the CUDA backend is left out: ${reason}")
    return()
endif()
if(NOT CMAKE_CUDA_COMPILER)
    set(CMAKE_CUDA_COMPILER ${MIR_NVCC})
endif()
if(NOT CMAKE_CUDA_HOST_COMPILER)
    set(CMAKE_CUDA_HOST_COMPILER ${CMAKE_CXX_COMPILER})
endif()
if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
    set(CMAKE_CUDA_ARCHITECTURES 75 80 90 CACHE STRING
        "Compute capabilities that kernels are built for, without the dot")
endif()
enable_language(CUDA)
find_package(CUDAToolkit 12.0 REQUIRED)
set(MIR_HAS_CUDA ON)
