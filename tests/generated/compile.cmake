# The code of ROBOT compiles without a word in every variant, with every compiler, as C99 and as C++20.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
string(REPLACE "," ";" COMPILERS "${COMPILERS}")
string(REPLACE "," ";" WARNINGS "${WARNINGS}")

foreach(variant IN ITEMS "baked;double" "runtime;float")
  list(GET variant 0 parameters)
  list(GET variant 1 scalar)
  set(source ${WORK}/${parameters}_${scalar}.c)
  run(text 0 ${DYNGEN} ${ROBOT} --search 0 -o ${source} --parameters ${parameters} --scalar ${scalar})
  foreach(compiler IN LISTS COMPILERS)
    foreach(language IN ITEMS "-std=c99" "-xc++;-std=c++20")
      # -O1: some warnings come from the optimiser's view of the code
      run(text 0 ${LAUNCHER} ${compiler} ${language} -O1 ${WARNINGS} -Werror -c ${source} -o ${WORK}/code.o)
      if(NOT text STREQUAL "")
        message(FATAL_ERROR "${compiler} ${language} ${source} is not silent:\n${text}")
      endif()
    endforeach()
  endforeach()
endforeach()

# The same with the sines and cosines of the C library.
foreach(scalar IN ITEMS double float)
  run(text 0 ${DYNGEN} ${ROBOT} --search 0 -o ${WORK}/libm.c --trig libm --scalar ${scalar}
    --functions id,fk,id_batch)
  foreach(compiler IN LISTS COMPILERS)
    run(text 0 ${LAUNCHER} ${compiler} -std=c99 -O1 ${WARNINGS} -Werror -c ${WORK}/libm.c -o ${WORK}/code.o)
  endforeach()
endforeach()

# Each function alone: nothing in the file that only the others need.
foreach(function IN ITEMS id gravity coriolis friction gravity_batch friction_batch)
  run(text 0 ${DYNGEN} ${ROBOT} --search 0 -o ${WORK}/alone.c --functions ${function})
  foreach(compiler IN LISTS COMPILERS)
    run(text 0 ${LAUNCHER} ${compiler} -std=c99 ${WARNINGS} -Werror -c ${WORK}/alone.c -o ${WORK}/code.o)
  endforeach()
endforeach()
