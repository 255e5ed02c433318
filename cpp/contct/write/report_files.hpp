// The files of io/report, built into the library.
#pragma once

#include <string_view>

namespace contct {

extern const std::string_view report_html;
extern const std::string_view report_css;
extern const std::string_view report_js;
extern const std::string_view parallel_edition_html;  ///< reference/parallel-edition.html

}  // namespace contct
