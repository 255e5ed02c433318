// reference/ERRATA.md and reference/errata.toml say the same.
#include <map>
#include <sstream>

#include "catch.hpp"
#include "listing/child.hpp"
#include "listing/errata.hpp"

using namespace contct_test;

namespace {

std::string in_code(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "`" : ", `") + text + '`';
  return all;
}

/// The outcomes of the undos, in order of first appearance, with how often each is seen.
std::string outcomes(const std::vector<undo>& undos) {
  std::vector<std::string> order;
  std::map<std::string, int> count;
  for (const undo& u : undos) {
    if (count[u.expect]++ == 0) order.push_back(u.expect);
  }
  std::string all;
  for (const std::string& what : order) {
    all += (all.empty() ? "" : ", ") + what;
    if (count[what] > 1) all += " (" + std::to_string(count[what]) + ")";
  }
  return all;
}

std::string row(const erratum& e) {
  return "| " + std::to_string(e.number) + " | " + in_code(e.ocr) + " | " + in_code(e.compiled) + " | " +
         e.kind + " | " + e.confidence + " | " + outcomes(e.undos) + " |";
}

/// A row of the page's second table: where an undo changes the numbers.
std::string row(const undo& u) {
  return "| " + u.name + " | " + u.call + " | `" + u.field + "` |\n";
}

/// The numbered rows of the page's table.
std::vector<std::string> rows_of_page() {
  std::vector<std::string> rows;
  std::istringstream page(file_text(CONTCT_ERRATA_PAGE));
  for (std::string line; std::getline(page, line);) {
    if (line.size() > 2 && line.starts_with("| ") && line[2] >= '0' && line[2] <= '9') rows.push_back(line);
  }
  return rows;
}

}  // namespace

TEST_CASE("the table of ERRATA.md is the one that errata.toml makes") {
  std::vector<std::string> wanted;
  for (const erratum& e : read_errata(CONTCT_ERRATA)) wanted.push_back(row(e));
  const std::vector<std::string> found = rows_of_page();
  for (std::size_t i = 0; i < wanted.size() && i < found.size(); ++i) CHECK(found[i] == wanted[i]);
  CHECK(found.size() == wanted.size());
}

TEST_CASE("ERRATA.md says where each occurrence of erratum 6 is first seen") {
  const std::string page = file_text(CONTCT_ERRATA_PAGE);
  const std::vector<erratum> errata = read_errata(CONTCT_ERRATA);
  REQUIRE(errata.at(5).undos.size() == 8);  // seven places, and all of them together
  for (const undo& u : errata[5].undos) {
    INFO(row(u));
    CHECK(page.find(row(u)) != std::string::npos);
  }
}
