# generated/NAME is what dyngen writes today.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)

run(text 0 ${DYNGEN} ${SOURCE_DIR}/robots/${NAME}.robot -o ${WORK}/${NAME}.c
  --functions id,id_rigid,gravity,coriolis,friction)  # as generated/CMakeLists.txt says
foreach(ending IN ITEMS c h)
  execute_process(
    COMMAND diff -u ${SOURCE_DIR}/generated/${NAME}/${NAME}.${ending} ${WORK}/${NAME}.${ending}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    string(SUBSTRING "${text}" 0 6000 text)
    message(FATAL_ERROR "generated/${NAME}/${NAME}.${ending} is not what dyngen writes today:\n${text}\n"
      "To accept: cmake --build BUILD --target ${NAME}_regenerate")
  endif()
endforeach()
