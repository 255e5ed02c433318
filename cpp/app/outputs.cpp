#include "app/outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "contct/numeric/probe.hpp"

namespace contct::app {

std::vector<output_option> with_reports(std::vector<output_option> others, const report_options& options) {
  others.push_back({"--junit", options.junit});
  others.push_back({"--markdown", options.markdown});
  return others;
}

void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs) {
  std::vector<output_option> others = {{"standard output", "/dev/fd/1"}};
  for (const output_option& i : inputs) others.push_back({i.name, i.path == "-" ? "/dev/fd/0" : i.path});
  const char* standard = nullptr;
  for (const output_option& o : outputs) {
    if (o.path == "-") {
      if (standard != nullptr)
        throw std::invalid_argument(fmt::format("{} and {} cannot both be -", standard, o.name));
      standard = o.name;
      continue;
    }
    if (o.path.empty()) continue;
    for (const output_option& other : others) {
      if (same_file(o.path, other.path)) {
        throw std::invalid_argument(fmt::format("{} {}: found the file of {}; allowed: a file of its own",
                                                o.name, o.path, other.name));
      }
    }
    others.push_back(o);
  }
}

bool takes_standard_output(const std::vector<output_option>& outputs) {
  return std::any_of(outputs.begin(), outputs.end(), [](const output_option& o) { return o.path == "-"; });
}

std::unique_ptr<output_file> open_output(const output_option& o) {
  return o.path.empty() ? nullptr : std::make_unique<output_file>(o.path);
}

void write_whole(const std::unique_ptr<output_file>& file, std::string_view text) {
  if (!file) return;
  file->write(text);
  file->finish();
}

report_files::report_files(const report_options& options)
    : junit_(open_output({"--junit", options.junit})),
      markdown_(open_output({"--markdown", options.markdown})) {}

void report_files::write(const check_report& report) {
  if (junit_) write_whole(junit_, junit_xml(report));
  if (markdown_) write_whole(markdown_, markdown(report));
}

std::vector<std::string> common_facts() {
  return {"contct " CONTCT_VERSION, "listing sha256 " CONTCT_LISTING_SHA256,
          "floating point: " + describe(probe_floating_point())};
}

}  // namespace contct::app
