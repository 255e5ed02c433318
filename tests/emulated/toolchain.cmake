# Another processor, by Debian's cross compilers; its programs run under qemu-user. CONTCT_PROCESSOR says which.
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

# Static, so that qemu needs nothing of that system. libgfortran's references to the thread functions are weak:
# they do not bring them in, and a program that has some of them calls the others at address 0.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
foreach(function mutex_init mutex_destroy mutex_lock mutex_trylock mutex_unlock cond_init cond_destroy cond_wait
                 cond_broadcast create join self key_create key_delete getspecific setspecific)
  string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,-u,pthread_${function}")
endforeach()
