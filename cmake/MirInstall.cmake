# SPDX-License-Identifier: MIT
# One export set per component, so that find_package(mir COMPONENTS ...) loads what is asked for.
# Components of installing are three: `program`, `mpi` for the program that needs MPI, and
# `development` for who compiles against mir.
include(CMakePackageConfigHelpers)
set(MIR_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mir)

foreach(component IN LISTS MIR_COMPONENTS)
    foreach(target IN LISTS MIR_TARGETS_${component})
        set(header_sets)
        get_target_property(sets ${target} INTERFACE_HEADER_SETS)
        if(sets)
            foreach(set IN LISTS sets)
                list(APPEND header_sets FILE_SET ${set} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
                                        COMPONENT development)
            endforeach()
        endif()
        install(TARGETS ${target} EXPORT mir-${component}
                ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
                ${header_sets})
    endforeach()
    install(EXPORT mir-${component} FILE mir-${component}-targets.cmake NAMESPACE mir::
            DESTINATION ${MIR_CONFIG_DIR} COMPONENT development)
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/mirConfig.cmake.in
    ${PROJECT_BINARY_DIR}/mirConfig.cmake INSTALL_DESTINATION ${MIR_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mirConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mirConfig.cmake ${PROJECT_BINARY_DIR}/mirConfigVersion.cmake
        DESTINATION ${MIR_CONFIG_DIR} COMPONENT development)
if(TARGET mir_tool)
    install(TARGETS mir_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
    set(manual ${PROJECT_BINARY_DIR}/tools/manual)
    install(FILES ${manual}/mir.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
    install(FILES ${manual}/bash/mir
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
    install(FILES ${manual}/zsh/_mir
            DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT program)
    install(FILES ${manual}/fish/mir.fish
            DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
endif()

if(TARGET mir_mpi_tool)
    install(TARGETS mir_mpi_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT mpi)
endif()

include(MirPkgConfig)
include(MirBillOfMaterials)
# Debian's packages have the licence under another name, and the bill in a folder of their own.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${MIR_BILL_OF_MATERIALS}
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
