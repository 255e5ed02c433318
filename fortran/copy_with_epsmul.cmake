# Copies the listing with another EPSMUL: its one literal replaced, every other character kept.
# Fails unless the literal is there exactly once.
# Usage: cmake -DLISTING=<contct.f> -DEPSMUL=<literal> -DCOPY=<file> -P copy_with_epsmul.cmake
set(literal ".390625E-02")
file(READ "${LISTING}" text)
string(REPLACE "${literal}" "" without "${text}")
string(LENGTH "${text}" length)
string(LENGTH "${without}" length_without)
string(LENGTH "${literal}" length_of_literal)
math(EXPR found "(${length} - ${length_without}) / ${length_of_literal}")
if(NOT found EQUAL 1)
  message(FATAL_ERROR "${LISTING}: found the literal ${literal} ${found} times; allowed: exactly once")
endif()
string(REPLACE "${literal}" "${EPSMUL}" text "${text}")
file(WRITE "${COPY}" "${text}")
