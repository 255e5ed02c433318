// What a check of a step's bounds needs beside the problem file (reference/certificate.md, "Checked by
// others").
#pragma once

#include <optional>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/numeric/double_double.hpp"

namespace contct::certify {

/// S K_A S - shift I is all but L L': what proves that S K_A S >= mu I.
struct stiffness_proof {
  std::vector<double> scale;  ///< S [dofs], powers of two
  std::vector<int> row_of;    ///< the row of each dof in L [dofs], from 0
  double shift = 0.0;
  matrix::band_matrix factor;                     ///< L
  std::optional<matrix::band_matrix> factor_low;  ///< what is added to it, where doubles are too short for L
};

struct step_proof {
  // What was handed out, as the bounds are about it.
  std::vector<double> displacement;    ///< [dofs]
  std::vector<double> pair_forces;     ///< [pairs]
  std::vector<double> reactions;       ///< [supports of the problem]
  std::vector<double> element_values;  ///< as structure::element_results has them

  std::vector<numeric::double_double> state;    ///< u [dofs]
  std::vector<int> closed;                      ///< A: pairs from 0
  std::vector<numeric::double_double> z;        ///< about K_A^-1 r [dofs]; empty where nothing acts
  std::optional<stiffness_proof> of_stiffness;  ///< none where nothing acts and nothing holds the structure
  std::vector<int> statuses = {};               ///< as handed out: in_contact or separated [pairs]
};

}  // namespace contct::certify
