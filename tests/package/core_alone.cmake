# SPDX-License-Identifier: MIT
# Who asks for the core alone needs neither Embree, oneTBB, OpenEXR, libpng, tinygltf nor
# tinyobjloader.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

install_mir(${SCRATCH}/prefix)
set(disabled)
foreach(package IN ITEMS embree TBB OpenEXR Imath PNG TinyGLTF tinyobjloader CUDAToolkit)
    list(APPEND disabled -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
build_project(${MIR_SOURCE_DIR}/examples/use_installed ${SCRATCH}/build ${SCRATCH}/prefix
              -D USE_RENDERERS=OFF -D CMAKE_BUILD_TYPE=Debug ${disabled})
run(said ${SCRATCH}/build/own_renderer)
expect("${said}" "^below the VPL 0\\.25")
