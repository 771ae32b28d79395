# SPDX-License-Identifier: MIT
# A project that contains mir gets its targets and nothing besides.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

build_project(${CMAKE_CURRENT_LIST_DIR}/subdirectory ${SCRATCH}/build ""
              -D MIR_SOURCE_DIR=${MIR_SOURCE_DIR} -D CMAKE_BUILD_TYPE=Debug)
run(said ${SCRATCH}/build/own_renderer)
expect("${said}" "^below the VPL 0\\.25")
run(said ${CMAKE_COMMAND} --install ${SCRATCH}/build --prefix ${SCRATCH}/prefix)
if(EXISTS ${SCRATCH}/prefix)
    message(FATAL_ERROR "mir installs itself with the project that contains it:\n${said}")
endif()
