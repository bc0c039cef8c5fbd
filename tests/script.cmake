# What the test scripts (cmake -P) share. Each gets WORK, a folder of its own, empty at the start.

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")

# run(<output variable> <expected exit code> <command> ...): stops the test if the command ends otherwise.
# The output is what it printed on both streams.
function(run output expected)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${WORK}"
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code STREQUAL expected)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${text}\nended with ${code}, expected ${expected}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# expect_text(<where> <text> <part> ...): every part stands in the text; line breaks and runs of blanks count as one.
function(expect_text where text)
  string(REGEX REPLACE "[ \n]+" " " flat "${text}")
  foreach(part IN LISTS ARGN)
    string(FIND "${flat}" "${part}" place)
    if(place EQUAL -1)
      message(FATAL_ERROR "${where}: expected '${part}' in:\n${text}")
    endif()
  endforeach()
endfunction()

# expect_no_text(<where> <text> <part> ...): no part stands in the text.
function(expect_no_text where text)
  foreach(part IN LISTS ARGN)
    string(FIND "${text}" "${part}" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${where}: did not expect '${part}' in:\n${text}")
    endif()
  endforeach()
endfunction()

# expect_files(<where> <folder> <name> ...): the folder holds these files and no others.
function(expect_files where folder)
  file(GLOB found RELATIVE "${folder}" "${folder}/*")
  list(SORT found)
  set(expected ${ARGN})
  list(SORT expected)
  if(NOT "${found}" STREQUAL "${expected}")
    message(FATAL_ERROR "${where}: ${folder} holds '${found}', expected '${expected}'")
  endif()
endfunction()

# expect_same_file(<where> <one> <other>)
function(expect_same_file where one other)
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files "${one}" "${other}" RESULT_VARIABLE code
    OUTPUT_QUIET ERROR_QUIET)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${where}: ${one} and ${other} differ")
  endif()
endfunction()
