# A project that finds dyngen in an install prefix, of C and C++, and of C++ alone.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

configure(text 0 ${WORK}/both -DCMAKE_PREFIX_PATH=${PREFIX} ${generator_option})
build(text ${WORK}/both)
run_programs(${WORK}/both)
expect_text(consumer_cpp "${text}" "Generating arm.c and arm.h from arm.robot")
run(text 0 ${WORK}/both/consumer_cpp)
expect_text(consumer_cpp "${text}" "runtime: arm has 2 joints")

configure(text 0 ${WORK}/cxx -DCMAKE_PREFIX_PATH=${PREFIX} -DCONSUMER_LANGUAGES=CXX ${generator_option})
build(text ${WORK}/cxx)
run_programs(${WORK}/cxx)

# Nothing was written beside the sources.
expect_files("the consumer" ${consumer} CMakeLists.txt arm.robot main.c main.cpp)

# The package says its version.
configure(text 0 ${WORK}/both -DCMAKE_PREFIX_PATH=${PREFIX})
file(WRITE ${WORK}/new/CMakeLists.txt
  "cmake_minimum_required(VERSION 3.25)\nproject(new NONE)\nfind_package(dyngen 0.9 REQUIRED)\n")
run(text 1 ${CMAKE_COMMAND} -S ${WORK}/new -B ${WORK}/new/build -DCMAKE_PREFIX_PATH=${PREFIX})
expect_text("version" "${text}" "compatible with requested version \"0.9\"")
