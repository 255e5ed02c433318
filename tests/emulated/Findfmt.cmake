include(${CMAKE_CURRENT_LIST_DIR}/header_only.cmake)
add_header_only(fmt::fmt-header-only fmt core.h)
target_compile_definitions(fmt::fmt-header-only INTERFACE FMT_HEADER_ONLY=1)
set(fmt_FOUND TRUE)
