#include "contct/write/outputs.hpp"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "contct/text/strings.hpp"
#include "contct/write/result_json.hpp"

namespace contct {

// The files of report/ and reference/parallel-edition.html, which embed.cmake compiles in.
extern const std::string_view report_html, report_css, result_js, picture_js, report_js,
    parallel_edition_html;

namespace {

/// The result as text of an HTML script element: without "<", so that strings cannot act as markup.
std::string script_text(const run_result& r) {
  std::string text;
  output_file out(&text);
  write_result(r, out, result_parts::report);
  std::string safe;
  for (std::string_view rest = text;;) {
    const std::size_t at = rest.find('<');
    safe += rest.substr(0, at);
    if (at == std::string_view::npos) return safe;
    safe += "\\u003c";
    rest.remove_prefix(at + 1);
  }
}

/// The section element of the parallel edition, which is a whole HTML page.
std::string_view edition_section() {
  constexpr std::string_view last = "</section>\n";
  const std::size_t from = parallel_edition_html.find("<section");
  return parallel_edition_html.substr(from, parallel_edition_html.rfind(last) + last.size() - from);
}

}  // namespace

/// Fills the placeholders of the template in their order, so that inserted texts are not searched.
std::string run_page(const run_result& r, bool appendix) {
  const std::string title = markup_text(title_of(r.what, r.file));
  const std::pair<std::string_view, std::string> fillings[] = {
      {"{{title}}", title},
      {"{{style}}", std::string(report_css)},
      {"{{heading}}", title},
      {"{{appendix}}", appendix ? "checked" : ""},
      {"{{edition}}", std::string(edition_section())},
      {"{{data}}", script_text(r)},
      {"{{script}}", std::string(result_js).append(picture_js).append(report_js)}};
  std::string_view rest = report_html;
  std::string page;
  for (const auto& [place, text] : fillings) {
    const std::size_t at = rest.find(place);
    if (at == std::string_view::npos) throw std::logic_error("report.html has no " + std::string(place));
    page.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + place.size());
  }
  return page += rest;
}

void write_outputs(const run& r) {
  const run_outputs& to = r.to;
  if (to.result != nullptr) write_result(r.result, *to.result, to.parts);
  for (output_file* const file : {to.log, to.trace})
    if (file != nullptr) file->finish();
  if (to.increments != nullptr) write_csv(r.result, r.wanted.watched, *to.increments, to.pairs);
  if (to.states != nullptr) write_states_csv(r.result, *to.states);
  if (to.supports != nullptr) write_supports_csv(r.result, *to.supports);
  if (to.envelope != nullptr) write_envelope_csv(r.result, *to.envelope);
  const auto write_all = [](output_file& file, const std::string& text) {
    file.write(text);
    file.finish();
  };
  if (to.proof != nullptr) write_all(*to.proof, proof_json(r.result));
  if (to.page != nullptr) write_all(*to.page, run_page(r.result, r.wanted.appendix));
}

}  // namespace contct
