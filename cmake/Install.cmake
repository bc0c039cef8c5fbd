# What `cmake --install` puts where. Three components: `runtime`, `tool` and `documents`. A sysroot needs no `tool`,
# hence its own export file, which the package reads only if it is there.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(DYNGEN_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/dyngen)
include(${PROJECT_SOURCE_DIR}/runtime/public_headers.cmake)

# dyngen_install_headers(<part>): the headers of a part of the runtime, in the folders in which they stand.
function(dyngen_install_headers part)
  foreach(header IN LISTS dyngen_${part}_public dyngen_${part}_detail)
    cmake_path(GET header PARENT_PATH room)
    install(FILES runtime/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/dyngen/runtime/${room} COMPONENT runtime)
  endforeach()
endfunction()

if(TARGET dyngen_runtime)
  install(TARGETS dyngen_runtime EXPORT dyngenRuntimeTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
  dyngen_install_headers(runtime)
  install(EXPORT dyngenRuntimeTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
endif()

# An export of its own: who does not ask for the component `consistency` needs no Ceres.
if(TARGET dyngen_consistency)
  install(TARGETS dyngen_consistency EXPORT dyngenConsistencyTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
  dyngen_install_headers(consistency)
  install(EXPORT dyngenConsistencyTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
endif()

# Likewise without the component `excitation` nobody needs NLopt.
if(TARGET dyngen_excitation)
  install(TARGETS dyngen_excitation EXPORT dyngenExcitationTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
  dyngen_install_headers(excitation)
  install(EXPORT dyngenExcitationTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
endif()

# Both tools run from any prefix: the effect files and the page of the report are part of them.
set(tools "")
foreach(tool IN ITEMS dyngen dynid)
  if(TARGET ${tool})
    list(APPEND tools ${tool})
  endif()
endforeach()
if(tools)
  install(TARGETS ${tools} EXPORT dyngenToolTargets
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tool)
  install(EXPORT dyngenToolTargets NAMESPACE dyngen::
    DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT tool)
endif()

# Side by side as in the source tree: the examples name the robots as ../../robots.
set(DYNGEN_ROBOTS_DIR ${CMAKE_INSTALL_DATADIR}/dyngen/robots)
install(DIRECTORY robots/ DESTINATION ${DYNGEN_ROBOTS_DIR} COMPONENT tool FILES_MATCHING PATTERN "*.robot")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/dyngen COMPONENT tool)

configure_package_config_file(cmake/dyngenConfig.cmake.in
  ${PROJECT_BINARY_DIR}/package/dyngenConfig.cmake
  INSTALL_DESTINATION ${DYNGEN_PACKAGE_DIR} PATH_VARS DYNGEN_ROBOTS_DIR)
# ARCH_INDEPENDENT: the function serves every target; the config file itself looks whether the runtime fits.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/package/dyngenConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES
  ${PROJECT_BINARY_DIR}/package/dyngenConfig.cmake
  ${PROJECT_BINARY_DIR}/package/dyngenConfigVersion.cmake
  cmake/DyngenAddRobot.cmake
  cmake/DyngenBlas.cmake
  DESTINATION ${DYNGEN_PACKAGE_DIR} COMPONENT runtime)
include(${PROJECT_SOURCE_DIR}/cmake/PkgConfig.cmake)

# The documents, as they stand in the source tree, so that their links hold. Robots stand elsewhere: the one page that
# links to them is told where.
file(RELATIVE_PATH robots_from_docs "${CMAKE_INSTALL_FULL_DOCDIR}/docs/reference" "${CMAKE_INSTALL_FULL_DATADIR}/dyngen/robots")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS docs/reference/robots.md)
file(READ docs/reference/robots.md robots_page)
string(REPLACE "](../../robots/" "](${robots_from_docs}/" robots_page "${robots_page}")
file(WRITE ${PROJECT_BINARY_DIR}/package/robots.md "${robots_page}")
install(FILES ${PROJECT_BINARY_DIR}/package/robots.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs/reference COMPONENT documents)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents
  FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png" PATTERN "*.schema.json" PATTERN robots.md EXCLUDE)
install(FILES README.md CHANGELOG.md CONTRIBUTING.md SECURITY.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT documents)
foreach(component IN ITEMS runtime tool documents)  # whatever is passed on has its licence
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${component})
  install(DIRECTORY LICENSES DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT ${component})
endforeach()

# The folders that hold nothing but dyngen are removed when they are empty.
set(own_folders
  ${CMAKE_INSTALL_INCLUDEDIR}/dyngen ${CMAKE_INSTALL_DATADIR}/dyngen ${DYNGEN_PACKAGE_DIR} ${CMAKE_INSTALL_DOCDIR})
add_custom_target(uninstall
  COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} "-DOWN=${own_folders}"
          -P ${PROJECT_SOURCE_DIR}/cmake/Uninstall.cmake
  VERBATIM)
