# SPDX-License-Identifier: MIT
# A compiler and pkg-config are enough beside an installation, wherever it was moved.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

find_program(PKG_CONFIG pkg-config REQUIRED)
install_mir(${SCRATCH}/prefix)
file(RENAME ${SCRATCH}/prefix ${SCRATCH}/moved)
file(GLOB_RECURSE core ${SCRATCH}/moved/*/mir.pc)
cmake_path(GET core PARENT_PATH folder)
set(ENV{PKG_CONFIG_PATH} ${folder}:$ENV{PKG_CONFIG_PATH})

# compile(program source package...): by what pkg-config says of the packages and nothing else.
function(compile program source)
    run(flags ${PKG_CONFIG} --cflags --libs ${ARGN})
    separate_arguments(flags UNIX_COMMAND "${flags}")
    run(ignored ${MIR_CXX_COMPILER} ${MIR_SOURCE_DIR}/examples/use_installed/${source}
        -o ${SCRATCH}/${program} ${flags})
endfunction()

run(version ${PKG_CONFIG} --modversion mir)
expect("${version}" "^${MIR_VERSION} $")
compile(own_renderer own_renderer.cpp mir)
run(said ${SCRATCH}/own_renderer)
expect("${said}" "^below the VPL 0\\.25")
compile(mean_radiance main.cpp mir-runtime mir-io mir-scenes)
run(said ${SCRATCH}/mean_radiance furnace.exr)
expect("${said}" "^mean radiance (0\\.9[5-9]|1 |1\\.0[0-5])")
