# The prefix that the tests of the package share.
include(${CMAKE_CURRENT_LIST_DIR}/../script.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/install_to.cmake)
file(REMOVE_RECURSE ${PREFIX})
install_to(${PREFIX} ${WORK})
