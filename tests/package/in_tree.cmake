# A project with dyngen as a subdirectory: it builds the generator it needs, and no more.
include(${CMAKE_CURRENT_LIST_DIR}/consumer.cmake)

# not optimised: building is what is tested; package_installed links the runtime
configure(text 0 ${WORK}/build -DDYNGEN_SOURCE_DIR=${SOURCE_DIR} -DDYNGEN_PRECOMPILE=ON -DCONSUMER_RUNTIME=OFF
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DCMAKE_CXX_COMPILER_LAUNCHER=${CXX_LAUNCHER})
build(text ${WORK}/build)
run_programs(${WORK}/build)
expect_no_text("in tree" "${text}" "puma560.c" "gtest" "dyngen_runtime")
build(text ${WORK}/build)
expect_no_text("second build" "${text}" Generating Building Linking)
# What is installed is for the project to say.
build(text ${WORK}/build --target help)
expect_no_text("in tree" "${text}" uninstall)
