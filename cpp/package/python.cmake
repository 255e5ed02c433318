# The Python module, and in the same folder the shared library that it loads.
configure_file(contct.py ${PROJECT_BINARY_DIR}/contct.py COPYONLY)
if(CONTCT_PACKAGES)  # Debian's folder for all processors; only the module uses the library there
  set(python_folder lib/python3/dist-packages)
  install(FILES $<TARGET_FILE:contct_shared> DESTINATION ${python_folder} RENAME libcontct.so COMPONENT python)
else()
  set(python_folder ${CMAKE_INSTALL_LIBDIR})
  install(TARGETS contct_shared EXPORT contct-serve-targets COMPONENT python INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT contct-serve-targets NAMESPACE contct:: DESTINATION ${cmake_files} COMPONENT python)
endif()
install(FILES contct.py DESTINATION ${python_folder} COMPONENT python)

# A module of one file cannot tell type checkers that it has types; a package of stubs with its text can.
file(WRITE ${PROJECT_BINARY_DIR}/py.typed "")
install(FILES contct.py DESTINATION ${python_folder}/contct-stubs RENAME __init__.pyi COMPONENT python)
install(FILES ${PROJECT_BINARY_DIR}/py.typed DESTINATION ${python_folder}/contct-stubs COMPONENT python)

# The prover, a separate package next to the module.
file(GLOB prover RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} CONFIGURE_DEPENDS prove/*.py)
foreach(file IN LISTS prover)
  cmake_path(GET file FILENAME name)
  configure_file(${file} ${PROJECT_BINARY_DIR}/contct_prove/${name} COPYONLY)
endforeach()
install(FILES ${prover} DESTINATION ${python_folder}/contct_prove COMPONENT python)
