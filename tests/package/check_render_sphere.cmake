# SPDX-License-Identifier: MIT
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

function(check_example expected_result words)
    execute_process(COMMAND ${EXAMPLE} ${ARGN} WORKING_DIRECTORY ${SCRATCH}
        RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(NOT result EQUAL expected_result OR NOT said MATCHES "${words}")
        message(FATAL_ERROR "render_sphere ${ARGN} ended with ${result} and said:\n${said}")
    endif()
endfunction()

function(check_same a b)
    file(SHA256 ${SCRATCH}/${a} hash_a)
    file(SHA256 ${SCRATCH}/${b} hash_b)
    if(NOT hash_a STREQUAL hash_b)
        message(FATAL_ERROR "${a} and ${b} differ")
    endif()
endfunction()

check_example(0 "^sphere\\.exr: [0-9]+ VPLs")
check_example(0 "^plain\\.exr: " cpu plain.exr)
check_example(0 "^blocks\\.exr: " cpu-blocks blocks.exr)
check_same(plain.exr blocks.exr)
check_same(plain.png blocks.png)
check_same(sphere.exr blocks.exr)
check_example(1 "^render_sphere: there is no scheduler 'warp' in this build; choose" warp)
check_example(1 "^render_sphere: none/a\\.exr: it cannot be written" cpu none/a.exr)
check_example(2 "^usage: " cpu a.exr more)
