# SPDX-License-Identifier: MIT
# Builds the example as its README says, for a Cortex-M4 with single precision, and prints its size.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE failed
    OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${DYNGEN} ${ROBOT} --prefix mcu_arm --scalar float --trig libm --functions id_rigid,gravity,friction
  -o mcu_arm.c)
set(flags -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -std=c99 -Os -ffreestanding
  -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Werror -fstack-usage)
run(${CC} ${flags} -I. -c mcu_arm.c -o mcu_arm.o)
run(${CC} ${flags} -I. -I${EXAMPLE} -c ${EXAMPLE}/arm_control.c -o arm_control.o)
run(${NM} --undefined-only --format=posix mcu_arm.o arm_control.o)
string(REGEX MATCHALL "[A-Za-z_][A-Za-z0-9_]* U" needed "${output}")
foreach(entry IN LISTS needed)
  # __aeabi_dmul and its like would be arithmetic in double
  if(NOT entry MATCHES "^(sinf|cosf|mcu_arm_[a-z_]+) U$")
    message(FATAL_ERROR "found '${entry}', expected sinf, cosf and the example's own alone")
  endif()
endforeach()
run(${SIZE} mcu_arm.o arm_control.o)
message(STATUS "size, bytes:\n${output}")
foreach(object IN ITEMS mcu_arm arm_control)
  # text, data, bss: no static data but constants
  if(NOT output MATCHES "\n *[0-9]+[\t ]+0[\t ]+0[\t ]+[0-9]+[\t ]+[0-9a-f]+[\t ]+${object}.o")
    message(FATAL_ERROR "${object}.o: expected neither initialised nor zeroed static data")
  endif()
  file(READ ${FOLDER}/${object}.su stack)
  message(STATUS "stack, bytes:\n${stack}")
endforeach()
