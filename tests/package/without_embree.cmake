# SPDX-License-Identifier: MIT
# Renderers take oneTBB alone: without Embree mir's own hierarchies trace, and --accel embree is
# refused with the reason. PROGRAM was built so.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

run(said ${PROGRAM} --version)
expect("${said}" "no Embree")
set(render ${PROGRAM} render builtin:sphere --width 24 --vpls 16 --surfels 512)
foreach(integrator IN ITEMS vpl path micro)
    run(said ${render} --integrator ${integrator} -o ${SCRATCH}/${integrator}.exr)
endforeach()
execute_process(COMMAND ${render} --accel embree -o ${SCRATCH}/embree.exr
                RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(result EQUAL 0)
    message(FATAL_ERROR "--accel embree rendered without Embree:\n${said}")
endif()
expect("${said}" "Embree traces no ray of this build")
