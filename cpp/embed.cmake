cmake_minimum_required(VERSION 3.25)
# Writes files as string constants of a C++ source.
# Usage: cmake -DFILES=report.html,report.css,report.js -DNAMESPACE=contct -DOUT=report_files.cpp -P embed.cmake
set(source "// Made by embed.cmake.\n#include <string_view>\n\nnamespace ${NAMESPACE} {\n\n")
string(REPLACE "," ";" files "${FILES}")
foreach(file IN LISTS files)
  cmake_path(GET file FILENAME name)
  string(MAKE_C_IDENTIFIER ${name} variable)
  file(READ ${file} text)
  string(APPEND source "extern const std::string_view ${variable};\nconst std::string_view ${variable} = R\"embedded(${text})embedded\";\n\n")
endforeach()
file(WRITE ${OUT} "${source}}  // namespace ${NAMESPACE}\n")
