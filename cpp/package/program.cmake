# Files installed with the program: completion for bash, the problems of `contct verify`, and the pages.
# install_program_files(FOLDER FILE...): installs files of the component "program".
function(install_program_files folder)
  install(FILES ${ARGN} DESTINATION ${folder} COMPONENT program)
endfunction()

install(TARGETS contct COMPONENT program)
if(TARGET contct_petsc)
  install(TARGETS contct_petsc DESTINATION ${CMAKE_INSTALL_LIBDIR}/contct COMPONENT program)
endif()
install(FILES contct.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME contct COMPONENT program)

# The program reads some files of reference/. The pages are installed next to README.md, as in the source tree, with
# links to these files.
set(reference ${PROJECT_SOURCE_DIR}/reference)
set(installed_reference ${CMAKE_INSTALL_DATADIR}/contct/reference)
set(installed_pages ${CMAKE_INSTALL_DOCDIR}/reference)
install_program_files(${installed_reference} ${reference}/verification.toml)
install(DIRECTORY ${reference}/problems ${reference}/traces DESTINATION ${installed_reference} COMPONENT program)
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/links)
file(RELATIVE_PATH from_pages /${installed_pages} /${installed_reference})
foreach(name problems traces verification.toml)
  file(CREATE_LINK ${from_pages}/${name} ${CMAKE_CURRENT_BINARY_DIR}/links/${name} SYMBOLIC)
  install_program_files(${installed_pages} ${CMAKE_CURRENT_BINARY_DIR}/links/${name})
endforeach()
install(DIRECTORY ${reference}/ DESTINATION ${installed_pages} COMPONENT program
        REGEX "/reference/(problems|traces|verification.toml)$" EXCLUDE PATTERN __pycache__ EXCLUDE)
