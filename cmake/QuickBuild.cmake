# For `cmake -C cmake/QuickBuild.cmake`: everything built from nothing in the shortest time. By hand it is of use for a
# first build; whoever changes sources builds without it, since a changed file is then compiled alone.
#
# Where the time goes (g++ 12, sources of the runtime): half of it reads and instantiates Eigen's templates, half
# optimises what they become. Many sources in one share the first half; -O3 costs a fifth more than -O2.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "")
set(CMAKE_UNITY_BUILD ON CACHE BOOL "")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 32 CACHE STRING "")
set(DYNGEN_PRECOMPILE ON CACHE BOOL "")

# GNU's compiler collects its garbage from 128 MB on, a tenth of its time: here from 1 GB on.
set(CMAKE_CXX_FLAGS_INIT "" CACHE STRING "")
