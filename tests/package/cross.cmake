# Cross-compiling with a generator of this machine, and with checked-in files and no generator.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

# The real thing if its compiler is here; else the compiler of this machine under another name.
find_program(cross_compiler aarch64-linux-gnu-g++)
if(cross_compiler)
  set(toolchain ${SOURCE_DIR}/cmake/toolchains/aarch64-linux-gnu.cmake)
  set(C_COMPILER aarch64-linux-gnu-gcc)
  set(CXX_COMPILER aarch64-linux-gnu-g++)
else()
  file(WRITE ${WORK}/toolchain.cmake "set(CMAKE_SYSTEM_NAME Linux)\nset(CMAKE_SYSTEM_PROCESSOR pretended)\n")
  set(toolchain ${WORK}/toolchain.cmake)
endif()
# The prefix is of this machine: the function serves, its library and its tool do not.
file(GLOB_RECURSE config ${PREFIX}/dyngenConfig.cmake)
cmake_path(GET config PARENT_PATH package)
set(cross -DCMAKE_TOOLCHAIN_FILE=${toolchain} -Ddyngen_DIR=${package})

function(run_crossed folder)
  if(NOT cross_compiler)
    run_programs(${folder})
  endif()
endfunction()

# dyngen::dyngen is not for us.
configure(text 1 ${WORK}/none ${cross})
expect_text("no generator" "${text}"
  "dyngen_add_robot(arm): there is no generator (dyngen::dyngen does not run here when cross-compiling)"
  "GENERATOR or DYNGEN_EXECUTABLE" "CHECKED_IN" "dyngen::runtime is left out")

# A generator of this machine, by variable and by argument.
configure(text 0 ${WORK}/by_variable ${cross} -DDYNGEN_EXECUTABLE=${DYNGEN})
build(text ${WORK}/by_variable)
expect_text("by variable" "${text}" "Generating arm.c and arm.h from arm.robot")
run_crossed(${WORK}/by_variable)
configure(text 0 ${WORK}/by_argument ${cross} -DCONSUMER_GENERATOR=${DYNGEN})
build(text ${WORK}/by_argument)
run_crossed(${WORK}/by_argument)

# Checked-in files: written on request by a machine with a generator, compiled by one without.
set(checked_in -DCONSUMER_CHECKED_IN=committed)
configure(text 1 ${WORK}/checked_in ${cross} ${checked_in})
expect_text("nothing checked in" "${text}" "CHECKED_IN: there is no generator, and no arm.c and arm.h in")
configure(text 0 ${WORK}/host -DCMAKE_PREFIX_PATH=${PREFIX} -DDYNGEN_EXECUTABLE=${DYNGEN} ${checked_in})
build(text ${WORK}/host)
expect_files("build" ${consumer} CMakeLists.txt arm.robot main.c main.cpp)
build(text ${WORK}/host --target arm_regenerate small_arm_regenerate)
expect_files("regenerate" ${consumer}/committed arm.c arm.h small_arm.c small_arm.h)
configure(text 0 ${WORK}/checked_in ${cross} ${checked_in})
build(text ${WORK}/checked_in)
expect_no_text("checked in" "${text}" Generating)
run_crossed(${WORK}/checked_in)
if(EXISTS ${WORK}/checked_in/dyngen)
  message(FATAL_ERROR "code was generated without a generator")
endif()
run(text 1 ${CMAKE_COMMAND} --build ${WORK}/checked_in --target arm_regenerate)
expect_text("regenerate without a generator" "${text}" "arm_regenerate: there is no generator")
