# Several processes: the same bytes for any number of them, and none hangs.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
set(robot ${SOURCE_DIR}/robots/puma560_3dof.robot)
run(text 0 ${MAKE_FLEET} ${robot} part 5 10 500)
file(WRITE ${WORK}/damaged.csv "time,q1,q2,q3\n0,1,2,3\n")
file(WRITE ${WORK}/bad.txt
  "part/0.csv\nlost.csv\npart/1.csv\ndamaged.csv\npart/2.csv\npart/3.csv\npart/4.csv\n")

# Standard output and errors come through mpirun one beside the other, in any order of their lines.
function(sorted_lines variable text)
  string(REPLACE "\n" ";" lines "${text}")
  list(SORT lines)
  set(${variable} "${lines}" PARENT_SCOPE)
endfunction()

foreach(list IN ITEMS part/list.txt bad.txt)
  cmake_path(GET list STEM name)
  run(alone 0 ${DYNID} fit ${robot} --list ${list} -o ${name}.robot --json ${name}.json)
  foreach(K IN ITEMS 1 2 3)
    run(text 0 ${MPIRUN} -n ${K} ${DYNID} fit ${robot} --list ${list}
      -o ${name}_${K}.robot --json ${name}_${K}.json)
    expect_same_file("${K} processes" ${WORK}/${name}.robot ${WORK}/${name}_${K}.robot)
    expect_same_file("${K} processes" ${WORK}/${name}.json ${WORK}/${name}_${K}.json)
    # what mpirun's libraries say of a machine without /sys, a bare tree for instance
    string(REGEX REPLACE "\\[hwloc/[^\n]*\n" "" text "${text}")
    sorted_lines(lines "${text}")
    sorted_lines(lines_alone "${alone}")
    if(NOT lines STREQUAL lines_alone)
      message(FATAL_ERROR "${list}: ${K} processes print\n${text}\nwithout mpirun:\n${alone}")
    endif()
  endforeach()
endforeach()
expect_text("a bad list" "${text}" "lost.csv: " "damaged.csv:1" "left out: lost.csv, damaged.csv")
expect_same_file("without what is damaged" ${WORK}/list.robot ${WORK}/bad_3.robot)

# More processes than files; recordings on the command line.
run(text 0 ${MPIRUN} -n 3 ${DYNID} fit ${robot} part/0.csv part/1.csv -o few_3.robot)
file(WRITE ${WORK}/few.txt "part/0.csv\npart/1.csv\n")
run(text 0 ${DYNID} fit ${robot} --list few.txt -o few.robot)
expect_same_file("recordings given directly" ${WORK}/few.robot ${WORK}/few_3.robot)

# expect_times(<text> <part> <times>)
function(expect_times text part expected)
  string(REGEX MATCHALL "${part}" found "${text}")
  list(LENGTH found times)
  if(NOT times EQUAL expected)
    message(FATAL_ERROR "'${part}' stands ${times} times, expected ${expected}, in:\n${text}")
  endif()
endfunction()

# What is wrong is said once, and nobody waits for ever.
file(WRITE ${WORK}/bad.robot "name bad\nnumber_link none\n")
run(text 1 ${MPIRUN} -n 3 ${DYNID} fit bad.robot --list part/list.txt)
expect_times("${text}" "bad.robot:2:13: error" 1)
run(text 1 ${MPIRUN} -n 3 ${DYNID} fit ${robot} --list absent.txt)
expect_times("${text}" "cannot read absent.txt" 1)
run(text 2 ${MPIRUN} -n 3 ${DYNID} fit ${robot} --colour red)
expect_times("${text}" "--colour" 1)
file(WRITE ${WORK}/nothing.txt "a.csv\nb.csv\nc.csv\nd.csv\n")
run(text 1 ${MPIRUN} -n 3 ${DYNID} fit ${robot} --list nothing.txt)
expect_times("${text}" "none of the files can be used" 1)
run(text 1 ${MPIRUN} -n 2 ${DYNID} fit ${robot} --list part/list.txt -o no/where.robot)
expect_times("${text}" "no/where.robot" 1)

# A robot file that another host has otherwise: one process each, with its own folder.
file(MAKE_DIRECTORY ${WORK}/one ${WORK}/other)
file(READ ${robot} content)
file(WRITE ${WORK}/one/arm.robot "${content}")
file(WRITE ${WORK}/other/arm.robot "# another\n${content}")
foreach(i RANGE 4)
  file(COPY ${WORK}/part/${i}.csv DESTINATION ${WORK}/one/part)
  file(COPY ${WORK}/part/${i}.csv DESTINATION ${WORK}/other/part)
endforeach()
file(COPY ${WORK}/part/list.txt DESTINATION ${WORK}/one/part)
run(text 1 ${MPIRUN} -n 1 -wdir ${WORK}/one ${DYNID} fit arm.robot --list part/list.txt
  : -n 1 -wdir ${WORK}/other ${DYNID} fit arm.robot --list part/list.txt)
expect_times("${text}" "process 1 has another robot file under the name arm.robot" 1)
file(REMOVE ${WORK}/other/arm.robot)
run(text 1 ${MPIRUN} -n 1 -wdir ${WORK}/one ${DYNID} fit arm.robot --list part/list.txt
  : -n 1 -wdir ${WORK}/other ${DYNID} fit arm.robot --list part/list.txt)
expect_times("${text}" "process 1: arm.robot" 1)

# A process that dies takes the others with it.
run(text 137 ${MPIRUN} -n 1 ${DYNID} fit ${robot} --list part/list.txt : -n 1 sh -c "kill -9 $$")
run(text 3 ${MPIRUN} -n 1 ${DYNID} fit ${robot} --list part/list.txt : -n 1 sh -c "exit 3")

# The list is read by process 0 alone.
file(WRITE ${WORK}/other/arm.robot "${content}")
run(text 0 ${MPIRUN} -n 1 -wdir ${WORK}/one ${DYNID} fit arm.robot --list part/list.txt -o arm.out
  : -n 1 -wdir ${WORK}/other ${DYNID} fit arm.robot --list part/list.txt -o arm.out)
if(EXISTS ${WORK}/other/arm.out)
  message(FATAL_ERROR "process 1 wrote a file")
endif()

# Other commands: once.
run(text 0 ${MPIRUN} -n 2 ${DYNID} accumulate ${robot} part/0.csv -o once.qr)
expect_times("${text}" "written: once.qr" 1)
