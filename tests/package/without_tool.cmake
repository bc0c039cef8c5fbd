# A prefix with the component `runtime` alone, as in a sysroot: the package is found, the generator is not.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

file(COPY ${PREFIX}/ DESTINATION ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK}/prefix/bin)
file(GLOB_RECURSE export_files ${WORK}/prefix/dyngenToolTargets*.cmake)
if(export_files)
  file(REMOVE ${export_files})
endif()
configure(text 1 ${WORK}/none -DCMAKE_PREFIX_PATH=${WORK}/prefix)
expect_text("no generator" "${text}" "dyngen_add_robot(arm): there is no generator (none is installed)"
  "DYNGEN_EXECUTABLE" "CHECKED_IN")
configure(text 0 ${WORK}/told -DCMAKE_PREFIX_PATH=${WORK}/prefix -DDYNGEN_EXECUTABLE=${DYNGEN})
build(text ${WORK}/told)
run_programs(${WORK}/told)
