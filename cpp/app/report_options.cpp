#include "app/report_options.hpp"

#include "contct/numeric/probe.hpp"

namespace contct {

void add_report_options(CLI::App& command, report_options& options) {
  command.add_flag("--quiet", options.quiet, "Print nothing but what is wrong");
  command.add_option("--junit", options.junit, "Write a JUnit report to this file (- is standard output)");
  command.add_option("--markdown", options.markdown,
                     "Write a summary in Markdown to this file (- is standard output)");
}

std::vector<output_option> with_reports(std::vector<output_option> others, const report_options& options) {
  others.push_back({"--junit", options.junit});
  others.push_back({"--markdown", options.markdown});
  return others;
}

report_files::report_files(const report_options& options)
    : junit_(open_output({"--junit", options.junit})),
      markdown_(open_output({"--markdown", options.markdown})) {}

void report_files::write(const check_report& report) {
  if (junit_) {
    junit_->write(junit_xml(report));
    junit_->finish();
  }
  if (markdown_) {
    markdown_->write(markdown(report));
    markdown_->finish();
  }
}

std::vector<std::string> common_facts() {
  return {"contct " CONTCT_VERSION, "listing sha256 " CONTCT_LISTING_SHA256,
          "floating point: " + describe(probe_floating_point())};
}

}  // namespace contct
