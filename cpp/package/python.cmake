# The Python module, and beside it, where it looks first, the shared library that it loads.
set(python_folder ${CMAKE_INSTALL_LIBDIR}/contct/python)
if(CONTCT_PACKAGES)
  set(python_folder lib/python3/dist-packages)  # of Debian's python3, whatever the processor
endif()
install(FILES ${CMAKE_CURRENT_LIST_DIR}/contct.py DESTINATION ${python_folder} COMPONENT python)
install(TARGETS contct_shared LIBRARY DESTINATION ${python_folder} COMPONENT python NAMELINK_SKIP)
