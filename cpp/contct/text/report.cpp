#include "contct/text/report.hpp"

#include <algorithm>
#include <cstdio>

#include "contct/text/markup.hpp"

namespace contct::text {
namespace {

/// An attribute with a blank before it. XML takes a line's end in it for a blank unless it is a reference.
std::string attribute(std::string_view name, std::string_view value) {
  std::string text(" ");
  text.append(name).append("=\"");
  for (const char ch : markup_text(value)) {
    if (ch == '\n') {
      text += "&#10;";
    } else {
      text += ch;
    }
  }
  return text + "\"";
}

/// Text in a cell of a Markdown table.
std::string in_cell(std::string_view text) {
  std::string out;
  for (const char ch : text) {
    if (ch == '|' || ch == '\\' || ch == '`' || ch == '<') out += '\\';
    out += ch == '\n' ? ' ' : ch;
  }
  return out;
}

std::string seconds_of(double seconds) {
  char text[40];
  (void)std::snprintf(text, sizeof text, "%.3f", seconds);
  return text;
}

std::string_view word_of(outcome o) {
  constexpr std::string_view words[] = {"passed", "**failed**", "skipped"};
  return words[static_cast<int>(o)];
}

}  // namespace

std::int64_t check_report::count(outcome o) const {
  return std::count_if(results.begin(), results.end(), [o](const check_result& c) { return c.what == o; });
}

std::string junit_xml(const check_report& r) {
  const std::string counts = attribute("tests", std::to_string(r.results.size())) +
                             attribute("failures", std::to_string(r.count(outcome::failed))) +
                             attribute("errors", "0") +
                             attribute("skipped", std::to_string(r.count(outcome::skipped))) +
                             attribute("time", seconds_of(r.seconds));
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + counts + ">\n  <testsuite" +
                    attribute("name", r.command) + counts + ">\n    <properties>\n";
  for (const std::string& fact : r.facts)
    xml += "      <property" + attribute("name", "fact") + attribute("value", fact) + "/>\n";
  xml += "    </properties>\n";
  for (const check_result& c : r.results) {
    const std::string message = attribute("message", c.summary);
    xml += "    <testcase" + attribute("classname", r.command) + attribute("name", c.name) + ">\n";
    if (c.what == outcome::failed)
      xml += "      <failure" + message + ">" + markup_text(c.details) + "</failure>\n";
    if (c.what == outcome::skipped) xml += "      <skipped" + message + "/>\n";
    xml += "      <system-out>" + markup_text(c.summary) + "</system-out>\n    </testcase>\n";
  }
  return xml + "  </testsuite>\n</testsuites>\n";
}

std::string markdown(const check_report& r) {
  const std::int64_t failed = r.count(outcome::failed);
  std::string text = "## " + r.command + ": " + (failed == 0 ? "passed" : "failed") + "\n\n";
  text += std::to_string(r.count(outcome::passed)) + " passed, " + std::to_string(failed) + " failed, " +
          std::to_string(r.count(outcome::skipped)) + " skipped\n\n";
  for (const std::string& fact : r.facts) text += "- " + in_cell(fact) + "\n";
  text += "\n| what | result | |\n| --- | --- | --- |\n";
  for (const check_result& c : r.results) {
    text += "| " + in_cell(c.name) + " | ";
    text.append(word_of(c.what)).append(" | ").append(in_cell(c.summary)).append(" |\n");
  }
  for (const check_result& c : r.results) {
    if (c.what == outcome::failed && !c.details.empty())
      text += "\n### " + in_cell(c.name) + "\n\n```\n" + c.details + "\n```\n";
  }
  return text;
}

}  // namespace contct::text
