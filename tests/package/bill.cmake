# SPDX-License-Identifier: MIT
# The installed bill of materials names what was found, with versions.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

install_mir(${SCRATCH}/prefix)
set(bill ${SCRATCH}/prefix/share/doc/mir/mir.spdx.json)
file(READ ${bill} text)
string(JSON version GET "${text}" spdxVersion)
expect("${version}" "^SPDX-2\\.3$")
string(JSON number LENGTH "${text}" packages)
math(EXPR last "${number} - 1")
set(names)
foreach(index RANGE ${last})
    string(JSON name GET "${text}" packages ${index} name)
    string(JSON version ERROR_VARIABLE none GET "${text}" packages ${index} versionInfo)
    # Nobody says which stb tinygltf holds.
    if(none AND NOT name STREQUAL "stb-image")
        message(FATAL_ERROR "the bill of materials has no version of ${name}")
    endif()
    list(APPEND names ${name})
endforeach()
expect("${names}" "^mir;GLM;")
string(JSON version GET "${text}" packages 0 versionInfo)
expect("${version}" "^${MIR_VERSION}$")
