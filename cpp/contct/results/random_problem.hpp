// Makes random problems with one-sided supports, each determined by a seed and a number. Follows a kernel's
// path on a problem, and judges the path.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "contct/harness/fuzz.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// How the faces are placed: with random gaps; without gaps; with some gaps of zero; with equal gaps; with
/// nearly equal gaps; symmetric or antisymmetric about the middle in x; on both sides of a node.
enum class face_layout { gaps, zero, mixed, equal_gaps, near_ties, symmetric, antisymmetric, two_sided };
inline constexpr int face_layouts = 8;

/// The range of random problems: beams and plates with pairs at one to all nodes, springs over eight decades,
/// and one to five load steps with unloading and reversal.
struct random_problem_kind {
  double least_unit = 1e-12;  ///< bounds of the unit of length, which is log-uniform
  double most_unit = 1e12;
  double free_share = 0.2;  ///< share of structures held by pairs alone
  double plate_share = 0.25;
  int most_elements = 24;  ///< elements of a beam
  int most_lines = 6;      ///< elements along a side of a plate
};

struct random_problem : problem {
  bool held = true;  ///< the supports hold the structure
  face_layout layout = face_layout::gaps;
  double unit = 1.0;  ///< the unit of length
};

[[nodiscard]] random_problem make_random_problem(std::uint64_t seed, std::uint64_t number,
                                                 const random_problem_kind& kind = {});

/// How the path of one problem is judged.
enum class verdict {
  certified,        ///< every step's final state is certified
  no_equilibrium,   ///< the path ended in a mechanism, and the reference solution has no equilibrium either
  wrong,            ///< the path reached its end, but some final state is not certified
  false_mechanism,  ///< the path ended in a mechanism, but the step's load may have an equilibrium
  no_end,           ///< the path has a cycle or too many increments, or a factorisation failed
};

struct problem_result {
  verdict came_to = verdict::no_end;
  solved_path followed = {};
};

/// Follows the path of `p` with the kernel `leader`, and judges it. If the kernel's rule allows a fallback,
/// the reference solution is the fallback.
[[nodiscard]] problem_result try_problem(const problem& p, kernel& leader,
                                         std::string_view engine = "refactor");

/// Like try_problem, with `s` as the structure of `p`. The stiffness of `s` may be stored in any way.
[[nodiscard]] problem_result try_structure(const problem& p, const linear_structure& s, kernel& leader,
                                           std::string_view engine,
                                           const std::vector<observer*>& watching = {});

/// Random problems so small that a run can follow thousands of them.
class small_problems final : public fuzz_problems {
 public:
  explicit small_problems(std::uint64_t seed) : seed_(seed) {}
  void follow(std::int64_t number, kernel& leader,
              const std::function<void(const answered_call&)>& called) const override;
  [[nodiscard]] bool has_verdict_of(std::int64_t number, const fresh_kernel& leader,
                                    const fresh_kernel& follower) const override;

 private:
  std::uint64_t seed_;
};

}  // namespace contct
