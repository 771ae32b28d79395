# SPDX-License-Identifier: MIT
include_guard()

find_package(Catch2 REQUIRED)
include(Catch)
include(MirUnity)
include(MirWarnings)

# How test programs are compiled. -O1 in optimised builds: results have the same bits at any level,
# and most of the tests' time is the compiler's.
function(mir_set_test_options name)
    mir_set_warnings(${name})
    mir_strict_floats(${name})
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

if(NOT TARGET threaded_tests)
    add_custom_target(threaded_tests)
    add_custom_target(memory_tests)

    # Headers of others that nearly every test reads, parsed once for all test programs. Ours are not
    # among them: a change to one would compile every test anew. The preset `tidy` goes without, and
    # so notices an include that is missing.
    add_library(mir_test_headers OBJECT ${PROJECT_SOURCE_DIR}/tests/support/precompiled.cpp)
    target_include_directories(mir_test_headers PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_link_libraries(mir_test_headers PRIVATE mir::mir Catch2::Catch2)
    target_precompile_headers(mir_test_headers PRIVATE
        "support/catch.hpp" <algorithm> <array> <atomic> <cmath> <cstdint> <filesystem> <fstream>
        <functional> <limits> <map> <numeric> <optional> <set> <span> <sstream> <string> <thread>
        <vector> <glm/glm.hpp>)
    mir_set_test_options(mir_test_headers)
endif()

# mir_add_test(NAME source... [LIBRARIES target...] [LABELS label...])
#
# One test program. Each TEST_CASE becomes a test "NAME: <its sentence>"; those tagged [statistical],
# [extended] for tests that ./test.sh leaves to .ci/run, or [slow] for those that sanitizers leave
# out, because they take them long and others run the same code, get that label besides LABELS. Two
# labels say which sanitizers are not worth their time: all programs but those labelled `slow` are
# built by the target memory_tests, those labelled `threads` by threaded_tests.
function(mir_add_test name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES;LABELS")
    mir_batches(sources ${name} ${arg_UNPARSED_ARGUMENTS})
    add_executable(${name} ${sources})
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
    target_link_libraries(${name} PRIVATE mir::mir mir::scenes ${arg_LIBRARIES} Catch2::Catch2WithMain)
    target_precompile_headers(${name} REUSE_FROM mir_test_headers)
    mir_set_test_options(${name})
    if("threads" IN_LIST arg_LABELS)
        add_dependencies(threaded_tests ${name})
    endif()
    if(NOT "slow" IN_LIST arg_LABELS)
        add_dependencies(memory_tests ${name})
    endif()

    set(others)
    foreach(tag IN ITEMS extended statistical slow)
        mir_has_tag(found ${tag} ${arg_UNPARSED_ARGUMENTS})
        if(found)
            mir_discover_tests(${name} "${others}[${tag}]" "${arg_LABELS};${tag}")
            string(APPEND others "~[${tag}]")
        endif()
    endforeach()
    mir_discover_tests(${name} "${others}" "${arg_LABELS}")
endfunction()

# Sets `result` to true when a TEST_CASE of the sources has the tag.
function(mir_has_tag result tag)
    set(${result} FALSE PARENT_SCOPE)
    foreach(source IN LISTS ARGN)
        file(STRINGS ${source} lines REGEX "\\[${tag}\\]" LIMIT_COUNT 1)
        if(lines)
            set(${result} TRUE PARENT_SCOPE)
        endif()
    endforeach()
endfunction()

# The labels become one word, because catch_discover_tests() takes a list of labels apart; CTest
# selects by regular expression and finds each of them in it.
function(mir_discover_tests name spec labels)
    list(REMOVE_ITEM labels "")
    list(JOIN labels "+" label)
    set(arguments)
    if(spec)
        list(APPEND arguments TEST_SPEC "${spec}")
    endif()
    if(label)
        list(APPEND arguments PROPERTIES LABELS "${label}")
    endif()
    # A name that CMake takes apart (brackets, semicolons) matches no test, which must not pass.
    catch_discover_tests(${name}
        TEST_PREFIX "${name}: "
        EXTRA_ARGS --warn NoTests
        ${arguments})
endfunction()

# mir_add_compile_fail_test(source [LIBRARIES target...])
#
# Builds `source` as it is, which must succeed, and as a test with MIR_COMPILE_FAIL, which must fail
# and print the sentence of the file's first line, "// expect: sentence".
function(mir_add_compile_fail_test source)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LIBRARIES")
    get_filename_component(name ${source} NAME_WE)
    file(STRINGS ${source} sentence REGEX "^// expect: " LIMIT_COUNT 1)
    if(NOT sentence)
        message(FATAL_ERROR "${source} has no line '// expect: sentence' (the test would pass for "
                            "any error); add the sentence that the compiler must print")
    endif()
    string(REGEX REPLACE "^// expect: " "" sentence "${sentence}")
    string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" pattern "${sentence}")
    foreach(variant IN ITEMS ok fail)
        add_library(${name}_${variant} OBJECT ${source})
        target_link_libraries(${name}_${variant} PRIVATE mir::mir ${arg_LIBRARIES})
    endforeach()
    set_target_properties(${name}_fail PROPERTIES EXCLUDE_FROM_ALL ON)
    target_compile_definitions(${name}_fail PRIVATE MIR_COMPILE_FAIL)
    add_test(NAME "compile_fail: ${name}"
        COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target ${name}_fail)
    # Two builds must not work in one folder at the same time.
    set_tests_properties("compile_fail: ${name}" PROPERTIES
        PASS_REGULAR_EXPRESSION "error:.*${pattern}"
        ENVIRONMENT LC_ALL=C
        LABELS compile_fail
        RESOURCE_LOCK build_folder)
endfunction()
