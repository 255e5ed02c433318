#include "fuzz/read_back.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "contct/text/input_text.hpp"
#include "fuzz/fuzz.hpp"

namespace contct::fuzz {
namespace {

using json = nlohmann::json;

void check_utf8(std::string_view text, std::string_view what) {
  try {
    check_characters(text);
  } catch (const std::runtime_error& e) {
    require(false, what, e.what());
  }
}

/// The text between two marks; what is before and behind it goes to `outside`.
std::string_view between(std::string_view& rest, std::string_view from, std::string_view to,
                         std::string& outside) {
  const std::size_t begin = rest.find(from);
  require(begin != std::string_view::npos, "a page has this", from);
  const std::size_t end = rest.find(to, begin + from.size());
  require(end != std::string_view::npos, "a page has this", to);
  const std::string_view inside = rest.substr(begin + from.size(), end - begin - from.size());
  outside.append(rest.substr(0, begin + from.size()));
  rest.remove_prefix(end);
  return inside;
}

/// Numbers that blanks separate.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  constexpr std::string_view blanks = " \n\t";
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string_view::npos;
       at = text.find_first_not_of(blanks, at)) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    const auto value = text::number_in<double>(text.substr(at, end - at));
    require(value.has_value(), "an array of a grid has numbers", text.substr(at, end - at));
    numbers.push_back(*value);
    at = end;
  }
  return numbers;
}

std::size_t count_in(const xml_element& e, const std::string& attribute) {
  const auto found = e.attributes.find(attribute);
  require(found != e.attributes.end(), "a grid has this", attribute);
  const auto value = text::number_in<std::size_t>(found->second);
  require(value.has_value(), attribute, found->second);
  return *value;
}

/// The arrays of a section, each with as many tuples; the one with that name.
std::vector<double> check_arrays(const xml_element& piece, std::string_view section, std::size_t tuples,
                                 std::string_view wanted = {}) {
  const auto sections = piece.all(section);
  require(sections.size() == 1, "a grid has this once", section);
  std::vector<double> named;
  for (const xml_element* array : sections[0]->all("DataArray")) {
    std::vector<double> values = numbers_in(array->text);
    const std::string& name = array->attributes.at("Name");
    if (name == wanted) named = values;
    if (section == "Cells" && name == "connectivity") continue;
    require(values.size() == tuples * count_in(*array, "NumberOfComponents"), "an array's numbers", name);
  }
  return named;
}

}  // namespace

json json_in(std::string_view text, std::string_view what) {
  check_utf8(text, what);
  std::vector<std::set<std::string>> keys;
  const json::parser_callback_t each_once = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key)
      require(keys.back().insert(parsed.get<std::string>()).second, "a key once", parsed.get<std::string>());
    return true;
  };
  try {
    return json::parse(text, each_once);
  } catch (const json::exception& e) {
    require(false, what, e.what());
    throw;
  }
}

json data_in_page(std::string_view page) {
  static std::string first_outside;
  check_utf8(page, "a page is UTF-8");
  std::string outside;
  std::string_view rest = page;
  const std::string_view title = between(rest, "<title>", "</title>", outside);
  const std::string_view heading = between(rest, "<h1>", "</h1>", outside);
  const std::string_view data =
      between(rest, "<script type=\"application/json\" id=\"data\">", "</script>", outside);
  outside.append(rest);
  if (first_outside.empty()) first_outside = outside;
  require(outside == first_outside, "no text of a problem stands in a page but where it belongs");
  for (const std::string_view words : {title, heading})
    require(words.find_first_of("<>") == std::string_view::npos, "a title has no tags", words);
  return json_in(data, "a page's data");
}

xml_element xml_in(std::string_view text, std::string_view root) {
  try {
    xml_element e = parse_xml(text);
    require(e.name == root, root, e.name);
    return e;
  } catch (const std::runtime_error& e) {
    require(false, root, e.what());
    throw;
  }
}

void check_vtu(std::string_view text) {
  const xml_element file = xml_in(text, "VTKFile");
  const auto pieces = file.all("Piece");
  require(pieces.size() == 1, "a grid has one piece");
  const xml_element& piece = *pieces[0];
  const std::size_t points = count_in(piece, "NumberOfPoints");
  const std::size_t cells = count_in(piece, "NumberOfCells");
  check_arrays(piece, "Points", points);
  check_arrays(piece, "PointData", points);
  check_arrays(piece, "CellData", cells);
  const std::vector<double> offsets = check_arrays(piece, "Cells", cells, "offsets");
  const std::vector<double> corners = check_arrays(piece, "Cells", cells, "connectivity");
  require(std::ranges::is_sorted(offsets), "offsets rise");
  require((offsets.empty() ? 0.0 : offsets.back()) == static_cast<double>(corners.size()), "offsets end");
  for (const double at : corners)
    require(at >= 0.0 && at < static_cast<double>(points), "a cell names points that are there");
}

std::vector<std::vector<std::string>> rows_in_csv(std::string_view text) {
  check_utf8(text, "a table is UTF-8");
  std::vector<std::vector<std::string>> rows;
  for (std::size_t at = 0; at < text.size();) {
    std::vector<std::string>& row = rows.emplace_back();
    for (bool goes_on = true; goes_on;) {
      std::string& field = row.emplace_back();
      const bool quoted = at < text.size() && text[at] == '"';
      if (quoted) {
        for (++at; at < text.size() && (text[at] != '"' || text.substr(at, 2) == "\"\""); ++at) {
          field += text[at];
          if (text[at] == '"') ++at;
        }
        require(at < text.size(), "a quoted field ends");
        ++at;
      }
      while (!quoted && at < text.size() &&
             std::string_view(",\r\n\"").find(text[at]) == std::string_view::npos)
        field += text[at++];
      goes_on = at < text.size() && text[at] == ',';
      if (goes_on) ++at;
    }
    require(text.substr(at, 2) == "\r\n", "a row ends as RFC 4180 has it", text.substr(at, 20));
    at += 2;
    require(row.size() == rows.front().size(), "rows have as many fields as the head", row.front());
  }
  return rows;
}

void check_markdown(std::string_view text, std::size_t results) {
  check_utf8(text, "a report is UTF-8");
  const std::size_t head = text.find("| --- | --- | --- |\n");
  require(head != std::string_view::npos, "a report has a table");
  text::text_lines lines(text.substr(text.find('\n', head) + 1), "report");
  std::size_t rows = 0;
  while (lines.next() && lines.here().starts_with('|')) {
    std::size_t bars = 0;
    for (std::size_t i = 0; i < lines.here().size(); ++i) {
      if (lines.here()[i] == '\\')
        ++i;
      else if (lines.here()[i] == '|')
        ++bars;
    }
    require(bars == 4, "a row of a report has three cells", lines.here());
    ++rows;
  }
  require(rows == results, "a report has a row for each result", lines.here());
}

void check_printed(std::string_view text) {
  check_utf8(text, "what is printed");
  require(std::ranges::none_of(
              text, [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n') || c == 0x7f; }),
          "no control characters are printed", text.substr(0, 400));
}

}  // namespace contct::fuzz
