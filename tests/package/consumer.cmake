# What the tests of the package share: a copy of the consumer, configured and built.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
file(COPY ${CMAKE_CURRENT_LIST_DIR}/consumer DESTINATION ${WORK})
set(consumer ${WORK}/consumer)

# What stands in the environment must not choose the build tool or the generator.
unset(ENV{CMAKE_GENERATOR})
unset(ENV{DYNGEN_EXECUTABLE})

# configure(<output variable> <expected exit code> <build folder> [-D...])
function(configure output expected folder)
  run(text ${expected} ${CMAKE_COMMAND} -S ${consumer} -B ${folder} -G ${BUILD_TOOL}
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER}
    -DCMAKE_BUILD_TYPE=${BUILD_TYPE} ${ARGN})
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# build(<output variable> <build folder> [--target ...])
function(build output folder)
  run(text 0 ${CMAKE_COMMAND} --build ${folder} --parallel 2 ${ARGN})
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# Runs the programs that were built for this machine.
function(run_programs folder)
  foreach(program IN ITEMS consumer_c consumer_cpp)
    if(EXISTS ${folder}/${program})
      run(text 0 ${folder}/${program})
      expect_text(${program} "${text}" "tau = 29.4300 9.8100")
    endif()
  endforeach()
  if(NOT EXISTS ${folder}/consumer_cpp)
    message(FATAL_ERROR "consumer_cpp was not built in ${folder}")
  endif()
endfunction()

set(generator_option "")
if(NOT HAS_TOOL)
  set(generator_option -DDYNGEN_EXECUTABLE=${DYNGEN})
endif()
