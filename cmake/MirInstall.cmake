# SPDX-License-Identifier: MIT
# One export set per component, so that find_package(mir COMPONENTS ...) loads what is asked for.
include(CMakePackageConfigHelpers)
set(MIR_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/mir)

foreach(component IN LISTS MIR_COMPONENTS)
    foreach(target IN LISTS MIR_TARGETS_${component})
        set(header_sets)
        get_target_property(sets ${target} INTERFACE_HEADER_SETS)
        if(sets)
            foreach(set IN LISTS sets)
                list(APPEND header_sets FILE_SET ${set} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
            endforeach()
        endif()
        install(TARGETS ${target} EXPORT mir-${component} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
                ${header_sets})
    endforeach()
    install(EXPORT mir-${component} FILE mir-${component}-targets.cmake NAMESPACE mir::
            DESTINATION ${MIR_CONFIG_DIR})
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/mirConfig.cmake.in
    ${PROJECT_BINARY_DIR}/mirConfig.cmake INSTALL_DESTINATION ${MIR_CONFIG_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mirConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mirConfig.cmake ${PROJECT_BINARY_DIR}/mirConfigVersion.cmake
        DESTINATION ${MIR_CONFIG_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET mir_tool)
    install(TARGETS mir_tool RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    set(manual ${PROJECT_BINARY_DIR}/tools/manual)
    install(FILES ${manual}/mir.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
    install(FILES ${manual}/bash/mir
            DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
    install(FILES ${manual}/zsh/_mir DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
    install(FILES ${manual}/fish/mir.fish
            DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
