# Wrong and missing arguments of dyngen_add_robot stop at configure, by name.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

file(COPY ${consumer}/arm.robot DESTINATION ${WORK}/project)
set(good ROBOT arm.robot GENERATOR ${DYNGEN})

# refuse(<what> <lines of CMakeLists.txt> <part of the message> ...)
function(refuse what lines)
  file(WRITE ${WORK}/project/CMakeLists.txt "cmake_minimum_required(VERSION 3.16)\nproject(p C)\n"
    "include(${SOURCE_DIR}/cmake/DyngenAddRobot.cmake)\n${lines}\n")
  run(text 1 ${CMAKE_COMMAND} -S ${WORK}/project -B ${WORK}/build -G ${BUILD_TOOL})
  expect_text("${what}" "${text}" ${ARGN})
endfunction()

string(REPLACE ";" " " good "${good}")
refuse("no ROBOT" "dyngen_add_robot(arm GENERATOR ${DYNGEN})" "dyngen_add_robot(arm): ROBOT is missing")
refuse("ROBOT without value" "dyngen_add_robot(arm ROBOT)" "dyngen_add_robot(arm): ROBOT needs a value")
refuse("no robot file" "dyngen_add_robot(arm ROBOT leg.robot)"
  "dyngen_add_robot(arm): ROBOT: there is no file" "project/leg.robot'")
refuse("a folder as robot" "dyngen_add_robot(arm ROBOT .)" "ROBOT: there is no file")
refuse("unknown keyword" "dyngen_add_robot(arm SPEED fast ${good})"
  "dyngen_add_robot(arm): unknown argument 'SPEED'; expected ROBOT, BASE" "FUNCTIONS")
refuse("unknown function" "dyngen_add_robot(arm ${good} FUNCTIONS id inverse)"
  "FUNCTIONS: unknown value 'inverse'; expected all, id, id_rigid")
refuse("PARAMETERS" "dyngen_add_robot(arm ${good} PARAMETERS hot)"
  "PARAMETERS: unknown value 'hot'; expected baked, runtime")
refuse("SCALAR" "dyngen_add_robot(arm ${good} SCALAR half)"
  "SCALAR: unknown value 'half'; expected double, float")
refuse("TRIG" "dyngen_add_robot(arm ${good} TRIG table)"
  "TRIG: unknown value 'table'; expected inline, libm")
refuse("no folder of effects" "dyngen_add_robot(arm ${good} EFFECTS nowhere)"
  "EFFECTS: there is no folder" "project/nowhere'")
refuse("PREFIX" "dyngen_add_robot(arm ${good} PREFIX 2arm)"
  "PREFIX: '2arm' is not a C identifier")
refuse("target is no prefix" "dyngen_add_robot(my-arm ${good})"
  "dyngen_add_robot(my-arm): PREFIX is missing")
refuse("target exists" "add_custom_target(arm)\ndyngen_add_robot(arm ${good})"
  "dyngen_add_robot(arm): a target of this name exists already")
refuse("twice" "dyngen_add_robot(arm ${good})\ndyngen_add_robot(arm ${good})"
  "dyngen_add_robot(arm): a target of this name exists already")
refuse("same files" "dyngen_add_robot(arm ${good} OUTPUT_DIR o)\ndyngen_add_robot(ARM ${good} OUTPUT_DIR o)"
  "dyngen_add_robot(ARM): another robot writes the same files")
refuse("output is checked in"
  "dyngen_add_robot(arm ${good} CHECKED_IN here OUTPUT_DIR \${CMAKE_CURRENT_SOURCE_DIR}/here)"
  "OUTPUT_DIR and CHECKED_IN are the same directory")
refuse("GENERATOR" "dyngen_add_robot(arm ROBOT arm.robot GENERATOR no/such/dyngen)"
  "GENERATOR: there is no program 'no/such/dyngen'")
refuse("DYNGEN_EXECUTABLE" "set(DYNGEN_EXECUTABLE /no/dyngen)\ndyngen_add_robot(arm ROBOT arm.robot)"
  "DYNGEN_EXECUTABLE: there is no program '/no/dyngen'")
refuse("no generator" "dyngen_add_robot(arm ROBOT arm.robot)"
  "dyngen_add_robot(arm): there is no generator (none is installed)" "CHECKED_IN")
refuse("nothing checked in" "dyngen_add_robot(arm ROBOT arm.robot CHECKED_IN committed)"
  "CHECKED_IN: there is no generator, and no arm.c and arm.h in" "project/committed'")

# The functions that CMake knows are those that the generator knows.
run(text 2 ${DYNGEN} arm.robot --count --functions none)
string(REGEX REPLACE "\n +" " " text "${text}") # it fits a terminal
string(REGEX MATCH "expected ([A-Za-z_, ]+), one of them with _batch, or all" match "${text}")
string(REGEX REPLACE ", [a-z_]+_LINK" "" names "all, ${CMAKE_MATCH_1}")
set(expected "${names}")
refuse("the same functions" "dyngen_add_robot(arm ${good} FUNCTIONS none)"
  "unknown value 'none'; expected ${expected} Call Stack")
