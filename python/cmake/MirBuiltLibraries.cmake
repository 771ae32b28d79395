# SPDX-License-Identifier: MIT
#
# The targets of the library as ./render.sh builds them, brought up to date: the same folder, so that
# whoever has it compiles nothing twice. A folder that is there keeps its options, such as
# MIR_WITH_EMBREE=OFF, and may have a name that is no preset's.
set(MIR_PYTHON_PRESET cpu CACHE STRING "Folder of build/ whose libraries the module holds: cpu or cuda")
cmake_path(GET CMAKE_CURRENT_SOURCE_DIR PARENT_PATH mir_root)
set(mir_build ${mir_root}/build/${MIR_PYTHON_PRESET})

# What pip tells the compiler of the module must not reach the libraries.
set(plain ${CMAKE_COMMAND} -E env --unset=CXXFLAGS --unset=CFLAGS --unset=LDFLAGS ${CMAKE_COMMAND})
set(configure --preset ${MIR_PYTHON_PRESET} -DMIR_BUILD_TESTS=OFF)
if(EXISTS ${mir_build}/CMakeCache.txt)
    set(configure ${mir_build})
endif()
if(NOT DEFINED ENV{CMAKE_BUILD_PARALLEL_LEVEL})
    cmake_host_system_information(RESULT jobs QUERY NUMBER_OF_LOGICAL_CORES)
    set(ENV{CMAKE_BUILD_PARALLEL_LEVEL} ${jobs})
endif()
foreach(command IN ITEMS configure build)
    if(command STREQUAL "configure")
        set(arguments ${configure})
    else()
        set(arguments --build ${mir_build} --target mir_front)
    endif()
    execute_process(COMMAND ${plain} ${arguments} WORKING_DIRECTORY ${mir_root}
                    RESULT_VARIABLE failed)
    if(failed)
        message(FATAL_ERROR "the libraries of mir could not be built in ${mir_build} (see above); "
                            "run tools/setup.sh, which installs what they need")
    endif()
endforeach()

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(TBB REQUIRED)
find_package(embree 4 CONFIG QUIET)
if(NOT embree_FOUND)
    find_package(embree 3.12 CONFIG QUIET)
endif()
find_package(OpenEXR 3.1 CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(CLI11 REQUIRED)
# The kernels of the module are compiled as those of the library.
load_cache(${mir_build} READ_WITH_PREFIX built_ MIR_WITH_CUDA CMAKE_CUDA_ARCHITECTURES)
if(built_MIR_WITH_CUDA)
    set(MIR_WITH_CUDA ${built_MIR_WITH_CUDA})
    set(CMAKE_CUDA_ARCHITECTURES ${built_CMAKE_CUDA_ARCHITECTURES})
    include(MirCuda)
endif()
include(${mir_build}/mirBuildTargets.cmake)
if(MIR_HAS_CUDA)
    if(NOT TARGET cuda)
        message(FATAL_ERROR "build/${MIR_PYTHON_PRESET} was built without CUDA, and nvcc is here; "
                            "build it again, or set MIR_WITH_CUDA=OFF")
    endif()
    add_library(mir::cuda ALIAS cuda)
endif()
