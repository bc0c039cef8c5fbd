# Settings for `cmake -C cmake/QuickBuild.cmake`: everything from nothing in the shortest time. The scripts of this
# project build with them. Whoever changes sources builds without them, since then a changed file is compiled alone.
#
# With g++ 12, half of the time of the runtime's sources goes into reading and instantiating Eigen's templates, which
# sources that are compiled together share; the other half goes into optimising, where -O3 takes a quarter more than -O2.
set(CMAKE_BUILD_TYPE Release CACHE STRING "Kind of build")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of the kind of build")
set(CMAKE_C_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "Flags of the kind of build")
# Both scripts build in one folder: what the demo compiled, the tests do not compile again.
if(NOT DEFINED ENV{CMAKE_CXX_COMPILER_LAUNCHER})
  find_program(ccache ccache NO_CACHE)
  if(ccache)
    set(CMAKE_C_COMPILER_LAUNCHER ${ccache} CACHE STRING "What calls the compiler")
    set(CMAKE_CXX_COMPILER_LAUNCHER ${ccache} CACHE STRING "What calls the compiler")
  endif()
endif()
set(CMAKE_UNITY_BUILD ON CACHE BOOL "Compile several sources together")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 32 CACHE STRING "How many sources are compiled together")
set(DYNGEN_PRECOMPILE ON CACHE BOOL "Precompile headers of other libraries")
set(DYNGEN_ROOMY_COMPILER ON CACHE BOOL "Let GNU's compiler use 1 GB before it collects its garbage")
