# dyngen_precompile(<target> <header>...): with DYNGEN_PRECOMPILE, large headers of other libraries are read once for
# a target instead of once for each file. Only for speed: every file still includes what it uses.
# Not for a target whose sources are compiled in one group: writing what was read takes longer than reading it.
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

# GNU's compiler collects its garbage whenever its memory has doubled, a tenth of its time. With DYNGEN_ROOMY_COMPILER
# it does so from 1 GB on.
option(DYNGEN_ROOMY_COMPILER "Let GNU's compiler use 1 GB before it collects its garbage" OFF)
if(DYNGEN_ROOMY_COMPILER AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-expand=400>
    $<$<COMPILE_LANGUAGE:CXX>:--param=ggc-min-heapsize=1000000>)
endif()
