# SPDX-License-Identifier: MIT
# Ranks of a project outside render with the installed mir::mpi. Who does not ask for it needs no
# MPI; where the component was not installed it is refused in words.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

set(project ${MIR_SOURCE_DIR}/tests/package/use_mpi)
install_mir(${SCRATCH}/prefix)
# Not optimised, which is quicker to compile.
build_project(${project} ${SCRATCH}/build ${SCRATCH}/prefix -D CMAKE_BUILD_TYPE=None)
# More ranks than cores, by whoever runs the tests, in a container or not.
foreach(setting IN ITEMS ALLOW_RUN_AS_ROOT ALLOW_RUN_AS_ROOT_CONFIRM MCA_rmaps_base_oversubscribe)
    set(ENV{OMPI_${setting}} 1)
endforeach()
set(ENV{OMPI_MCA_hwloc_base_binding_policy} none)
set(ENV{OMPI_MCA_btl_vader_single_copy_mechanism} none)
run(said ${MIR_MPIEXEC} -n 2 ${SCRATCH}/build/ranks)
expect("${said}" "^2 ranks, the same picture $")

# A project that asks for all that is there.
file(WRITE ${SCRATCH}/all/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(all CXX)
find_package(mir REQUIRED)
message(STATUS \"runtime \${mir_runtime_FOUND}, mpi \${mir_mpi_FOUND}.\")
")
configure_arguments(arguments ${SCRATCH}/all ${SCRATCH}/all/build ${SCRATCH}/prefix
                    -D CMAKE_DISABLE_FIND_PACKAGE_MPI=ON)
run(said ${arguments})
expect("${said}" "runtime TRUE, mpi \\.")

file(GLOB_RECURSE component ${SCRATCH}/prefix/*/mir-mpi-targets*.cmake)
file(REMOVE ${component})
expect_refusal("installed without component 'mpi' \\(it has core[^)]*\\); install mir with that"
               ${project} ${SCRATCH}/no_component ${SCRATCH}/prefix)
