# Every header of gen/ and runtime/ is included by one source, in alphabetical order or in the reverse one. Two types of
# one name do not compile, and a name within another's scope that hides one of the namespace is a warning, which is an
# error here. Otherwise these come to light, or do not, with the sources that a build happens to compile together.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)

file(GLOB_RECURSE headers RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/gen/*.h ${SOURCE_DIR}/runtime/*.h)
list(SORT headers)
if(ORDER STREQUAL backward)
  list(REVERSE headers)
endif()
list(TRANSFORM headers PREPEND "#include \"")
list(TRANSFORM headers APPEND "\"\n")
list(LENGTH headers count)
if(count LESS 100)
  message(FATAL_ERROR "${count} headers in ${SOURCE_DIR}/gen and ${SOURCE_DIR}/runtime: expected some hundreds")
endif()
file(WRITE ${WORK}/together.cpp ${headers})

set(system "")
foreach(folder IN LISTS SYSTEM_FOLDERS)
  if(IS_DIRECTORY "${folder}")
    list(APPEND system -isystem ${folder})
  endif()
endforeach()
run(text 0 ${CXX_COMPILER} -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Werror -I${SOURCE_DIR} ${system}
  ${WORK}/together.cpp)
message("${count} headers, ${ORDER}")
