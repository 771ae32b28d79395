# SPDX-License-Identifier: MIT
# The examples that hold mir inside are projects of their own beside an installation.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

install_mir(${SCRATCH}/prefix)
foreach(example IN ITEMS first_render embed_gbuffer embed_offline embed_threads)
    # Not optimised, which is quicker to compile; they run where the others are built.
    build_project(${MIR_SOURCE_DIR}/examples/${example} ${SCRATCH}/${example} ${SCRATCH}/prefix
                  -D CMAKE_BUILD_TYPE=Debug)
endforeach()
