// Files that the program wrote, read back: each function ends the program (require) where one is not what it
// is to be.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/xml.hpp"

namespace contct::fuzz {

/// JSON in UTF-8, each key once. `what` names the file.
[[nodiscard]] nlohmann::json json_in(std::string_view text, std::string_view what);

/// The data of a run's page. All of the page but title, heading and data is the same in every run of this
/// process.
[[nodiscard]] nlohmann::json data_in_page(std::string_view page);

/// Well-formed XML with that root.
[[nodiscard]] xml_element xml_in(std::string_view text, std::string_view root);

/// A grid: every array has as many numbers as its place asks for, and cells name points that are there.
void check_vtu(std::string_view text);

/// A table by RFC 4180: the rows, the head among them, all with the same number of fields.
[[nodiscard]] std::vector<std::vector<std::string>> rows_in_csv(std::string_view text);

/// A Markdown report with that many results: its table has a row for each, of three cells.
void check_markdown(std::string_view text, std::size_t results);

/// What is printed: UTF-8, and no control characters but line ends.
void check_printed(std::string_view text);

}  // namespace contct::fuzz
