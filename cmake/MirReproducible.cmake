# SPDX-License-Identifier: MIT
include_guard()

# Two builds in two folders give the same bytes: no path of this machine in what is installed, no
# time in archives.

# mir_hide_folders(TARGET): errors and debug information name sources from the repository's root on.
function(mir_hide_folders target)
    # The last that fits is taken, and a build folder may lie inside the sources.
    foreach(folder IN ITEMS "${PROJECT_SOURCE_DIR}=." "${PROJECT_BINARY_DIR}=build")
        target_compile_options(${target} PRIVATE
                               $<$<COMPILE_LANGUAGE:CXX>:-ffile-prefix-map=${folder}>)
    endforeach()
endfunction()

# Binutils of some systems write times and owners into archives unless told not to.
if(PROJECT_IS_TOP_LEVEL AND CMAKE_AR MATCHES "ar$")
    set(CMAKE_CXX_ARCHIVE_CREATE "<CMAKE_AR> qcD <TARGET> <LINK_FLAGS> <OBJECTS>")
    set(CMAKE_CXX_ARCHIVE_APPEND "<CMAKE_AR> qD <TARGET> <LINK_FLAGS> <OBJECTS>")
    set(CMAKE_CXX_ARCHIVE_FINISH "<CMAKE_RANLIB> -D <TARGET>")
endif()
