# SPDX-License-Identifier: MIT
# All patches at once: the copy builds, its tests pass, its pages are true of it, and its program
# renders with what was added.
include(${CMAKE_CURRENT_LIST_DIR}/../package/steps.cmake)

set(copy ${SCRATCH}/copy)
run(ignored sh ${CMAKE_CURRENT_LIST_DIR}/apply_recipes.sh ${MIR_SOURCE_DIR} ${copy})
file(COPY_FILE ${CMAKE_CURRENT_LIST_DIR}/copy_tests.cmake ${copy}/tests/CMakeLists.txt)
# Not optimised: the compiler takes a fifth of the time that -O3 takes it.
configure_arguments(arguments ${copy} ${SCRATCH}/build ""
    -D CMAKE_BUILD_TYPE=Debug -D CMAKE_CXX_FLAGS_DEBUG=-O0 -D MIR_UNITY_BATCH=6
    -D MIR_BUILD_EXAMPLES=OFF -D MIR_INSTALL=OFF -D MIR_WITH_EMBREE=OFF -D CMAKE_DISABLE_FIND_PACKAGE_embree=ON)
run(ignored ${arguments})
run(ignored ${CMAKE_COMMAND} --build ${SCRATCH}/build --target mir_tool test_recipes)
set(mir ${SCRATCH}/build/bin/mir)

foreach(check IN ITEMS code links paths words columns english api silence licence options names)
    run(ignored sh ${copy}/tests/docs/check_docs.sh ${check} ${copy} ${mir})
endforeach()
run(ignored sh ${copy}/tests/layers/check_layers.sh ${copy})
run(ignored sh ${copy}/tests/layers/check_public.sh ${copy})

# Those of the patches, and those of the tree that ask about what they add.
foreach(test IN ITEMS "Minnaert" "disc light" "OFF files" "first hits" "sched::VplByVpl" "backend of threads"
                      "scene_files.md shows" "comes back from its file")
    run(ignored ${SCRATCH}/build/bin/test_recipes --warn NoTests "*${test}*")
endforeach()

# render(OUTPUT scene option...): what the program says as JSON; the picture is OUTPUT.exr.
function(render output scene)
    run(said ${mir} render ${scene} --width 24 --height 16 --vpls 16 --quiet --no-png --json
        -o ${output}.exr ${ARGN})
    set(${output} "${said}" PARENT_SCOPE)
endfunction()
# same(A B): the pictures have the same bytes.
function(same a b)
    run(ignored ${CMAKE_COMMAND} -E compare_files ${SCRATCH}/${a}.exr ${SCRATCH}/${b}.exr)
endfunction()

render(plain builtin:sphere --scheduler cpu)
render(exchanged builtin:sphere --scheduler vpl-by-vpl)
expect("${exchanged}" "\"scheduler\": \"vpl-by-vpl\"")
same(plain exchanged)

render(first_hits builtin:sphere --sampler first-hit)
expect("${first_hits}" "\"sampler\": \"first-hit\"")

render(threads builtin:sphere --backend threads)
expect("${threads}" "\"backend\": \"threads\"")

set(corners "-1 0 -1\n-1 0 1\n1 0 1\n1 0 -1\n0 1 0\n")
set(faces "4 0 1 2 3\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n")
file(WRITE ${SCRATCH}/tent.off "OFF\n5 5 0\n${corners}${faces}")
file(WRITE ${SCRATCH}/tent.ply "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\n"
    "property float y\nproperty float z\nelement face 5\n"
    "property list uchar int vertex_indices\nend_header\n${corners}${faces}")
render(off tent.off --sun 1,2,1)
render(ply tent.ply --sun 1,2,1)
same(off ply)
