# cmake -DLISTING=fortran/contct.f -DCHECKSUM=reference/contct.f.sha256 -P checksum.cmake
# Fails unless the SHA-256 of LISTING is the one in CHECKSUM.
get_filename_component(LISTING "${LISTING}" ABSOLUTE)  # a script's working folder is the base of relative names
file(STRINGS "${CHECKSUM}" line LIMIT_COUNT 1)
file(SHA256 "${LISTING}" found)
if(NOT line STREQUAL "${found}  fortran/contct.f")
  message(FATAL_ERROR "The listing has been edited.\n"
    "  file             ${LISTING}\n"
    "  SHA-256 found    ${found}\n"
    "  SHA-256 allowed  ${line}\n"
    "contct.f is the 1989 listing, statement for statement. If it was edited by accident, restore it. If an "
    "erratum was read anew, write it into reference/errata.toml and reference/ERRATA.md, then run "
    "sha256sum fortran/contct.f > reference/contct.f.sha256")
endif()
