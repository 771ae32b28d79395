# SPDX-License-Identifier: MIT
# Hosts that hide their symbols, ask for a later standard or have another compiler get the same
# pictures and errors; one with -ffast-math is refused in words, and told a way that works.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

set(project ${MIR_SOURCE_DIR}/tests/package/host_flags)
install_mir(${SCRATCH}/prefix)

# pictures(OUTPUT name more...): what the host says that is built with more arguments of CMake. Not
# optimised, which is quicker to compile.
function(pictures output name)
    build_project(${project} ${SCRATCH}/${name} ${SCRATCH}/prefix -D CMAKE_BUILD_TYPE=None ${ARGN})
    run(said ${SCRATCH}/${name}/host)
    expect("${said}" "^[0-9]+ [0-9]+ [0-9]+ $")
    set(${output} "${said}" PARENT_SCOPE)
endfunction()

# expect_same(name more...)
function(expect_same name)
    pictures(said ${name} ${ARGN})
    if(NOT said STREQUAL expected)
        message(FATAL_ERROR "${name}: other pictures:\n${said}instead of\n${expected}")
    endif()
endfunction()

pictures(expected plain)
expect_same(hidden -D CMAKE_CXX_STANDARD=23
            -D "CMAKE_CXX_FLAGS=-fvisibility=hidden -fvisibility-inlines-hidden -ffast-math -fno-fast-math")

# The first other compiler of this machine.
foreach(name IN ITEMS g++ clang++ clang++-14)
    unset(found CACHE)
    find_program(found ${name})
    get_filename_component(kind "${MIR_CXX_COMPILER}" NAME)
    string(REGEX MATCH "clang" ours "${kind}")
    string(REGEX MATCH "clang" theirs "${name}")
    if(found AND NOT ours STREQUAL theirs)
        expect_same(other -D CMAKE_CXX_COMPILER=${found})
        break()
    endif()
endforeach()

configure_arguments(arguments ${project} ${SCRATCH}/fast ${SCRATCH}/prefix
                    -D CMAKE_CXX_FLAGS=-ffast-math)
run(ignored ${arguments})
execute_process(COMMAND ${CMAKE_COMMAND} --build ${SCRATCH}/fast RESULT_VARIABLE result
    OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(result EQUAL 0)
    message(FATAL_ERROR "a host with -ffast-math was built")
endif()
expect("${said}" "mir needs the arithmetic of IEEE 754: compile files .* with -fno-fast-math")
