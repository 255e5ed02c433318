#include "peer/calculix_results.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>

namespace contct {
namespace {

constexpr std::string_view blanks = " \t\r";

/// The words of a line.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;
       begin = line.find_first_not_of(blanks, begin)) {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

template <class Number>
std::optional<Number> all_of(std::string_view word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// A number as Fortran writes it: an exponent of three digits has no E before it.
std::optional<double> real_of(std::string_view word) {
  std::string text(word);
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && text.find_first_of("Ee") == std::string::npos)
    text.insert(sign, "E");
  const std::optional<double> value = all_of<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

class dat_reader {
 public:
  dat_reader(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  std::vector<calculix_table> read() {
    while (!text_.empty()) {
      ++line_;
      const std::size_t end = text_.find('\n');
      if (end == std::string_view::npos) refuse(text_, "a line that ends: this file is cut off");
      take(text_.substr(0, end));
      text_.remove_prefix(end + 1);
    }
    for (const calculix_table& t : tables_) {
      if (t.at.empty())
        throw input_error(fmt::format("{}: found no node in the table of {} for set {}; allowed: one or more",
                                      file_, t.quantity, t.set));
    }
    return std::move(tables_);
  }

 private:
  void take(std::string_view line) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) return;
    if (std::string_view("0123456789").find(words[0].front()) != std::string_view::npos) {
      take_values(line, words);
    } else {
      take_heading(line, words);
    }
  }

  /// "displacements (vx,vy,vz) for set GIVEN and time  0.1000000E+01"
  void take_heading(std::string_view line, const std::vector<std::string_view>& words) {
    const bool displacements = words.size() > 1 && words[0] == "displacements" && words[1] == "(vx,vy,vz)";
    const bool forces = words.size() > 1 && words[0] == "forces" && words[1] == "(fx,fy,fz)";
    const bool has_rest = words.size() == 8 && words[2] == "for" && words[3] == "set" && words[5] == "and" &&
                          words[6] == "time";
    const std::optional<double> time = has_rest ? real_of(words[7]) : std::nullopt;
    if ((!displacements && !forces) || !time) {
      refuse(line, "\"displacements (vx,vy,vz)\" or \"forces (fx,fy,fz)\", then \"for set NAME and time T\"");
    }
    tables_.push_back({std::string(words[0]), std::string(words[4]), *time, {}});
  }

  void take_values(std::string_view line, const std::vector<std::string_view>& words) {
    constexpr const char* allowed = "a node's number and three finite numbers, under a heading";
    if (tables_.empty() || words.size() != 4) refuse(line, allowed);
    const std::optional<int> node = all_of<int>(words[0]);
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
      const std::optional<double> value = real_of(words[i + 1]);
      if (!value) refuse(line, allowed);
      values[i] = *value;
    }
    if (!node) refuse(line, allowed);
    if (!tables_.back().at.try_emplace(*node, values).second) refuse(line, "each node once in a table");
  }

  [[noreturn]] void refuse(std::string_view found, std::string_view allowed) const {
    constexpr std::size_t most = 80;
    throw input_error(
        fmt::format("{}:{}: found \"{}\"; allowed: {}", file_, line_, found.substr(0, most), allowed));
  }

  std::string_view text_;
  std::string_view file_;
  int line_ = 0;
  std::vector<calculix_table> tables_;
};

}  // namespace

std::vector<calculix_table> parse_calculix_dat(std::string_view text, std::string_view file) {
  return dat_reader(text, file).read();
}

std::vector<calculix_table> read_calculix_dat(const std::string& path) {
  return parse_calculix_dat(read_input(path, "results of CalculiX", 1024), path);
}

std::vector<std::array<double, 3>> values_at_end(const std::vector<calculix_table>& tables,
                                                 std::string_view quantity, std::string_view set, int first,
                                                 int count, std::string_view file) {
  const calculix_table* table = nullptr;
  for (const calculix_table& t : tables) {
    if (t.quantity == quantity && t.set == set && t.time == 1.0) table = &t;
  }
  if (table == nullptr) {
    throw input_error(fmt::format(
        "{}: found no {} for set {} at time 1: CalculiX did not reach the step's end", file, quantity, set));
  }
  std::vector<std::array<double, 3>> values;
  for (int node = first; node < first + count; ++node) {
    const auto at = table->at.find(node);
    if (at == table->at.end()) {
      throw input_error(fmt::format("{}: found no {} of node {} for set {}; allowed: nodes {} to {}", file,
                                    quantity, node, set, first, first + count - 1));
    }
    values.push_back(at->second);
  }
  return values;
}

}  // namespace contct
