# SPDX-License-Identifier: MIT
# The same sources in two folders, built in folders of different names, give a library of the same
# bytes: with assertions and debug information, which hold the names of files.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

# A cache of compiled files would give the second what it has of the first.
set(ENV{CCACHE_DISABLE} 1)
unset(ENV{CMAKE_CXX_COMPILER_LAUNCHER})

# configure(folder build): copies the sources and configures them.
function(configure folder build)
    foreach(part IN ITEMS CMakeLists.txt CHANGELOG.md LICENSE cmake include src backends)
        file(COPY ${MIR_SOURCE_DIR}/${part} DESTINATION ${folder})
    endforeach()
    configure_arguments(arguments ${folder} ${build} "" -D MIR_BUILD_TOOLS=OFF -D MIR_INSTALL=OFF
        -D MIR_BUILD_TESTS=OFF -D MIR_BUILD_EXAMPLES=OFF -D MIR_WITH_CPU=OFF -D MIR_WITH_IO=OFF
        -D CMAKE_BUILD_TYPE=None -D CMAKE_CXX_FLAGS=-g1 -D CMAKE_DISABLE_FIND_PACKAGE_Doxygen=ON)
    run(ignored ${arguments})
endfunction()

# library(OUTPUT build): the hash of mir::scenes built there.
function(library output build)
    run(ignored ${CMAKE_COMMAND} --build ${build} --target mir_scenes)
    file(GLOB_RECURSE archive ${build}/libmir_scenes.a)
    file(SHA256 ${archive} hash)
    set(${output} ${hash} PARENT_SCOPE)
endfunction()

# plant(folder): a source that holds its folder, as one does that reads tables from a file.
function(plant folder)
    file(WRITE ${folder}/src/scenes/planted.cpp "extern const char folder[] = MIR_FOLDER;\n")
    file(APPEND ${folder}/src/scenes/CMakeLists.txt [[
set_source_files_properties(planted.cpp PROPERTIES
                            COMPILE_DEFINITIONS MIR_FOLDER="${PROJECT_SOURCE_DIR}")
]])
endfunction()

configure(${SCRATCH}/one ${SCRATCH}/one/build)
configure(${SCRATCH}/another/place ${SCRATCH}/elsewhere)
library(first ${SCRATCH}/one/build)
library(second ${SCRATCH}/elsewhere)
if(NOT first STREQUAL second)
    message(FATAL_ERROR "libmir_scenes.a of two folders has other bytes: ${first}, ${second}")
endif()

plant(${SCRATCH}/one)
plant(${SCRATCH}/another/place)
library(first ${SCRATCH}/one/build)
library(second ${SCRATCH}/elsewhere)
if(first STREQUAL second)
    message(FATAL_ERROR "libmir_scenes.a has the same bytes although it holds its folder's name")
endif()
