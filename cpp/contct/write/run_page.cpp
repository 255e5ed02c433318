#include "contct/write/run_page.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "contct/text/markup.hpp"
#include "contct/write/page_data.hpp"
#include "contct/write/report_files.hpp"

namespace contct {
namespace {

/// JSON that no HTML parser takes for markup, whatever its texts hold: in a script element only "<" can
/// begin anything.
std::string embedded(const nlohmann::ordered_json& data) {
  const std::string text = data.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

/// The template's places are filled from its beginning to its end, so what is filled in is not looked at.
std::string run_page(const finished_run& r) {
  struct filling {
    std::string_view place;
    std::string text;
  };
  const std::array<filling, 6> fillings = {{{"{{title}}", markup_text(title_of(r))},
                                            {"{{style}}", std::string(report_css)},
                                            {"{{heading}}", markup_text(title_of(r))},
                                            {"{{edition}}", std::string(parallel_edition_html)},
                                            {"{{data}}", embedded(page_data(r))},
                                            {"{{script}}", std::string(report_js)}}};
  std::string_view rest = report_html;
  std::string page;
  for (const filling& f : fillings) {
    const std::size_t at = rest.find(f.place);
    if (at == std::string_view::npos) throw std::logic_error("report.html has no " + std::string(f.place));
    page += rest.substr(0, at);
    page += f.text;
    rest.remove_prefix(at + f.place.size());
  }
  return page += rest;
}

}  // namespace contct
