# SPDX-License-Identifier: MIT
include_guard()

# The time that packages and their papers carry: SOURCE_DATE_EPOCH where it is set, else the day on
# which CHANGELOG.md has this version. Never that of the build, so that packages made twice are equal.
set(changelog ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${changelog})
string(REPLACE "." "[.]" pattern "${PROJECT_VERSION}")
file(STRINGS ${changelog} heading REGEX "^## ${pattern} [(][0-9-]+[)]$" LIMIT_COUNT 1)
if(NOT heading)
    message(FATAL_ERROR "CHANGELOG.md has no heading '## ${PROJECT_VERSION} (YEAR-MONTH-DAY)', from "
                        "which packages get their time; add it")
endif()
string(REGEX MATCH "[0-9]+-[0-9]+-[0-9]+" day "${heading}")

# CMake tells times only of the present, or of SOURCE_DATE_EPOCH: seconds come from the days by hand.
if("$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
    string(REGEX MATCH "^([0-9]+)-0?([0-9]+)-0?([0-9]+)$" day "${day}")
    # Years that begin in March, whose months have a regular length.
    math(EXPR months "${CMAKE_MATCH_1} * 12 + ${CMAKE_MATCH_2} - 3")
    math(EXPR year "${months} / 12")
    math(EXPR days "${year} * 365 + ${year} / 4 - ${year} / 100 + ${year} / 400 + (${months} % 12 * 153 + 2) / 5 + ${CMAKE_MATCH_3} - 719469")
    math(EXPR MIR_RELEASE_SECONDS "${days} * 86400")
else()
    set(MIR_RELEASE_SECONDS $ENV{SOURCE_DATE_EPOCH})
endif()

set(epoch "$ENV{SOURCE_DATE_EPOCH}")
set(ENV{SOURCE_DATE_EPOCH} ${MIR_RELEASE_SECONDS})
string(TIMESTAMP MIR_RELEASE_TIME UTC)
string(TIMESTAMP MIR_RELEASE_DEBIAN "%a, %d %b %Y %H:%M:%S +0000" UTC)
if(epoch STREQUAL "")
    unset(ENV{SOURCE_DATE_EPOCH})
else()
    set(ENV{SOURCE_DATE_EPOCH} ${epoch})
endif()
