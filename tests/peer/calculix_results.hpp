// What CalculiX prints of nodes: the file JOB.dat.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "contct/text/input_text.hpp"

namespace contct::app {

/// One table of a .dat file.
struct calculix_table {
  std::string quantity;  ///< "displacements" or "forces"
  std::string set;       ///< of nodes, as the input file names it
  double time = 0.0;
  std::map<int, std::array<double, 3>> at;  ///< along x, y, z, by node number
};

/// All tables in the text of a .dat file, as *NODE PRINT makes them for U and RF; `file` is its name in
/// messages. Throws input_error, with the line, at anything else in it: nothing is half-read.
[[nodiscard]] std::vector<calculix_table> parse_calculix_dat(std::string_view text, std::string_view file);

/// The same for the file at `path`.
[[nodiscard]] std::vector<calculix_table> read_calculix_dat(const std::string& path);

/// Values of nodes `first`, `first` + 1 and so on, `count` of them, from the table of a set at the end of the
/// step, which lasts from time 0 to 1. Throws input_error where CalculiX did not get there, or left a node
/// out.
[[nodiscard]] std::vector<std::array<double, 3>> values_at_end(const std::vector<calculix_table>& tables,
                                                               std::string_view quantity,
                                                               std::string_view set, int first, int count,
                                                               std::string_view file);

}  // namespace contct::app
