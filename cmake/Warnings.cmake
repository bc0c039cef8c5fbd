# dyngen_target_options(<target>): the project's warnings and sanitizers for its own C++ code.
function(dyngen_target_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<BOOL:${DYNGEN_WERROR}>:-Werror>
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # GCC 12 is wrong about "text" + std::string (its bug 105651)
  dyngen_target_sanitizers(${target})
endfunction()

# The warnings under which emitted code is silent.
set(DYNGEN_EMITTED_WARNINGS
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion)
