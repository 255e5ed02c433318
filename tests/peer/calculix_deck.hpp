// A beam or a plate as an input file for CalculiX, in its quadratic elements: B32R lines and S8R rectangles.
#pragma once

#include <string>

#include "contct/structure/problem.hpp"

namespace contct::app::peer {

struct deck_choice {
  int step = 1;              ///< the load step whose end is written, from 1
  int refine = 2;            ///< elements for each of the problem's, along each side
  double slenderness = 500;  ///< the structure's length over the thickness it is given
};

/// The problem's node i (from 0) is node i + 1; pair i presses on node `first_ground` + i.
struct calculix_deck {
  std::string text;
  double displacement_scale = 1.0;  ///< displacements and faces are this many times the problem's
  double force_scale = 1.0;         ///< forces likewise
  int first_ground = 0;
};

/// `deflection` is the largest of the state, for the scales. CalculiX starts with every pair separated, so
/// the supports must hold the structure by themselves, and its beams and plates have no springs for
/// rotations.
[[nodiscard]] calculix_deck calculix_deck_of(const problem& p, const deck_choice& choice, double deflection);

}  // namespace contct::app::peer
