# From `cmake --install` to the target `uninstall`, in a prefix of its own: both tools, pkg-config and find_package are
# used from there, and afterwards nothing is left but what was there before.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/install_to.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/links.cmake)

# A build folder like the one that installs, but with manifests of this test alone.
set(twin ${WORK}/twin)
run(text 0 ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${twin} -G ${BUILD_TOOL} -DDYNGEN_BUILD_TESTS=OFF
  -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_BUILD_TYPE=${BUILD_TYPE})
build(text ${twin} --target uninstall)
expect_text("before" "${text}" "nothing was installed from this build: ${twin} has no install_manifest.txt")

# Installed in one place, used in another.
set(installed ${WORK}/installed)
set(prefix ${WORK}/prefix)
file(WRITE ${installed}/bin/other "not of dyngen\n")
file(WRITE ${installed}/share/dyngen/robots/mine.robot "not of dyngen\n")
install_to(${installed} ${twin})
file(RENAME ${installed} ${prefix})

# No file says where it was made or installed. Debugging information says the former.
set(places ${installed})
if(BUILD_TYPE MATCHES "^(Release|MinSizeRel)$")
  list(APPEND places ${SOURCE_DIR} ${BUILD})
endif()
list(JOIN places "|" places)
string(REGEX REPLACE "([.+*])" "[\\1]" places "${places}")
file(GLOB_RECURSE files ${prefix}/*)
foreach(file IN LISTS files)
  file(STRINGS ${file} found REGEX "${places}" LIMIT_COUNT 1)
  if(found)
    message(FATAL_ERROR "${file} names a place of this machine: ${found}")
  endif()
endforeach()

# dyngen, with a robot that was installed.
set(robots ${prefix}/share/dyngen/robots)
run(text 0 ${prefix}/bin/dyngen ${robots}/planar2r.robot --prefix planar --functions id -o planar.cpp)

# The example, as its README says.
file(MAKE_DIRECTORY ${WORK}/example)
file(READ ${prefix}/share/dyngen/examples/microcontroller/README.md text)
expect_text("the example" "${text}" "dyngen ../../robots/puma560.robot --prefix mcu_arm --scalar float")
execute_process(COMMAND ${prefix}/bin/dyngen ../../robots/puma560.robot --prefix mcu_arm --scalar float --trig libm
    --functions id_rigid,gravity,friction -o ${WORK}/example/mcu_arm.c
  WORKING_DIRECTORY ${prefix}/share/dyngen/examples/microcontroller COMMAND_ERROR_IS_FATAL ANY)
run(text 0 ${C_COMPILER} -std=c99 -I${WORK}/example -c
  ${prefix}/share/dyngen/examples/microcontroller/arm_control.c -o example/arm_control.o)

# pkg-config, and no CMake: a program that writes a recording.
if(PKG_CONFIG)
  file(GLOB_RECURSE pc ${prefix}/dyngen.pc)
  cmake_path(GET pc PARENT_PATH folder)
  set(ENV{PKG_CONFIG_PATH} ${folder})
  foreach(variable_and_file IN ITEMS "robotsdir share/dyngen/robots" "dyngen bin/dyngen" "dynid bin/dynid")
    separate_arguments(variable_and_file)
    list(GET variable_and_file 0 variable)
    list(GET variable_and_file 1 file)
    run(text 0 ${PKG_CONFIG} --variable=${variable} dyngen)
    string(STRIP "${text}" text)
    file(REAL_PATH "${text}" place)
    file(REAL_PATH ${prefix}/${file} expected)
    if(NOT place STREQUAL expected)
      message(FATAL_ERROR "pkg-config: ${variable} is '${place}', expected '${expected}'")
    endif()
  endforeach()
  run(flags 0 ${PKG_CONFIG} --cflags --libs dyngen)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  run(text 0 ${CXX_COMPILER} -std=c++20 -I${WORK} ${CMAKE_CURRENT_LIST_DIR}/pkg_config/record.cpp planar.cpp
    -o record ${flags})
  run(text 0 ${WORK}/record run.csv)

  # dynid finds in it what the robot file says.
  run(text 0 ${prefix}/bin/dynid fit ${robots}/planar2r.robot run.csv -o identified.robot)
  expect_text("dynid fit" "${text}" "FV2 1.7243" "FS2 2.5288")
  run(text 0 ${prefix}/bin/dyngen identified.robot --prefix identified --functions id -o identified.cpp)
endif()
run(text 0 ${prefix}/bin/dynid --version)
expect_text("dynid" "${text}" "dynid ${VERSION}")

# find_package
configure(text 0 ${WORK}/found -DCMAKE_PREFIX_PATH=${prefix})
build(text ${WORK}/found)
run_programs(${WORK}/found)
file(WRITE ${WORK}/places/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(places NONE)\nfind_package(dyngen 0.1 REQUIRED)\n"
  "get_target_property(dynid dyngen::dynid LOCATION)\nmessage(\"\${dynid} \${dyngen_ROBOTS_DIR}\")\n")
run(text 0 ${CMAKE_COMMAND} -S ${WORK}/places -B ${WORK}/places/build -DCMAKE_PREFIX_PATH=${prefix})
expect_text("find_package" "${text}" "${prefix}/bin/dynid ${robots}")

expect_links(${prefix}/share/doc/dyngen)

# Gone again, but not what others put there.
file(RENAME ${prefix} ${installed})
build(text ${twin} --target uninstall)
expect_text("uninstall" "${text}" "dyngen: removed")
file(GLOB_RECURSE left RELATIVE ${installed} ${installed}/*)
if(NOT "${left}" STREQUAL "bin/other;share/dyngen/robots/mine.robot")
  message(FATAL_ERROR "uninstall left ${left}")
endif()
file(GLOB_RECURSE left LIST_DIRECTORIES true RELATIVE ${installed} ${installed}/*)
list(FILTER left INCLUDE REGEX "dyngen")
if(NOT "${left}" STREQUAL "share/dyngen;share/dyngen/robots;share/dyngen/robots/mine.robot")
  message(FATAL_ERROR "uninstall left ${left}")
endif()
build(text ${twin} --target uninstall)
expect_text("after" "${text}" "nothing was installed from this build")

# One component, staged by DESTDIR, with a blank in a name.
set(stage "${WORK}/a stage")
set(ENV{DESTDIR} "${stage}")
install_to("/opt/the arm" ${twin} --component tool)
if(NOT EXISTS "${stage}/opt/the arm/bin/dynid")
  message(FATAL_ERROR "DESTDIR: dynid is not there")
endif()
unset(ENV{DESTDIR})
build(text ${twin} --target uninstall)
expect_text("without DESTDIR" "${text}" "none is there" "DESTDIR")
set(ENV{DESTDIR} "${stage}")
build(text ${twin} --target uninstall)
expect_text("with DESTDIR" "${text}" "dyngen: removed")
file(GLOB_RECURSE left "${stage}/*")
if(left)
  message(FATAL_ERROR "uninstall left ${left}")
endif()
