# SPDX-License-Identifier: MIT
# What cannot be had is refused with the reason.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

install_mir(${SCRATCH}/prefix)
# wants(name request): a project with nothing but one find_package(mir request).
function(wants name request)
    file(WRITE ${SCRATCH}/${name}/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(${name} CXX)
find_package(mir ${request})
message(STATUS \"core \${mir_core_FOUND}, cuda \${mir_cuda_FOUND}\")
")
endfunction()

if(NOT MIR_CUDA_COMPILER)
    wants(cuda "REQUIRED COMPONENTS cuda")
    expect_refusal("installed without component 'cuda' \\(it has core[^)]*\\); install mir with that"
                   ${SCRATCH}/cuda ${SCRATCH}/cuda/build ${SCRATCH}/prefix)
endif()
wants(unknown "REQUIRED COMPONENTS core vulkan")
expect_refusal("installed without component 'vulkan'"
               ${SCRATCH}/unknown ${SCRATCH}/unknown/build ${SCRATCH}/prefix)
wants(newer "0.3 REQUIRED COMPONENTS core")
expect_refusal("mirConfig\\.cmake, version: 0\\.2"
               ${SCRATCH}/newer ${SCRATCH}/newer/build ${SCRATCH}/prefix)

wants(optional "0.2 REQUIRED COMPONENTS core OPTIONAL_COMPONENTS cuda")
if(MIR_CUDA_COMPILER)
    set(has_cuda TRUE)
else()
    set(has_cuda FALSE)
endif()
configure_arguments(arguments ${SCRATCH}/optional ${SCRATCH}/optional/build ${SCRATCH}/prefix)
run(said ${arguments})
expect("${said}" "core TRUE, cuda ${has_cuda}")
