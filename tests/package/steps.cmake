# SPDX-License-Identifier: MIT
# Steps that the scripts of this folder have in common. Each fails loudly.
include(${SETTINGS})
file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})

# run(OUTPUT command...): runs the command in SCRATCH and keeps what it says.
function(run output)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${SCRATCH}
        RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
    if(NOT result EQUAL 0)
        list(JOIN ARGN " " command)
        message(FATAL_ERROR "${command}\nended with ${result}:\n${said}")
    endif()
    set(${output} "${said}" PARENT_SCOPE)
endfunction()

function(install_mir prefix)
    run(ignored ${CMAKE_COMMAND} --install ${MIR_BUILD_DIR} --prefix ${prefix})
endfunction()

# configure_arguments(OUTPUT source build prefix more...)
function(configure_arguments output source build prefix)
    string(REPLACE ";" "\\;" path "${prefix};${MIR_PREFIX_PATH}")
    set(${output} ${CMAKE_COMMAND} -S ${source} -B ${build} -G ${MIR_GENERATOR}
        -D CMAKE_BUILD_TYPE=${MIR_BUILD_TYPE} -D CMAKE_CXX_COMPILER=${MIR_CXX_COMPILER}
        -D CMAKE_FIND_USE_PACKAGE_REGISTRY=OFF "-DCMAKE_PREFIX_PATH=${path}" ${ARGN} PARENT_SCOPE)
endfunction()

# build_project(source build prefix more...): configures and builds.
function(build_project source build prefix)
    configure_arguments(arguments ${source} ${build} "${prefix}" ${ARGN})
    run(ignored ${arguments})
    run(ignored ${CMAKE_COMMAND} --build ${build})
endfunction()

# expect(text REGEX): fails unless the text matches.
function(expect text regex)
    string(REGEX REPLACE "[ \n]+" " " line "${text}")
    if(NOT line MATCHES "${regex}")
        message(FATAL_ERROR "expected '${regex}' in:\n${text}")
    endif()
endfunction()

# expect_refusal(REGEX source build prefix more...): configuring must fail with these words.
function(expect_refusal regex source build prefix)
    configure_arguments(arguments ${source} ${build} "${prefix}" ${ARGN})
    execute_process(COMMAND ${arguments} RESULT_VARIABLE result OUTPUT_VARIABLE said
        ERROR_VARIABLE said)
    if(result EQUAL 0)
        message(FATAL_ERROR "configuring ${source} was to fail with '${regex}' but did not")
    endif()
    expect("${said}" "${regex}")
endfunction()
