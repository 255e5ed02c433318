# Defines the library contct_f2c, the listing translated to C by f2c, if f2c, its header and its library are found.
find_program(CONTCT_F2C_TRANSLATOR NAMES f2c DOC "f2c")
find_path(CONTCT_F2C_HEADER f2c.h)
find_library(CONTCT_F2C_LIBRARY f2c)
mark_as_advanced(CONTCT_F2C_TRANSLATOR CONTCT_F2C_HEADER CONTCT_F2C_LIBRARY)
if(NOT CONTCT_F2C_TRANSLATOR OR NOT CONTCT_F2C_HEADER OR NOT CONTCT_F2C_LIBRARY)
  message(STATUS "f2c, f2c.h or libf2c is not found: no kernel \"f2c\"")
  return()
endif()

# f2c has no preprocessor, so the subroutine is renamed in a copy. With -r8, REAL, literals and DATA have 8 bytes.
set(folder ${CMAKE_CURRENT_BINARY_DIR}/f2c)
add_custom_command(OUTPUT ${folder}/contct_f2c.c
                   COMMAND ${CMAKE_COMMAND} -DLISTING=${CMAKE_CURRENT_SOURCE_DIR}/contct.f "-DFROM=SUBROUTINE CONTCT ("
                           "-DTO=SUBROUTINE F2C8 (" -DCOPY=${folder}/contct_f2c.f
                           -P ${CMAKE_CURRENT_SOURCE_DIR}/copy_with.cmake
                   COMMAND ${CONTCT_F2C_TRANSLATOR} -r8 -d${folder} ${folder}/contct_f2c.f
                   DEPENDS contct.f copy_with.cmake COMMENT "f2c: contct.f" VERBATIM)

add_library(contct_f2c STATIC f2c_calls.c ${folder}/contct_f2c.c)
set_source_files_properties(${folder}/contct_f2c.c PROPERTIES COMPILE_OPTIONS -fcommon)  # COMMON is shared
set_source_files_properties(f2c_calls.c PROPERTIES COMPILE_OPTIONS "-Wall;-Wextra;-Werror")
target_include_directories(contct_f2c SYSTEM PRIVATE ${CONTCT_F2C_HEADER})
target_link_libraries(contct_f2c PRIVATE contct_strict $<BUILD_INTERFACE:${CONTCT_F2C_LIBRARY}> m)
set_target_properties(contct_f2c PROPERTIES POSITION_INDEPENDENT_CODE ON
                      CONTCT_RUNTIME "${CONTCT_F2C_LIBRARY}")  # the installed CMake package names this library

execute_process(COMMAND ${CONTCT_F2C_TRANSLATOR} --version OUTPUT_VARIABLE said ERROR_VARIABLE said)
string(REGEX MATCH "version ([0-9]+)" said "${said}")
set_target_properties(contct_f2c PROPERTIES
  CONTCT_COMPILER "f2c ${CMAKE_MATCH_1}, ${CMAKE_C_COMPILER_ID} ${CMAKE_C_COMPILER_VERSION}")
