# SPDX-License-Identifier: MIT
# Apart from details, in folders and namespaces, what is for tests (archetypes, validation) and what other umbrellas or
# components include.
file(GLOB_RECURSE headers RELATIVE ${INCLUDE_FOLDER} ${INCLUDE_FOLDER}/mir/*.hpp)
list(FILTER headers EXCLUDE REGEX
     "/detail/|^mir/(io|runtime|validation)/|^mir/(mir|render|scenes)\\.hpp$|/archetypes\\.hpp$")
file(READ ${INCLUDE_FOLDER}/mir/mir.hpp umbrella)
foreach(header IN LISTS headers)
    file(STRINGS ${INCLUDE_FOLDER}/${header} public REGEX "^namespace mir(::[a-z]+)? {")
    list(FILTER public EXCLUDE REGEX "^namespace mir::(detail|blocks|strict) {")
    if(NOT public)
        continue()
    endif()
    string(FIND "${umbrella}" "#include \"${header}\"" found)
    if(found EQUAL -1)
        message(SEND_ERROR "mir/mir.hpp does not include ${header}; add it")
    endif()
endforeach()
