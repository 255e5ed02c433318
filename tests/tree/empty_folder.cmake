# The working folder of every test program: made before them, and found empty after them, since every test writes to a
# scratch folder of its own.
# Usage: cmake -DFOLDER=<folder> -DDO=make|check -P empty_folder.cmake
if(DO STREQUAL "make")
  file(REMOVE_RECURSE ${FOLDER})
  file(MAKE_DIRECTORY ${FOLDER})
  return()
endif()
file(GLOB left RELATIVE ${FOLDER} ${FOLDER}/* ${FOLDER}/.*)
list(REMOVE_ITEM left . ..)
if(left)
  message(FATAL_ERROR "${FOLDER}: found ${left}; allowed: nothing, a test writes to a scratch folder (tests/support)")
endif()
message(STATUS "${FOLDER} is empty")
