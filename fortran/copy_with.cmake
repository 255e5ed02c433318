# Copies the listing with FROM replaced by TO, such as the subroutine's name for a compiler without a preprocessor.
# Fails unless the listing contains FROM exactly once.
# Usage: cmake -DLISTING=<contct.f> -DFROM=<text> -DTO=<text> -DCOPY=<file> -P copy_with.cmake
file(READ "${LISTING}" text)
string(REPLACE "${FROM}" "" without "${text}")
string(LENGTH "${text}" length)
string(LENGTH "${without}" length_without)
string(LENGTH "${FROM}" length_of_one)
math(EXPR found "(${length} - ${length_without}) / ${length_of_one}")
if(NOT found EQUAL 1)
  message(FATAL_ERROR "${LISTING}: found \"${FROM}\" ${found} times; allowed: exactly once")
endif()
string(REPLACE "${FROM}" "${TO}" text "${text}")
file(WRITE "${COPY}" "${text}")
