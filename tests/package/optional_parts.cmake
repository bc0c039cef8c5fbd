# The project on machines without optional packages: it configures, says what it leaves out, and which package brings it.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)

# configure_dyngen(<output variable> <expected exit code> <folder> [-D...])
function(configure_dyngen output expected folder)
  run(text ${expected} ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK}/${folder} -G ${BUILD_TOOL}
    -DCMAKE_C_COMPILER=${C_COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} ${ARGN})
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# A module that makes its target without finding anything, as CMake's FindMPI does.
file(WRITE ${WORK}/modules/FindMPI.cmake
  "set(MPI_C_FOUND FALSE)\nset(MPIEXEC_EXECUTABLE mpiexec)\nadd_library(MPI::MPI_C INTERFACE IMPORTED)\n")
set(nothing -DCMAKE_MODULE_PATH=${WORK}/modules)
foreach(package IN ITEMS OpenBLAS ZLIB Boost nlohmann_json Ceres NLopt GTest SQLite3 BZip2)
  list(APPEND nothing -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

# Of what is found by pkg-config: the generator's libraries alone.
find_program(pkg_config pkg-config)
if(NOT pkg_config)
  message(FATAL_ERROR "this needs pkg-config")
endif()
foreach(module IN ITEMS ginac cln)
  execute_process(COMMAND ${pkg_config} --variable=pcfiledir ${module} OUTPUT_VARIABLE folder
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  file(COPY ${folder}/${module}.pc DESTINATION ${WORK}/pkgconfig)
endforeach()
set(ENV{PKG_CONFIG_LIBDIR} ${WORK}/pkgconfig)
set(ENV{PKG_CONFIG_PATH} "")
configure_dyngen(text 0 nothing ${nothing})
unset(ENV{PKG_CONFIG_LIBDIR})
foreach(package IN ITEMS libopenblas-pthread-dev zlib1g-dev libboost-dev nlohmann-json3-dev libceres-dev libnlopt-dev
    libopenmpi-dev libmatio-dev libhdf5-dev libzip-dev libsqlite3-dev liblz4-dev libzstd-dev libbz2-dev)
  expect_text("without packages" "${text}" "left out ${package}: ")
endforeach()
expect_text("without packages" "${text}" "left out libgtest-dev libgmock-dev nlohmann-json3-dev: the tests")

# Tests that were asked for are not left out.
configure_dyngen(text 1 asked ${nothing} -DDYNGEN_BUILD_TESTS=ON)
expect_text("tests asked for" "${text}" "apt-get install libgtest-dev libgmock-dev nlohmann-json3-dev"
  "-DDYNGEN_BUILD_TESTS=OFF")

# With the tests, MPI alone is absent.
configure_dyngen(text 0 tests -DCMAKE_MODULE_PATH=${WORK}/modules -DDYNGEN_BUILD_TESTS=ON)
expect_text("without MPI" "${text}" "left out libopenmpi-dev: ")
file(READ ${WORK}/tests/tests/fleet/CTestTestfile.cmake fleet)
expect_no_text("without MPI" "${fleet}" "fleet_processes")
