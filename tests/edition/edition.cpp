#include "edition/edition.hpp"

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "contct/read/toml_reader.hpp"

namespace contct_test {
namespace {

/// Without blanks at its ends.
std::string bare(const std::string& line) {
  const std::size_t from = line.find_first_not_of(" \t\r");
  return from == std::string::npos ? "" : line.substr(from, line.find_last_not_of(" \t\r") - from + 1);
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

cited_block read_block(const contct::app::table_reader& t) {
  t.allow_only({"file", "text"});
  cited_block b{t.text("file"), {}};
  for (const std::string& line : split(t.text("text"))) {
    if (!bare(line).empty()) b.lines.push_back(bare(line));
  }
  if (b.lines.empty()) t.refuse("no line under text", "at least one");
  return b;
}

edition_part read_part(const contct::app::table_reader& t) {
  t.allow_only({"step", "title", "paper", "equation", "note", "listing", "cpp"});
  edition_part p{
      t.text("step"), t.text("title"), t.text("paper"), t.text("equation"), t.text("note"), {}, {}};
  const toml::array* lines = t.required("listing", "an array of lines").as_array();
  if (lines == nullptr) t.refuse("listing is no array", "an array of lines");
  constexpr int most_lines = 1000;
  for (std::size_t i = 0; i < lines->size(); ++i)
    p.listing.push_back(t.integer_of(*lines->get(i), contct::app::indexed("listing", i), 1, most_lines));
  for (const contct::app::table_reader& block : t.tables("cpp")) p.cpp.push_back(read_block(block));
  return p;
}

bool is_comment(const std::string& line) {
  return bare(line).empty() || line[0] == 'C' || line[0] == 'c' || line[0] == '*' || line[0] == '!';
}

void check_listing(const edition& e, const std::vector<std::string>& listing,
                   std::vector<std::string>& faults) {
  std::map<int, int> times;
  for (const edition_part& p : e.parts) {
    for (const int line : p.listing) ++times[line];
  }
  for (const auto& [line, count] : times) {
    const std::string where = std::string(listing_file) + ", line " + std::to_string(line) + ": ";
    if (line > static_cast<int>(listing.size())) {
      faults.push_back(where + "there is no such line");
      continue;
    }
    if (is_comment(listing[static_cast<std::size_t>(line - 1)])) faults.push_back(where + "is a comment");
    if (count > 1) faults.push_back(where + "is in the map " + std::to_string(count) + " times");
  }
  for (std::size_t i = 0; i < listing.size(); ++i) {
    const int line = static_cast<int>(i) + 1;
    if (!is_comment(listing[i]) && !times.contains(line))
      faults.push_back(std::string(listing_file) + ", line " + std::to_string(line) +
                       ": is left out: " + bare(listing[i]));
  }
}

}  // namespace

edition read_edition(const std::filesystem::path& map) {
  const std::string text = contct::app::read_input(map.string(), "map");
  const std::string file = map.string();
  const toml::table document = contct::app::parse_toml(text, file);
  const contct::app::table_reader top(document, "", file);
  top.allow_only({"introduction", "part"});
  edition e{top.text("introduction"), {}};
  for (const contct::app::table_reader& t : top.tables("part")) e.parts.push_back(read_part(t));
  return e;
}

std::vector<std::string> sources::lines_of(const std::string& file) const {
  std::ostringstream text;
  text << std::ifstream(root_ / file).rdbuf();
  return split(text.str());
}

std::vector<int> sources::places_of(const cited_block& b) const {
  const std::vector<std::string> all = lines_of(b.file);
  std::vector<int> places;
  for (std::size_t at = 0; at + b.lines.size() <= all.size(); ++at) {
    bool here = true;
    for (std::size_t i = 0; here && i < b.lines.size(); ++i) here = bare(all[at + i]) == b.lines[i];
    if (here) places.push_back(static_cast<int>(at) + 1);
  }
  return places;
}

std::vector<std::string> faults_of(const edition& e, const sources& s) {
  std::vector<std::string> faults;
  check_listing(e, s.lines_of(listing_file), faults);
  for (const edition_part& p : e.parts) {
    for (const cited_block& b : p.cpp) {
      const std::size_t places = s.places_of(b).size();
      if (places == 1) continue;
      faults.push_back(b.file + ": \"" + b.lines[0] + "\" and what follows it stands there " +
                       std::to_string(places) + " times; allowed: once");
    }
  }
  return faults;
}

}  // namespace contct_test
