// Each line of the listing that an explanation cites holds the statement that it is said to hold.
#include "contct/compare/listing_lines.hpp"

#include <fstream>
#include <string>
#include <vector>

#include "catch.hpp"

using namespace contct;

namespace {

/// The statement field of fixed form: behind column 6, without blanks at its ends.
std::string statement_of(const std::string& line) {
  constexpr std::size_t label_and_mark = 6;
  const std::size_t from = line.find_first_not_of(' ', label_and_mark);
  return from == std::string::npos ? "" : line.substr(from, line.find_last_not_of(" \r") - from + 1);
}

std::vector<std::string> listing_text() {
  std::vector<std::string> lines;
  std::ifstream file(CONTCT_LISTING);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("every line that explanations cite holds its statement, and none is cited twice") {
  const std::vector<std::string> text = listing_text();
  REQUIRE(text.size() == 69);
  for (const listing_line& cited : listing::all) {
    INFO("line " << cited.number);
    REQUIRE(cited.number >= 1);
    REQUIRE(static_cast<std::size_t>(cited.number) <= text.size());
    CHECK(statement_of(text[static_cast<std::size_t>(cited.number - 1)]) == cited.statement);
    CHECK(listing::statement_at(cited.number) == cited.statement);
    int times = 0;
    for (const listing_line& other : listing::all) times += other.number == cited.number ? 1 : 0;
    CHECK(times == 1);
  }
  CHECK(listing::statement_at(44).empty());  // a FORMAT, which nobody cites
}
