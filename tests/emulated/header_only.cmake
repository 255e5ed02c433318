# add_header_only(TARGET FOLDER HEADER): gives another processor's compiler a copy of this system's header-only library.
# Only the folder is copied, because the other headers of /usr/include belong to this system's C library.
function(add_header_only target folder header)
  find_path(${folder}_PARENT ${folder}/${header} PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  set(headers ${CMAKE_BINARY_DIR}/headers)
  file(COPY ${${folder}_PARENT}/${folder} DESTINATION ${headers})
  add_library(${target} INTERFACE IMPORTED)
  target_include_directories(${target} SYSTEM INTERFACE ${headers})
endfunction()
