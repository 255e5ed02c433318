#include "contct/write/run_page.hpp"

#include <array>
#include <stdexcept>
#include <string_view>

#include "contct/text/strings.hpp"

namespace contct::write {

// Files of report/ and reference/parallel-edition.html, built in: embed.cmake writes them.
extern const std::string_view report_html, report_css, report_js, parallel_edition_html;

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
                                            {"{{data}}", page_data_for_script(r)},
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

}  // namespace contct::write
