# SPDX-License-Identifier: MIT
# A project outside builds against the installation and runs, then again after a move.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

# use_prefix(prefix build more...): `more` is for CMake.
function(use_prefix prefix build)
    build_project(${MIR_SOURCE_DIR}/examples/use_installed ${build} ${prefix} ${ARGN})
    run(said ${build}/mean_radiance ${build}/furnace.exr)
    expect("${said}" "^mean radiance (0\\.9[5-9]|1 |1\\.0[0-5])")
    if(NOT EXISTS ${build}/furnace.exr)
        message(FATAL_ERROR "mean_radiance wrote no picture")
    endif()
    run(said ${build}/own_renderer)
    expect("${said}" "^below the VPL 0\\.25")
endfunction()

install_mir(${SCRATCH}/prefix)
# mir::io was compiled with nlohmann-json, and needs it no more.
use_prefix(${SCRATCH}/prefix ${SCRATCH}/first -D CMAKE_DISABLE_FIND_PACKAGE_nlohmann_json=ON)

foreach(file IN ITEMS man/man1/mir.1 bash-completion/completions/mir zsh/site-functions/_mir
                      fish/vendor_completions.d/mir.fish)
    file(STRINGS ${SCRATCH}/prefix/share/${file} options REGEX "vpls")
    if(NOT options)
        message(FATAL_ERROR "share/${file} does not name the options of mir")
    endif()
endforeach()

file(GLOB_RECURSE files ${SCRATCH}/prefix/*)
foreach(file IN LISTS files)
    file(STRINGS ${file} absolute REGEX "${SCRATCH}|${MIR_SOURCE_DIR}|${MIR_BUILD_DIR}")
    if(absolute)
        message(FATAL_ERROR "${file} holds a path of this machine: ${absolute}")
    endif()
endforeach()

file(RENAME ${SCRATCH}/prefix ${SCRATCH}/elsewhere)
# Not optimised, which is quicker to compile.
use_prefix(${SCRATCH}/elsewhere ${SCRATCH}/second -D CMAKE_BUILD_TYPE=Debug)
