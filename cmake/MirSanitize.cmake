# SPDX-License-Identifier: MIT
include_guard()

set(MIR_SANITIZE "" CACHE STRING "Sanitizers of the whole build, for example address,undefined")

# For the whole directory tree, since a sanitizer must see every object of a program; therefore only
# where this project is the top one.
if(MIR_SANITIZE AND PROJECT_IS_TOP_LEVEL)
    add_compile_options(-fsanitize=${MIR_SANITIZE} -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${MIR_SANITIZE})
    if(MIR_SANITIZE MATCHES "undefined")
        add_compile_options(-fno-sanitize-recover=undefined)
    endif()
    # Checks of every access through a pointer triple the time of compilation. At null and at the
    # ends of objects the address sanitizer stops too; vptr is for casts that the library has not.
    # Those of alignment and of sums of pointers, a fifth of what is left, are left to the fuzzers,
    # which read bytes from outside.
    if(MIR_SANITIZE MATCHES "address")
        add_compile_options(-fno-sanitize=null,object-size,vptr)
        if(NOT MIR_BUILD_FUZZERS)
            add_compile_options(-fno-sanitize=alignment,pointer-overflow)
        endif()
        # Accesses are checked by calls: to build what is checked in line takes half as long again.
        if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND NOT MIR_BUILD_FUZZERS)
            add_compile_options("SHELL:-mllvm -asan-instrumentation-with-call-threshold=0")
        endif()
    endif()
    if(MIR_SANITIZE MATCHES "thread" AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        add_compile_options(
            -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tools/sanitizers/tsan_ignore.txt)
    endif()
endif()
