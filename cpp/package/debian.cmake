# Debian packages for cpack, one for each component: contct (program), libcontct-dev (dev), python3-contct (python).
# `cmake --workflow --preset package` makes them; tests/package/debian.sh tests them.
if(NOT CONTCT_BUILD_PROGRAM OR TARGET contct_flang OR TARGET contct_f2c)
  message(FATAL_ERROR "CONTCT_PACKAGES: packages have the program, and the listing as gfortran compiles it. "
                      "Use cmake --workflow --preset package")
endif()
if(NOT CONTCT_DATE)
  message(FATAL_ERROR "reference/CHANGELOG.md: found no entry of version ${PROJECT_VERSION}")
endif()
set(CONTCT_MAINTAINER "The CONTCT project <contct@contct.invalid>" CACHE STRING
    "Name and mail address of who publishes the packages")
if(NOT COMMAND manual)
  message(FATAL_ERROR "CONTCT_PACKAGES: gzip or python3 is not found")
endif()
find_program(CONTCT_DATE_COMMAND date REQUIRED)
mark_as_advanced(CONTCT_DATE_COMMAND)

# date_as(FORMAT RESULT): sets RESULT to the date of this version.
function(date_as format result)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${CONTCT_DATE_COMMAND} -u -d "${CONTCT_DATE}" "+${format}"
                  OUTPUT_VARIABLE text OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()
date_as("%s" epoch)
date_as("%a, %d %b %Y %H:%M:%S +0000" released)

set(CPACK_PACKAGE_NAME contct)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(debian_changelog ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian)
file(CONFIGURE OUTPUT ${debian_changelog} @ONLY CONTENT
"contct (@PROJECT_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) unstable; urgency=medium

  * Version @PROJECT_VERSION@; changelog.gz says what a user notices.

 -- @CONTCT_MAINTAINER@  @released@
")
compress(${debian_changelog} ${debian_changelog}.gz)
compress(${PROJECT_SOURCE_DIR}/reference/CHANGELOG.md ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
add_custom_target(contct_changelogs ALL DEPENDS ${compressed_files})

# package(COMPONENT NAME SECTION DESCRIPTION): sets the data of a package. The first line of DESCRIPTION is the summary.
set(CPACK_COMPONENTS_ALL)
macro(package component name section description)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${description}")
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES ${debian_changelog}.gz ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz DESTINATION ${documents} COMPONENT ${component})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${documents} RENAME copyright COMPONENT ${component})
endmacro()

package(program contct math
"solver for beams and plates on one-sided supports
CONTCT finds the loads at which a beam or plate touches and leaves its
one-sided supports. Its core is a FORTRAN subroutine of 1989, compared bit for
bit with a version in C++. Every final state is certified: the program proves
how far each number can be from the exact solution, or says that it cannot.
The package has manuals, reference problems, a course and all other pages.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)

package(dev libcontct-dev libdevel
"libraries of the contact solver CONTCT for C, C++ and Fortran
Static libraries, headers, CMake and pkg-config files for programs that call
the subroutine CONTCT, or follow the load path of beams and plates with it,
prove error bounds, and read problem files and write results.
C and C++ programs need no Fortran compiler. The Fortran module is gfortran's.")
# The packages of all libraries that contct's libraries link or that contct-config.cmake searches.
string(REGEX MATCH "^[0-9]+" gfortran ${CMAKE_Fortran_COMPILER_VERSION})
set(needed libgfortran-${gfortran}-dev liblapack-dev libblas-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libboost-dev)
if(CONTCT_HAS_CHOLMOD)
  list(APPEND needed libsuitesparse-dev)
endif()
if(CONTCT_HAS_GMP)
  list(APPEND needed libgmp-dev)
endif()
list(JOIN needed ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS gfortran-mod-15)  # the module format of contct_c.mod
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS contct)

package(python python3-contct python
"Python module of the contact solver CONTCT
Runs problems of beams and plates on one-sided supports from Python: the load
path, its exact form, explanations and certificates, with results as NumPy
arrays where NumPy is installed. The module brings the solver as a library and
needs no program beside it.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11)")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "contct, python3-numpy, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/python3-contct/postinst
    ${CMAKE_CURRENT_LIST_DIR}/python3-contct/prerm)

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # the description of each package begins with a summary
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/strip.cmake)
set(CPACK_CONTCT_STRIP ${CMAKE_STRIP})
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CONTCT_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_SOURCE contct)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_BINARY_DIR}/cpack-dates.cmake)
file(CONFIGURE OUTPUT ${CPACK_PROJECT_CONFIG_FILE} @ONLY CONTENT
"if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  set(ENV{SOURCE_DATE_EPOCH} @epoch@)
endif()
")
include(CPack)
