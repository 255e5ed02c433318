// Random problems on one-sided supports, the same everywhere from a seed and a number, and the path of one
// kernel on them.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/model/problem.hpp"

namespace contct {

/// How the faces are placed.
enum class face_layout { gaps, zero, mixed, equal_gaps, near_ties, symmetric, antisymmetric, two_sided };
inline constexpr int face_layouts = 8;

/// The range of random problems: beams and plates on 1 to all of their nodes' pairs, springs over eight
/// decades, one to five load steps with unloading and reversal.
struct random_problem_kind {
  double least_unit = 1e-12;  ///< the unit of length, log-uniform between these two
  double most_unit = 1e12;
  double free_share = 0.2;  ///< share of structures held by pairs alone
  double plate_share = 0.25;
  int most_elements = 24;  ///< of a beam
  int most_lines = 6;      ///< elements along a side of a plate
};

struct random_problem : problem {
  bool held = true;  ///< by its supports
  face_layout layout = face_layout::gaps;
  double unit = 1.0;  ///< the unit of length
};

/// Problem `number` of `seed`.
[[nodiscard]] random_problem make_random_problem(std::uint64_t seed, std::uint64_t number,
                                                 const random_problem_kind& kind = {});

/// How the path of one problem is judged.
enum class verdict {
  certified,        ///< every step's final state is certified
  no_equilibrium,   ///< the path ended in a mechanism, and the reference solution has no equilibrium either
  wrong,            ///< the path reached its end, and some final state is wrong
  false_mechanism,  ///< the path ended in a mechanism although there is an equilibrium
  no_end,           ///< cycle, increments without end, or no factor
};

struct problem_result {
  verdict came_to = verdict::no_end;
  std::vector<certificate> certificates = {};  ///< of the steps that reached their load
};

/// Follow `p` with `leader` on the engine named, with the reference solution as a fallback where its rule
/// allows one.
[[nodiscard]] problem_result try_problem(const problem& p, kernel& leader,
                                         std::string_view engine = "refactor");

/// The same on `s`, which is p's structure, however its stiffness is stored.
[[nodiscard]] problem_result try_structure(const problem& p, const linear_structure& s, kernel& leader,
                                           std::string_view engine, std::vector<observer*> watching = {});

}  // namespace contct
