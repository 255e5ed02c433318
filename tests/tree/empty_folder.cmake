# Makes the working folder of the test programs, or checks that it is empty after them, since every test must write to a
# scratch folder.
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
