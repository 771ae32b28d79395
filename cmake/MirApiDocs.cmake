# SPDX-License-Identifier: MIT
include_guard()

# The target api_docs: the reference of the public headers, and every complaint of Doxygen about it.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
    set(MIR_API_DOCS_FOLDER ${PROJECT_BINARY_DIR}/api_docs)
    set(list ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
    file(STRINGS ${list} headers REGEX "^mir/")
    set(MIR_PUBLIC_HEADERS)
    foreach(header IN LISTS headers)
        foreach(base IN ITEMS ${PROJECT_SOURCE_DIR}/include ${PROJECT_BINARY_DIR}/include
                              ${PROJECT_SOURCE_DIR}/backends/cpu/include
                              ${PROJECT_SOURCE_DIR}/backends/cuda/include
                              ${PROJECT_SOURCE_DIR}/backends/mpi/include)
            if(EXISTS ${base}/${header})
                string(APPEND MIR_PUBLIC_HEADERS " \\\n                         \"${base}/${header}\"")
            endif()
        endforeach()
    endforeach()
    configure_file(${PROJECT_SOURCE_DIR}/docs/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
    add_custom_target(api_docs
        COMMAND ${CMAKE_COMMAND} -D DOXYGEN=$<TARGET_FILE:Doxygen::doxygen>
                -D DOXYFILE=${PROJECT_BINARY_DIR}/Doxyfile -D FOLDER=${MIR_API_DOCS_FOLDER}
                -P ${PROJECT_SOURCE_DIR}/cmake/make_api_docs.cmake
        COMMENT "API reference in ${MIR_API_DOCS_FOLDER}/html" VERBATIM)
endif()
