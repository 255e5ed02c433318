// Follows one random problem with one kernel, and judges the result.
#pragma once

#include <string_view>

#include "contct/certify/certificate.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/lab/random_problem.hpp"

namespace contct::lab {

enum class verdict {
  certified,        ///< every step's final state is certified
  no_equilibrium,   ///< the path ended in a mechanism, and the reference solution has no equilibrium either
  wrong,            ///< the path went to its end, and some final state is not right
  false_mechanism,  ///< the path ended in a mechanism where there is an equilibrium
  no_end,           ///< cycle, increments without end, or no factor
};
inline constexpr int verdicts = 5;
[[nodiscard]] std::string_view name_of(verdict v);

struct problem_result {
  verdict came_to = verdict::no_end;
  double displacement_error = 0.0;  ///< the worst of any step, relative to the largest deflection
  double length_error = 0.0;        ///< of that, and of how far pairs are on the wrong side of their faces
  double needed = 0.0;              ///< the worst of all that a certificate measures
  double factor = 0.0;              ///< the worst of that in eps / rcond: what C would have to be
  int steps = 0;                    ///< certified or judged
  int uncertified = 0;              ///< of these
  int unfounded = 0;                ///< and of these: an equilibrium is claimed where there is none
  int makes = 0, breaks = 0;
  int at_rest = 0;    ///< increments without progress
  int snaps = 0;      ///< rigid, at constant load
  int fallbacks = 0;  ///< steps that the reference solution ended
  int increments = 0;

  /// Take the certificate of one more step into account.
  void add(const certificate& c);
};

/// Follow `p` with `leader` on the engine named, with the reference solution as a fallback where its rule
/// allows one.
[[nodiscard]] problem_result try_problem(const random_problem& p, kernel& leader,
                                         std::string_view engine = "refactor");

/// The same on `s`, which is p's structure, however its stiffness is stored.
[[nodiscard]] problem_result try_structure(const random_problem& p, const linear_structure& s, kernel& leader,
                                           std::string_view engine);

}  // namespace contct::lab
