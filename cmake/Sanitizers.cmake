# dyngen_target_sanitizers(<target>): builds and links it with the sanitizers of DYNGEN_SANITIZE.
set(DYNGEN_LSAN_SUPPRESSIONS ${CMAKE_CURRENT_LIST_DIR}/lsan_suppressions.cpp)
set(DYNGEN_SANITIZER_IGNORELIST ${CMAKE_CURRENT_LIST_DIR}/sanitizer_ignorelist.txt)

function(dyngen_target_sanitizers target)
  if(DYNGEN_SANITIZE)
    target_compile_options(${target} PUBLIC
      -fsanitize=${DYNGEN_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
      # Eigen takes blocks of empty matrices: an offset to a null pointer that is never read
      $<$<COMPILE_LANG_AND_ID:CXX,Clang>:-fno-sanitize=pointer-overflow>
      # only where Eigen's own assertions are on
      $<$<AND:$<COMPILE_LANG_AND_ID:CXX,Clang>,$<CONFIG:Debug>>:-fsanitize-ignorelist=${DYNGEN_SANITIZER_IGNORELIST}>)
    target_link_options(${target} PUBLIC -fsanitize=${DYNGEN_SANITIZE})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE" AND DYNGEN_SANITIZE MATCHES "address")
      target_sources(${target} PRIVATE ${DYNGEN_LSAN_SUPPRESSIONS})
    endif()
  endif()
endfunction()
