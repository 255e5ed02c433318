// Random problems on one-sided supports, the same everywhere from a seed and a number.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "contct/structure/model.hpp"

namespace contct::lab {

/// How the faces are placed.
enum class face_layout { gaps, zero, mixed, equal_gaps, near_ties, symmetric, antisymmetric, two_sided };
inline constexpr int face_layouts = 8;
[[nodiscard]] std::string_view name_of(face_layout f);

/// What to draw from: beams and plates on 1 to all of their nodes' pairs, springs over eight decades,
/// one to five load steps with unloading and reversal.
struct random_problem_kind {
  double least_unit = 1e-12;  ///< the unit of length, log-uniform between these two
  double most_unit = 1e12;
  double free_share = 0.2;  ///< share of structures held by pairs alone
  double plate_share = 0.25;
  int most_elements = 24;  ///< of a beam
  int most_lines = 6;      ///< elements along a side of a plate
};

struct random_problem {
  model geometry;
  std::vector<support> supports;
  std::vector<contact_pair> pairs;
  std::vector<load> steps;
  bool held = true;  ///< by its supports
  face_layout layout = face_layout::gaps;
  double unit = 1.0;  ///< the unit of length
};

/// Problem `number` of `seed`.
[[nodiscard]] random_problem make_random_problem(std::uint64_t seed, std::uint64_t number,
                                                 const random_problem_kind& kind = {});

}  // namespace contct::lab
