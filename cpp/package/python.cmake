# The Python module, and beside it, where it looks first, the shared library that it loads.
configure_file(contct.py ${PROJECT_BINARY_DIR}/contct.py COPYONLY)
if(CONTCT_PACKAGES)  # the folder of Debian's python3, whatever the processor; the library is the module's own
  set(python_folder lib/python3/dist-packages)
  install(TARGETS contct_shared LIBRARY DESTINATION ${python_folder} COMPONENT python NAMELINK_SKIP)
else()
  set(python_folder ${CMAKE_INSTALL_LIBDIR})
  install(TARGETS contct_shared COMPONENT python)
endif()
install(FILES contct.py DESTINATION ${python_folder} COMPONENT python)
