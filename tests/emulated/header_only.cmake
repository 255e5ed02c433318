# This system's copy of a library that is all headers, for another processor's compiler: its folder alone,
# because the rest of /usr/include belongs to this system's C library.
function(add_header_only target folder header)
  find_path(${folder}_PARENT ${folder}/${header} PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  set(headers ${CMAKE_BINARY_DIR}/headers)
  file(COPY ${${folder}_PARENT}/${folder} DESTINATION ${headers})
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${headers})
endfunction()
