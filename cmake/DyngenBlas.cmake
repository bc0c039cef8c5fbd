# The target dyngen::blas, where the machine has OpenBLAS: what its package says. libopenblas-serial-dev may not be used by
# several threads at once, which the runtime sees when it runs; libopenblas-pthread-dev may.
find_package(OpenBLAS QUIET CONFIG)
if(OpenBLAS_FOUND AND NOT TARGET dyngen::blas)
  add_library(dyngen::blas INTERFACE IMPORTED GLOBAL)
  target_link_libraries(dyngen::blas INTERFACE ${OpenBLAS_LIBRARIES})
endif()
