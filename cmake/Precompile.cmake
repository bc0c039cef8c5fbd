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

# dyngen_share_precompiled(<name> <target> <header>...): the same, read once for all targets that share the name and
# its headers: the first of them reads.
function(dyngen_share_precompiled name target)
  get_property(first GLOBAL PROPERTY dyngen_precompiled_${name})
  if(NOT first)
    set_property(GLOBAL PROPERTY dyngen_precompiled_${name} ${target})
    dyngen_precompile(${target} ${ARGN})
  elseif(DYNGEN_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${first})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${target} PRIVATE -fpch-preprocess)
    endif()
  endif()
endfunction()
