# SPDX-License-Identifier: MIT
include_guard()

set(MIR_UNITY_BATCH 40 CACHE STRING "Sources of the program mir and of its tests that are compiled \
as one: more are quicker from nothing, 1 is quicker after a change")

# mir_unite(NAME SIZE)
#
# Compiles the sources of a program or library together, SIZE of them as one, where units are wished
# for at all.
function(mir_unite name size)
    if(MIR_UNITY_BATCH GREATER 1)
        set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
    endif()
endfunction()

# mir_batches(RESULT NAME source...)
#
# The sources, but units in place of the tests among them, MIR_UNITY_BATCH in each: small files that
# instantiate the same headers. Nothing links to a test, so each comes into a namespace of its own,
# where its names need not differ from its neighbours', with the headers of all before them.
function(mir_batches result name)
    set(sources ${ARGN})
    set(tests ${ARGN})
    list(FILTER sources EXCLUDE REGEX "_test[.]cpp$")
    list(FILTER tests INCLUDE REGEX "_test[.]cpp$")
    if(NOT MIR_UNITY_BATCH GREATER 1)
        list(APPEND sources ${tests})
        set(tests)
    endif()
    set(units 0)
    while(tests)
        list(SUBLIST tests 0 ${MIR_UNITY_BATCH} batch)
        list(REMOVE_ITEM tests ${batch})
        set(unit ${CMAKE_CURRENT_BINARY_DIR}/${name}_units/${units}.cpp)
        mir_write_unit(${unit} ${batch})
        list(APPEND sources ${unit})
        math(EXPR units "${units} + 1")
    endwhile()
    set(${result} ${sources} PARENT_SCOPE)
endfunction()

# By relative names, so that units of two checkouts are the same.
function(mir_write_unit unit)
    cmake_path(GET unit PARENT_PATH unit_folder)
    set(headers)
    set(bodies)
    foreach(source IN LISTS ARGN)
        cmake_path(ABSOLUTE_PATH source)
        cmake_path(GET source PARENT_PATH folder)
        cmake_path(GET source STEM stem)
        cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${unit_folder} OUTPUT_VARIABLE beside)
        file(STRINGS ${source} includes REGEX "^#include")
        # What lies beside the source does not lie beside the unit.
        foreach(include IN LISTS includes)
            if(include MATCHES "^#include \"([^\"/]+)\"" AND EXISTS ${folder}/${CMAKE_MATCH_1})
                set(include "#include \"${beside}/${CMAKE_MATCH_1}\"")
            endif()
            list(APPEND headers ${include})
        endforeach()
        string(APPEND bodies "namespace ${stem} {\n#include \"${beside}/${stem}.cpp\"\n}\n")
        # A header that the source includes from now on has to stand before it.
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${source})
    endforeach()
    list(REMOVE_DUPLICATES headers)
    list(JOIN headers "\n" headers)
    file(CONFIGURE OUTPUT ${unit} CONTENT "${headers}\n${bodies}" @ONLY)
endfunction()
