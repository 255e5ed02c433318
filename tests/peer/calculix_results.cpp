#include "peer/calculix_results.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "contct/text/input_text.hpp"

namespace contct::app {
namespace {

/// A number as Fortran writes it: an exponent of three digits has no E before it.
std::optional<double> real_in(std::string_view word) {
  std::string text(word);
  const std::size_t sign = text.find_last_of("+-");
  if (sign != std::string::npos && sign > 0 && text.find_first_of("Ee") == std::string::npos)
    text.insert(sign, "E");
  const auto value = number_in<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// "displacements (vx,vy,vz) for set GIVEN and time  0.1000000E+01"
calculix_table heading_in(const field_lines& line) {
  const auto are = [&line](std::size_t i, std::string_view first, std::string_view second) {
    return line.field(i) == first && line.field(i + 1) == second;
  };
  const bool sound = line.fields() == 8 &&
                     (are(0, "displacements", "(vx,vy,vz)") || are(0, "forces", "(fx,fy,fz)")) &&
                     are(2, "for", "set") && are(5, "and", "time");
  const std::optional<double> time = sound ? real_in(line.field(7)) : std::nullopt;
  if (!time)
    line.refuse(in_quotes(line.here()),
                "\"displacements (vx,vy,vz)\" or \"forces (fx,fy,fz)\", then \"for set NAME and time T\"");
  return {std::string(line.field(0)), std::string(line.field(4)), *time, {}};
}

void take_values(const field_lines& line, std::vector<calculix_table>& tables) {
  std::array<double, 3> values{};
  bool sound = !tables.empty() && line.fields() == 4;
  for (std::size_t i = 0; i < 3 && sound; ++i) {
    const std::optional<double> value = real_in(line.field(i + 1));
    sound = value.has_value();
    values[i] = value.value_or(0.0);
  }
  const auto node = number_in<int>(line.field(0));
  if (!sound || !node)
    line.refuse(in_quotes(line.here()), "a node's number and three finite numbers, under a heading");
  if (!tables.back().at.try_emplace(*node, values).second)
    line.refuse(in_quotes(line.here()), "each node once in a table");
}

}  // namespace

std::vector<calculix_table> parse_calculix_dat(std::string_view text, std::string_view file) {
  field_lines line(text, file);
  std::vector<calculix_table> tables;
  while (line.next()) {
    if (std::string_view("0123456789").find(line.field(0).front()) != std::string_view::npos) {
      take_values(line, tables);
    } else {
      tables.push_back(heading_in(line));
    }
  }
  for (const calculix_table& t : tables)
    if (t.at.empty())
      refuse_line(file, 0, fmt::format("no node in the table of {} for set {}", t.quantity, in_quotes(t.set)),
                  "one or more");
  return tables;
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
    throw input_error(
        fmt::format("{}: found no {} for set {} at time 1: CalculiX did not reach the step's end", file,
                    quantity, in_quotes(set)));
  }
  std::vector<std::array<double, 3>> values;
  for (int node = first; node < first + count; ++node) {
    const auto at = table->at.find(node);
    if (at == table->at.end()) {
      throw input_error(fmt::format("{}: found no {} of node {} for set {}; allowed: nodes {} to {}", file,
                                    quantity, node, in_quotes(set), first, first + count - 1));
    }
    values.push_back(at->second);
  }
  return values;
}

}  // namespace contct::app
