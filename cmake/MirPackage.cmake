# SPDX-License-Identifier: MIT
# Packages by CPack: `mir` (the program) and `libmir-dev` (headers, static libraries) for Debian, a
# tarball of what is installed, a tarball of the sources.
include(MirRelease)
set(MIR_PACKAGE_MAINTAINER "the mir authors <maintainers@mir.invalid>" CACHE STRING
    "Who makes the packages: name and address, for Debian's")

set(CPACK_PACKAGE_NAME mir)
set(CPACK_PACKAGE_CONTACT "${MIR_PACKAGE_MAINTAINER}")
set(CPACK_PACKAGE_VENDOR "the mir authors")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_VERBATIM_VARIABLES ON)
# More threads cut what xz compresses at other places.
set(CPACK_THREADS 1)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_COMPONENTS_ALL development documents)
set(CPACK_DEBIAN_COMPONENTS development debian_development)
if(TARGET mir_tool)
    list(APPEND CPACK_COMPONENTS_ALL program)
    list(APPEND CPACK_DEBIAN_COMPONENTS program debian_program)
endif()
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" system)
set(CPACK_PACKAGE_FILE_NAME mir-${PROJECT_VERSION}-${system})

# --- the sources ---------------------------------------------------------------------------------
set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME mir-${PROJECT_VERSION})
# What .gitignore names. CPack matches whole paths.
string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" root "^${PROJECT_SOURCE_DIR}/")
string(REGEX REPLACE "^\\\\\\^" "^" root "${root}")
set(CPACK_SOURCE_IGNORE_FILES "${root}([.]git|build|out)/" "${root}(.*/)?[.](cache|clangd|idea|vscode)/"
    "${root}(.*/)?__pycache__/" "[.]py[co]$" "[.]swp$" "~$" "/[.]DS_Store$"
    "${root}(CMakeUserPresets|compile_commands)[.]json$")

# --- Debian --------------------------------------------------------------------------------------
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SOURCE mir)
foreach(group IN ITEMS PROGRAM DEVELOPMENT)
    set(CPACK_COMPONENT_${group}_GROUP ${group})
    set(CPACK_COMPONENT_DEBIAN_${group}_GROUP ${group})
endforeach()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME mir)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "renderer with virtual point lights
mir renders glTF, OBJ and PLY files into OpenEXR pictures. It lights them by
virtual point lights that Metropolis sampling places where they matter to the
camera.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmir-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(suggested cmake pkg-config)
if(TARGET mir_mpi)
    list(APPEND suggested libopenmpi-dev)
endif()
list(JOIN suggested ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "renderer with virtual point lights - development files
mir is a C++20 library of Metropolis Instant Radiosity. It renders whole
pictures, and gives its stages one by one to other renderers. This package has
headers, static libraries, and files for CMake and pkg-config.")

# What the headers and static libraries need of whoever compiles and links against them.
set(needs libglm-dev)
if(MIR_WITH_CPU)
    list(APPEND needs libtbb-dev)
endif()
if(TARGET mir_cpu)
    math(EXPR next "${MIR_EMBREE_MAJOR} + 1")
    list(APPEND needs "libembree-dev (>= ${MIR_EMBREE_MAJOR})" "libembree-dev (<< ${next})")
endif()
if(MIR_WITH_IO)
    list(APPEND needs "libopenexr-dev (>= 3.1)" libpng-dev zlib1g-dev "libtinygltf-dev (>= 2.6)"
                      libtinyobjloader-dev)
endif()
list(JOIN needs ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)

# mir_debian_papers(PACKAGE COMPONENT more...): licence, changes and `more` where Debian wants them.
function(mir_debian_papers package component)
    install(FILES ${PROJECT_SOURCE_DIR}/LICENSE RENAME copyright COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package} EXCLUDE_FROM_ALL)
    install(FILES ${MIR_DEBIAN_CHANGES}.gz RENAME changelog.gz COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package} EXCLUDE_FROM_ALL)
    install(FILES ${MIR_BILL_OF_MATERIALS} COMPONENT ${component}
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package} EXCLUDE_FROM_ALL)
endfunction()

find_program(MIR_GZIP gzip)
if(MIR_GZIP)
    set(MIR_DEBIAN_CHANGES ${PROJECT_BINARY_DIR}/debian_changes)
    file(CONFIGURE OUTPUT ${MIR_DEBIAN_CHANGES} @ONLY CONTENT
         "mir (@PROJECT_VERSION@) unstable; urgency=medium

  * Version @PROJECT_VERSION@: see CHANGELOG.md of the sources.

 -- @MIR_PACKAGE_MAINTAINER@  @MIR_RELEASE_DEBIAN@
")
    execute_process(COMMAND ${MIR_GZIP} -9nc ${MIR_DEBIAN_CHANGES}
                    OUTPUT_FILE ${MIR_DEBIAN_CHANGES}.gz COMMAND_ERROR_IS_FATAL ANY)
    mir_debian_papers(mir debian_program)
    mir_debian_papers(libmir-dev debian_development)
endif()

configure_file(${PROJECT_SOURCE_DIR}/cmake/cpack_options.cmake.in
               ${PROJECT_BINARY_DIR}/cpack_options.cmake @ONLY)
set(CPACK_MIR_LIBRARY_ARCHITECTURE "${CMAKE_LIBRARY_ARCHITECTURE}")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian_layout.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/repack.cmake)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/cpack_options.cmake)
include(CPack)
