# The second build does nothing; the robot file and the generator make it run again; a mistake is reported.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

cmake_path(GET DYNGEN FILENAME name)
file(COPY ${DYNGEN} DESTINATION ${WORK}/host)
set(generator ${WORK}/host/${name})
set(folder ${WORK}/build)
configure(text 0 ${folder} -DCMAKE_PREFIX_PATH=${PREFIX} -DDYNGEN_EXECUTABLE=${generator})
build(text ${folder})
run_programs(${folder})

function(expect_idle what)
  build(text ${folder})
  expect_no_text("${what}" "${text}" Generating Building Linking)
endfunction()
function(expect_regenerated what)
  build(text ${folder})
  expect_text("${what}" "${text}" "Generating arm.c and arm.h" "Generating small_arm.c and small_arm.h"
    "Linking C executable consumer_c")
  expect_idle("after ${what}")
endfunction()

expect_idle("the second build")
file(TOUCH ${consumer}/arm.robot)
expect_regenerated("a touched robot file")
file(TOUCH ${generator})
expect_regenerated("a touched generator")

# A new number in the file is a new number in the program.
file(READ ${consumer}/arm.robot robot)
string(REPLACE "mX    1 1" "mX    1 2" changed "${robot}")
file(WRITE ${consumer}/arm.robot "${changed}")
build(text ${folder})
run(text 2 ${folder}/consumer_c)
expect_text("a changed robot file" "${text}" "tau = 39.2400 19.6200")

# A mistake stops the build with its place; a repaired file goes on.
string(REPLACE "mX    1 1" "mX    1 x" wrong "${robot}")
file(WRITE ${consumer}/arm.robot "${wrong}")
execute_process(COMMAND ${CMAKE_COMMAND} --build ${folder}
  RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
if(code EQUAL 0)
  message(FATAL_ERROR "a wrong robot file builds:\n${text}")
endif()
expect_text("a wrong robot file" "${text}" "arm.robot:12:9: error:" "'x'")
file(WRITE ${consumer}/arm.robot "${robot}")
build(text ${folder})
run_programs(${folder})
expect_idle("after the repair")
