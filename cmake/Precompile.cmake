# dyngen_precompile(<target> <header>...): with DYNGEN_PRECOMPILE, large headers of other libraries are read once for
# a target instead of once for each file. Only for speed: every file still includes what it uses.
function(dyngen_precompile target)
  if(DYNGEN_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE ${ARGN})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -fpch-preprocess)  # what ccache needs
    endif()
  endif()
endfunction()
