# What is installed with the program: its manuals, what makes shells complete its words, the problems that it verifies,
# and the pages.
set(pages ${PROJECT_BINARY_DIR}/pages)
set(manual ${pages}/contct.1)
set(file_manuals ${pages}/contct-problem.5 ${pages}/contct-result.5)
set(zsh_functions zsh/site-functions)
if(CONTCT_PACKAGES)  # debian.cmake compresses manuals; Debian's zsh looks in a folder of its own
  list(TRANSFORM manual APPEND .gz)
  list(TRANSFORM file_manuals APPEND .gz)
  set(zsh_functions zsh/vendor-completions)
endif()
# install_program_files(FOLDER FILE...)
function(install_program_files folder)
  install(FILES ${ARGN} DESTINATION ${folder} COMPONENT program)
endfunction()

install(TARGETS contct COMPONENT program)
install_program_files(${CMAKE_INSTALL_MANDIR}/man1 ${manual})
install_program_files(${CMAKE_INSTALL_MANDIR}/man5 ${file_manuals})
install_program_files(${CMAKE_INSTALL_DATADIR}/bash-completion/completions ${pages}/contct)
install_program_files(${CMAKE_INSTALL_DATADIR}/${zsh_functions} ${pages}/_contct)
install_program_files(${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d ${pages}/contct.fish)

# The program reads some of reference/. The pages stand beside README.md as they do here, with links to what it reads.
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
