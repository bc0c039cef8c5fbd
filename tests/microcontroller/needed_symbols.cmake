# SPDX-License-Identifier: MIT
# What the libraries need of others: sines and cosines of libm at most, and each other.
execute_process(COMMAND ${NM} --undefined-only --format=posix ${LIBRARIES}
  OUTPUT_VARIABLE undefined RESULT_VARIABLE failed)
execute_process(COMMAND ${NM} --defined-only --format=posix ${LIBRARIES} OUTPUT_VARIABLE defined)
if(failed)
  message(FATAL_ERROR "nm failed")
endif()
if(NOT undefined MATCHES "mcu_arm_gravity U")
  message(FATAL_ERROR "found no call of mcu_arm_gravity: nm's output is not understood\n${undefined}")
endif()
string(REGEX MATCHALL "[A-Za-z_][A-Za-z0-9_]* U" needed "${undefined}")
foreach(entry IN LISTS needed)
  string(REPLACE " U" "" symbol "${entry}")
  if(symbol MATCHES "^(sinf|cosf|fabsf|floorf|rintf|nearbyintf)$" OR defined MATCHES "(^|\n)${symbol} T")
    continue()
  endif()
  message(FATAL_ERROR "found the undefined symbol ${symbol}, expected none but libm's")
endforeach()
