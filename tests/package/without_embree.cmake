# SPDX-License-Identifier: MIT
# Renderers take oneTBB alone: without Embree mir's own hierarchies trace, and --accel embree is
# refused with the reason.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

configure_arguments(arguments ${MIR_SOURCE_DIR} ${SCRATCH}/build ""
    -D MIR_WITH_EMBREE=OFF -D CMAKE_DISABLE_FIND_PACKAGE_embree=ON
    -D MIR_BUILD_TESTS=OFF -D MIR_BUILD_EXAMPLES=OFF)
run(ignored ${arguments})
run(ignored ${CMAKE_COMMAND} --build ${SCRATCH}/build --target mir_tool)
set(mir ${SCRATCH}/build/bin/mir)
run(said ${mir} --version)
expect("${said}" "no Embree")
set(render ${mir} render builtin:sphere --width 24 --vpls 16)
foreach(integrator IN ITEMS vpl path micro)
    run(said ${render} --integrator ${integrator} -o ${SCRATCH}/${integrator}.exr)
endforeach()
execute_process(COMMAND ${render} --accel embree -o ${SCRATCH}/embree.exr
                RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(result EQUAL 0)
    message(FATAL_ERROR "--accel embree rendered without Embree:\n${said}")
endif()
expect("${said}" "Embree traces no ray of this build")
