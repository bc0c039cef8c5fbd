# What `cmake --install` puts where. Two components: `runtime` and `tool`. A sysroot needs no `tool`,
# hence its own export file, which the package reads only if it is there.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(DYNGEN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/dyngen)

if(TARGET dyngen_runtime)
  install(TARGETS dyngen_runtime EXPORT dyngenRuntimeTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
  install(DIRECTORY runtime/
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dyngen/runtime COMPONENT runtime
    FILES_MATCHING PATTERN "*.h" PATTERN tools EXCLUDE PATTERN report EXCLUDE)
  install(EXPORT dyngenRuntimeTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
endif()

# An export of its own: who does not ask for the component `consistency` needs no Ceres.
if(TARGET dyngen_consistency)
  install(TARGETS dyngen_consistency EXPORT dyngenConsistencyTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
  install(EXPORT dyngenConsistencyTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
endif()

# Likewise without the component `excitation` nobody needs NLopt.
if(TARGET dyngen_excitation)
  install(TARGETS dyngen_excitation EXPORT dyngenExcitationTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
  install(EXPORT dyngenExcitationTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
endif()

if(TARGET dyngen)
  install(TARGETS dyngen EXPORT dyngenToolTargets
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)
  install(EXPORT dyngenToolTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT tool)
endif()

configure_package_config_file(cmake/dyngenConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/dyngenConfig.cmake
  INSTALL_DESTINATION ${DYNGEN_PACKAGE_DIR})
# ARCH_INDEPENDENT: the function serves every target; the config file itself looks whether the runtime fits.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/dyngenConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  ${PROJECT_BINARY_DIR}/package/dyngenConfig.cmake
  ${PROJECT_BINARY_DIR}/package/dyngenConfigVersion.cmake
  cmake/DyngenAddRobot.cmake
  cmake/DyngenBlas.cmake
  DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY LICENSES DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
