# The working folder of every test program: made before them, and found empty after them, since every test writes to a
# scratch folder of its own.
# Usage: cmake -DFOLDER=<folder> -DDO=make -P empty_folder.cmake
#        cmake -DFOLDER=<folder> -DDO=check [-DCTEST=<ctest> -DBUILD=<build folder> -DLEAST=<tests>] -P empty_folder.cmake
# With CTEST fails also when fewer than LEAST tests have the folder as their working folder.
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
set(count 0)
if(CTEST)
  execute_process(COMMAND ${CTEST} --show-only=json-v1 WORKING_DIRECTORY ${BUILD} OUTPUT_VARIABLE tests
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "\"value\" : \"${FOLDER}\"" found "${tests}")
  list(LENGTH found count)
  if(count LESS LEAST)
    message(FATAL_ERROR "found ${count} tests whose working folder is ${FOLDER}; allowed: ${LEAST} or more")
  endif()
endif()
message(STATUS "${FOLDER} is empty; ${count} tests have it as their working folder")
