// The files of --vtu: grids of the increments and their collection.
#pragma once

#include <string>
#include <vector>

#include "app/outputs.hpp"
#include "contct/model/problem.hpp"
#include "contct/write/pictures.hpp"

namespace contct {

/// A file in the folder of `file`: its name without the extension, and `end`.
[[nodiscard]] std::string beside(const std::string& file, const std::string& end);

/// Every file of --vtu. Throws std::invalid_argument for a name that cannot be a grid's.
void add_grid_files(const std::string& vtu, std::vector<output_option>& all);

/// For --vtu: throws std::invalid_argument where a structure given by its matrix has no coordinates, and
/// warns of pairs that get no cell.
void check_grid_coordinates(const problem& p);

/// Write all files of --vtu. Throws as output_file does.
void write_grids(const output_files& files, const std::string& vtu, const run_result& r);

}  // namespace contct
