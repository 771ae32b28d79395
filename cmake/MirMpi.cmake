# SPDX-License-Identifier: MIT
#
# Finds MPI, with which ranks make pictures together: MIR_HAS_MPI says whether.
include_guard()
set(MIR_HAS_MPI OFF)

set(default OFF)
if(PROJECT_IS_TOP_LEVEL)
    set(default AUTO)
endif()
set(MIR_WITH_MPI ${default} CACHE STRING
    "Build mir::mpi and the program mir-mpi: ON, OFF, or AUTO for where MPI is found")
set_property(CACHE MIR_WITH_MPI PROPERTY STRINGS OFF AUTO ON)

# Sanitizers see into no MPI: what they say of it is not ours. Teams are tested there without it.
if(NOT MIR_WITH_MPI OR (MIR_SANITIZE AND MIR_WITH_MPI STREQUAL "AUTO"))
    return()
endif()
# The bindings for C++ left MPI's standard long ago.
set(MPI_CXX_SKIP_MPICXX ON)
if(MIR_WITH_MPI STREQUAL "AUTO")
    find_package(MPI QUIET COMPONENTS CXX GLOBAL)
else()
    find_package(MPI REQUIRED COMPONENTS CXX GLOBAL)
endif()
if(MPI_CXX_FOUND)
    set(MIR_HAS_MPI ON)
elseif(PROJECT_IS_TOP_LEVEL)
    message(STATUS "mir: mir::mpi and mir-mpi are left out: no MPI was found")
endif()
