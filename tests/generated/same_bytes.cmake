# dyngen writes the same bytes on every run. Addresses change from run to run, and with them GiNaC's term order.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)

set(randomised unknown)
if(EXISTS /proc/sys/kernel/randomize_va_space)
  file(READ /proc/sys/kernel/randomize_va_space randomised)
  string(STRIP "${randomised}" randomised)
endif()
if(NOT randomised EQUAL 2)
  message(STATUS "address randomisation is not on (${randomised}): this test proves less")
endif()

foreach(k RANGE 1 5)
  file(MAKE_DIRECTORY ${WORK}/${k})
  run(text 0 ${DYNGEN} ${ROBOT} -o ${WORK}/${k}/robot.c --parameters runtime
    --cpp-wrapper --search 20000)
  run(text 0 ${DYNGEN} ${ROBOT} -o ${WORK}/${k}/baked.c --search 20000)
  foreach(file IN ITEMS robot.c robot.h robot.hpp baked.c baked.h)
    expect_same_file("run ${k}" ${WORK}/1/${file} ${WORK}/${k}/${file})
  endforeach()
endforeach()
