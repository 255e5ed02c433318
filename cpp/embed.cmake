# embed(TARGET NAME FILE...): adds to TARGET a source with the texts of files as constants of namespace contct, such as
# beam_toml for beam.toml, and the table NAME of all names and texts.
function(embed target name)
  set(made ${CMAKE_CURRENT_BINARY_DIR}/generated/${name}.cpp)
  list(JOIN ARGN "," files)
  add_custom_command(OUTPUT ${made} VERBATIM DEPENDS ${ARGN} ${CMAKE_CURRENT_FUNCTION_LIST_FILE}
    COMMAND ${CMAKE_COMMAND} -DFILES=${files} -DNAME=${name} -DMADE=${made} -P ${CMAKE_CURRENT_FUNCTION_LIST_FILE})
  target_sources(${target} PRIVATE ${made})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  return()
endif()
cmake_minimum_required(VERSION 3.25)
set(source "// Made by embed.cmake.\n#include <span>\n#include <string_view>\n#include <utility>\n\nnamespace contct {\n\n")
set(rows "")
string(REPLACE "," ";" files "${FILES}")
foreach(file IN LISTS files)
  cmake_path(GET file FILENAME name)
  string(MAKE_C_IDENTIFIER ${name} variable)
  file(READ ${file} text)
  string(APPEND source "extern const std::string_view ${variable};\nconstexpr std::string_view ${variable} = R\"embedded(${text})embedded\";\n\n")
  string(APPEND rows "\n    {\"${name}\", ${variable}},")
endforeach()
set(row "const std::pair<std::string_view, std::string_view>")
string(APPEND source "static constexpr std::pair<std::string_view, std::string_view> rows[] = {${rows}};\n"
       "extern const std::span<${row}> ${NAME};\nconst std::span<${row}> ${NAME} = rows;\n")
file(WRITE ${MADE} "${source}}  // namespace contct\n")
