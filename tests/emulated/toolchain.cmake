# A CMake toolchain for another processor, CONTCT_PROCESSOR, with Debian's cross compilers and qemu-user.
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CONTCT_PROCESSOR)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${CONTCT_PROCESSOR})
set(triple ${CONTCT_PROCESSOR}-linux-gnu)
if(CONTCT_PROCESSOR STREQUAL "ppc64le")
  set(triple powerpc64le-linux-gnu)
endif()
set(CMAKE_C_COMPILER ${triple}-gcc)
set(CMAKE_CXX_COMPILER ${triple}-g++)
set(CMAKE_Fortran_COMPILER ${triple}-gfortran)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${CONTCT_PROCESSOR})
list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})  # Findfmt.cmake, FindCLI11.cmake
