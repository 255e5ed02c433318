// A problem as an input file for CalculiX, another program with another way of solving it.
#pragma once

#include <string>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::write {

/// How a problem is to be written.
struct calculix_choice {
  int step = 0;              ///< which load step's end, from 1; 0: the last one's
  int refine = 2;            ///< elements for each of the problem's, along each side
  double slenderness = 500;  ///< the structure's length over the thickness it is given
};

/// An input file, and what is needed to read the answer back: the problem's node i (from 0) is node i + 1,
/// pair i presses on node `first_ground` + i.
struct calculix_deck {
  std::string text;
  double displacement_scale = 1.0;  ///< displacements and faces are this many times the problem's
  double force_scale = 1.0;         ///< forces likewise
  int step = 0;                     ///< from 1
  int nodes = 0;                    ///< of the mesh, without the springs' ground
  int elements = 0;                 ///< likewise
  int first_ground = 0;
};

/// Throws std::invalid_argument where the problem has what cannot be written, naming it.
[[nodiscard]] calculix_deck calculix_deck_of(const problem& p, const calculix_choice& choice);

}  // namespace contct::write
