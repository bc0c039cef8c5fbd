# dyngen_target_options(<target>): the project's warnings and sanitizers for its own C++ code.
function(dyngen_target_options target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion $<$<BOOL:${DYNGEN_WERROR}>:-Werror>
    # GCC before 13 is wrong about "text" + std::string (its bug 105651): it takes a branch of std::string::insert for real
    # that is only there for text which is part of the string itself
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;$<$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>:-Wno-stringop-overflow>>")
  dyngen_target_sanitizers(${target})
endfunction()

# The warnings under which emitted code is silent.
set(DYNGEN_EMITTED_WARNINGS
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion)
