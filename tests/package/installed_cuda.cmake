# SPDX-License-Identifier: MIT
# A project outside builds against the installed CUDA backend; what it prints depends on the machine.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

install_mir(${SCRATCH}/prefix)
build_project(${CMAKE_CURRENT_LIST_DIR}/use_cuda ${SCRATCH}/build ${SCRATCH}/prefix
              -D CMAKE_CUDA_COMPILER=${MIR_CUDA_COMPILER}
              -D CMAKE_CUDA_HOST_COMPILER=${MIR_CXX_COMPILER}
              -D CMAKE_CUDA_ARCHITECTURES=${MIR_CUDA_ARCHITECTURE})
run(said ${SCRATCH}/build/list_gpus)
expect("${said}" "^(0 |no GPU: )")
foreach(program IN ITEMS own_kernel own_kernel_shared)
    run(said ${SCRATCH}/build/${program})
    expect("${said}" "^(9 squared is 81|no GPU: )")
endforeach()
