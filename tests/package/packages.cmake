# SPDX-License-Identifier: MIT
# Packages of one build made twice are equal; the tarball of the sources has the files of the
# repository.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

# Less compressed than for users, which takes a fifth of the time.
function(make_packages folder)
    run(ignored ${CMAKE_CPACK_COMMAND} --config ${MIR_BUILD_DIR}/CPackConfig.cmake -B ${folder}
        -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip ${ARGN})
    run(ignored ${CMAKE_CPACK_COMMAND} --config ${MIR_BUILD_DIR}/CPackSourceConfig.cmake
        -B ${folder})
endfunction()

# Times of the second are later.
make_packages(${SCRATCH}/first)
execute_process(COMMAND ${CMAKE_COMMAND} -E sleep 1)
make_packages(${SCRATCH}/second)
file(GLOB packages RELATIVE ${SCRATCH}/first ${SCRATCH}/first/mir* ${SCRATCH}/first/libmir*)
list(LENGTH packages number)
if(NOT number EQUAL 4)
    message(FATAL_ERROR "CPack made ${number} packages instead of four: ${packages}")
endif()
foreach(package IN LISTS packages)
    foreach(time IN ITEMS first second)
        file(SHA256 ${SCRATCH}/${time}/${package} ${time})
    endforeach()
    if(NOT first STREQUAL second)
        message(FATAL_ERROR "${package} made twice has other bytes: ${first}, ${second}")
    endif()
endforeach()

find_program(GIT git)
if(GIT AND EXISTS ${MIR_SOURCE_DIR}/.git)
    run(tracked ${GIT} -C ${MIR_SOURCE_DIR} ls-files --cached --others --exclude-standard
        --deduplicate)
    string(REGEX REPLACE "\n$" "" tracked "${tracked}")
    string(REPLACE "\n" ";" tracked "${tracked}")
    run(ignored ${CMAKE_COMMAND} -E tar xf ${SCRATCH}/first/mir-${MIR_VERSION}.tar.gz)
    file(GLOB_RECURSE packed RELATIVE ${SCRATCH}/mir-${MIR_VERSION} ${SCRATCH}/mir-${MIR_VERSION}/*)
    list(REMOVE_ITEM tracked ${packed} "")
    if(tracked)
        message(FATAL_ERROR "the tarball of the sources lacks ${tracked}")
    endif()
endif()
