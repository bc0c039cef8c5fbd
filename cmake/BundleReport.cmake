# The page of the report from its sources, runtime/report/page. Only on request: it needs node and npm.
#   report_bundle      bundles the page in the build tree
#   report_regenerate  writes it to generated/report
# The test generated.report_fresh compares the two, byte for byte.
option(DYNGEN_BUNDLE_REPORT "Bundle the page of the report from its sources (node, npm)" OFF)
if(NOT DYNGEN_BUNDLE_REPORT)
  return()
endif()
find_program(DYNGEN_NPM npm)
find_program(DYNGEN_NODE NAMES node nodejs)
if(NOT DYNGEN_NPM OR NOT DYNGEN_NODE)
  message(FATAL_ERROR
    "DYNGEN_BUNDLE_REPORT=ON: the page of the report is bundled by npm and node, which are not found.\n"
    "  apt-get install nodejs npm\n"
    "Or use the page that is committed: -DDYNGEN_BUNDLE_REPORT=OFF")
endif()
set(page_sources ${PROJECT_SOURCE_DIR}/runtime/report/page)
set(page_build ${CMAKE_CURRENT_BINARY_DIR}/page)
file(GLOB page_files CONFIGURE_DEPENDS ${page_sources}/src/* ${page_sources}/*.json ${page_sources}/*.mjs)
add_custom_command(
  OUTPUT ${page_build}/report.html
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${page_sources} ${page_build}
  COMMAND ${DYNGEN_NPM} ci --ignore-scripts --no-audit --no-fund --prefix ${page_build}
  COMMAND ${DYNGEN_NPM} run --silent --prefix ${page_build} bundle -- ${page_build}/report.html
  DEPENDS ${page_files}
  COMMENT "Bundling the page of the report"
  VERBATIM)
add_custom_target(report_bundle ALL DEPENDS ${page_build}/report.html)
add_custom_target(report_regenerate
  COMMAND ${CMAKE_COMMAND} -E copy ${page_build}/report.html
          ${PROJECT_SOURCE_DIR}/generated/report/report.html
  DEPENDS ${page_build}/report.html
  VERBATIM)
set(page ${page_build}/report.html)
