# docs/reference/robots.md and its drawings are what dyngen makes of robots/ today.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)

run(text 0 ${CMAKE_COMMAND} -DDYNGEN=${DYNGEN} -DSOURCE_DIR=${SOURCE_DIR} -DOUTPUT=${WORK}
  -P ${SOURCE_DIR}/cmake/RobotsDocument.cmake)
foreach(made IN ITEMS robots.md robots)
  execute_process(COMMAND diff -ru ${SOURCE_DIR}/docs/reference/${made} ${WORK}/${made}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    string(SUBSTRING "${text}" 0 6000 text)
    message(FATAL_ERROR "docs/reference/${made} is not what dyngen makes today:\n${text}\n"
      "To accept: cmake --build BUILD --target robots_document")
  endif()
endforeach()
