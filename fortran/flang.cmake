# Defines the library contct_flang, the listing and contct_c.f90 compiled by LLVM's flang, if flang and its run-time
# libraries are found. CMake supports one FORTRAN compiler at a time, which is gfortran, so flang is called directly.
find_program(CONTCT_FLANG_COMPILER NAMES flang-new-16 DOC "LLVM 16's flang")
mark_as_advanced(CONTCT_FLANG_COMPILER)
if(NOT CONTCT_FLANG_COMPILER)
  message(STATUS "flang-new-16 is not found: no kernel \"flang\"")
  return()
endif()
file(REAL_PATH ${CONTCT_FLANG_COMPILER} flang)  # the libraries are in ../lib
cmake_path(GET flang PARENT_PATH flang_folder)
find_library(CONTCT_FLANG_RUNTIME FortranRuntime HINTS ${flang_folder}/../lib)
find_library(CONTCT_FLANG_DECIMAL FortranDecimal HINTS ${flang_folder}/../lib)
mark_as_advanced(CONTCT_FLANG_RUNTIME CONTCT_FLANG_DECIMAL)
if(NOT CONTCT_FLANG_RUNTIME OR NOT CONTCT_FLANG_DECIMAL)
  message(STATUS "flang's run-time libraries are not found: no kernel \"flang\"")
  return()
endif()

set(folder ${CMAKE_CURRENT_BINARY_DIR}/flang)
file(MAKE_DIRECTORY ${folder})
set(flang_objects)
function(add_flang_object name source)
  set(object ${folder}/${name}.o)
  add_custom_command(OUTPUT ${object}
                     COMMAND ${CONTCT_FLANG_COMPILER} -c -cpp -O2 -fPIC -ffp-contract=off -module-dir ${folder} ${ARGN}
                             ${source} -o ${object}
                     WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}  # flang stores this relative path
                     DEPENDS ${source} COMMENT "flang: ${name}" VERBATIM)
  list(APPEND flang_objects ${object})
  set(flang_objects ${flang_objects} PARENT_SCOPE)
endfunction()

add_flang_object(listing_r4 contct.f -DCONTCT=FLANG4)
add_flang_object(listing_r8 contct.f -DCONTCT=FLANG8 -fdefault-real-8)
set(renamed -Dcontc4=flang4 -Dcontc8=flang8)
foreach(name call_r4 call_r8 log_open log_flush log_rewind log_close)
  list(APPEND renamed -Dcontct_${name}=contct_flang_${name})
endforeach()
add_flang_object(calls contct_c.f90 ${renamed})

add_library(contct_flang STATIC ${flang_objects})
set_target_properties(contct_flang PROPERTIES LINKER_LANGUAGE CXX)
set(flang_runtime ${CONTCT_FLANG_RUNTIME} ${CONTCT_FLANG_DECIMAL})
target_link_libraries(contct_flang PRIVATE "$<BUILD_INTERFACE:${flang_runtime}>")
set_target_properties(contct_flang PROPERTIES CONTCT_RUNTIME "${flang_runtime}")  # installed CMake files name these

execute_process(COMMAND ${CONTCT_FLANG_COMPILER} --version OUTPUT_VARIABLE said)
string(REGEX MATCH "version ([0-9.]+)" said "${said}")
set_target_properties(contct_flang PROPERTIES CONTCT_COMPILER "flang ${CMAKE_MATCH_1}")
