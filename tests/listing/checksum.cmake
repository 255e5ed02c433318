# cmake -DLISTING=fortran/contct.f -DCHECKSUM=reference/contct.f.sha256 -P checksum.cmake
#
# Fails when LISTING is not, byte for byte, the file whose SHA-256 is written in CHECKSUM.

foreach(file IN ITEMS LISTING CHECKSUM)
  if(NOT DEFINED ${file})
    message(FATAL_ERROR "say -D${file}=<file>")
  endif()
  # A script resolves names from its working folder.
  get_filename_component(${file} "${${file}}" ABSOLUTE)
  if(NOT EXISTS "${${file}}")
    message(FATAL_ERROR "there is no ${${file}}")
  endif()
endforeach()

file(STRINGS "${CHECKSUM}" line LIMIT_COUNT 1)
if(NOT line MATCHES "^([0-9a-f]+)  fortran/contct\\.f$")
  message(FATAL_ERROR "${CHECKSUM} is not a line of sha256sum for fortran/contct.f: ${line}")
endif()
set(wanted "${CMAKE_MATCH_1}")
file(SHA256 "${LISTING}" found)

if(NOT found STREQUAL wanted)
  message(FATAL_ERROR "The listing has been edited.\n"
    "  file            ${LISTING}\n"
    "  SHA-256 found   ${found}\n"
    "  SHA-256 wanted  ${wanted}\n"
    "contct.f is the 1989 listing, statement for statement. If it was edited by accident, restore it. If an "
    "erratum was read anew, write it into reference/errata.toml and reference/ERRATA.md, then run "
    "sha256sum fortran/contct.f > reference/contct.f.sha256")
endif()
