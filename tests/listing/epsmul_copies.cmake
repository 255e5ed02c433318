# The copy with another EPSMUL differs from the listing in that literal alone, and is refused where
# the listing has none or two of it.
# Usage: cmake -DLISTING=<contct.f> -DCOPIER=<copy_with.cmake> -DFOLDER=<scratch> -P epsmul_copies.cmake
file(MAKE_DIRECTORY ${FOLDER})

function(copy_of listing copy result words)
  file(REMOVE ${copy})
  execute_process(COMMAND ${CMAKE_COMMAND} -DLISTING=${listing} -DFROM=.390625E-02 -DTO=1.E-9 -DCOPY=${copy}
                          -P ${COPIER}
                  RESULT_VARIABLE status ERROR_VARIABLE said)
  string(REGEX REPLACE "[ \n]+" " " said "${said}")
  set(${result} ${status} PARENT_SCOPE)
  set(${words} "${said}" PARENT_SCOPE)
endfunction()

file(READ ${LISTING} text)
copy_of(${LISTING} ${FOLDER}/copy.f status said)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the listing is not copied: ${said}")
endif()
file(READ ${FOLDER}/copy.f copied)
string(REPLACE "EPSMUL/1.E-9/" "EPSMUL/.390625E-02/" back "${copied}")
if("${copied}" STREQUAL "${text}" OR NOT "${back}" STREQUAL "${text}")
  message(FATAL_ERROR "the copy differs in more, or in less, than EPSMUL")
endif()

string(REPLACE ".390625E-02" ".00390625" none "${text}")
file(WRITE ${FOLDER}/none.f "${none}")
file(WRITE ${FOLDER}/twice.f "${text}C     .390625E-02\n")
foreach(case none:0 twice:2)
  string(REPLACE ":" ";" case ${case})
  list(GET case 0 name)
  list(GET case 1 found)
  copy_of(${FOLDER}/${name}.f ${FOLDER}/${name}_copy.f status said)
  if(status EQUAL 0 OR EXISTS ${FOLDER}/${name}_copy.f)
    message(FATAL_ERROR "a listing with ${found} of the literal is copied")
  endif()
  if(NOT said MATCHES "found \".390625E-02\" ${found} times")
    message(FATAL_ERROR "a listing with ${found} of the literal is refused with other words: ${said}")
  endif()
endforeach()
