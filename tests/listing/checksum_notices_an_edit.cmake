# cmake -DLISTING=... -DCHECKSUM=... -DFOLDER=... -P checksum_notices_an_edit.cmake
#
# Shows that checksum.cmake passes an untouched copy of LISTING and refuses one with a single
# blank more. The copies are made in FOLDER.

set(check "${CMAKE_CURRENT_LIST_DIR}/checksum.cmake")
file(MAKE_DIRECTORY "${FOLDER}")

# The exit status of the check of `copy`, and what it said.
function(check_copy copy status said)
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DLISTING=${copy}" "-DCHECKSUM=${CHECKSUM}" -P "${check}"
                  RESULT_VARIABLE result ERROR_VARIABLE errors)
  set(${status} "${result}" PARENT_SCOPE)
  set(${said} "${errors}" PARENT_SCOPE)
endfunction()

set(untouched "${FOLDER}/untouched.f")
configure_file("${LISTING}" "${untouched}" COPYONLY)
check_copy("${untouched}" status said)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "an untouched copy is refused:\n${said}")
endif()

set(touched "${FOLDER}/edited.f")
configure_file("${LISTING}" "${touched}" COPYONLY)
file(APPEND "${touched}" " ")
check_copy("${touched}" status said)
if(status EQUAL 0)
  message(FATAL_ERROR "an edited copy passes the check")
endif()
if(NOT said MATCHES "The listing has been edited")
  message(FATAL_ERROR "an edited copy is refused for another reason:\n${said}")
endif()
