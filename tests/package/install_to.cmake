# install_to(<prefix> <folder> [<option of cmake --install> ...]): installs this build. The manifest goes to the folder.
# One test at a time; a manifest that lies in the build folder stays: somebody may want to uninstall by it.
function(install_to prefix folder)
  file(LOCK ${BUILD}/tests/package/install.lock GUARD FUNCTION TIMEOUT 600)
  file(MAKE_DIRECTORY ${folder} ${WORK}/kept)
  _move_manifests(${BUILD} ${WORK}/kept)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix} ${ARGN}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  _move_manifests(${BUILD} ${folder})
  _move_manifests(${WORK}/kept ${BUILD})
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "cmake --install ended with ${code}:\n${text}")
  endif()
endfunction()

function(_move_manifests from to)
  file(GLOB manifests ${from}/install_manifest*.txt)
  foreach(manifest IN LISTS manifests)
    cmake_path(GET manifest FILENAME name)
    file(RENAME ${manifest} ${to}/${name})
  endforeach()
endfunction()
