// A problem as a person wrote it down.
#pragma once

#include <string>
#include <vector>

#include "contct/structure/load.hpp"
#include "contct/structure/model.hpp"
#include "contct/structure/structure.hpp"

namespace contct::structure {

/// What a problem file says. Nodes, elements and pairs count from 0 here, from 1 in the file.
struct problem {
  std::string title;
  model geometry;
  std::vector<support> supports;
  std::vector<contact_pair> pairs;  ///< all [[contact]] in file order, then the beds'
  std::vector<load> steps;          ///< total load at the end of each step
  std::vector<std::string> warnings;
};

}  // namespace contct::structure
