// The linear algebra of a path: switch a spring, respond, recover.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contct/model/structure.hpp"

namespace contct {

/// R*, the residual load: the share of a step's load increment that is still to be applied.
struct residual_load {
  std::span<const double> increment;  ///< the step's total load less the previous one's [dofs]
  double share;                       ///< from 1 down to 0
  std::uint64_t version = 0;          ///< another one for another increment, never 0 on a path
  /// The kernel's last scale factors [pairs], or nothing: the pairs with the least are likely to be switched
  /// next. No more than a hint.
  std::span<const double> last_s = {};
};

/// Counts of an engine's work so far.
struct engine_counts {
  std::int64_t factors = 0;  ///< factorisations
  std::int64_t solves = 0;   ///< with a factor, for one right-hand side
  std::int64_t updates = 0;  ///< toggles taken in without a factorisation
  std::int64_t checks = 0;   ///< of the residual
};

/// The stiffness matrix of a structure that is held has no Cholesky factor: it is too ill-conditioned for
/// double precision.
class no_factor : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stiffness with the springs of the pairs now in contact. Dofs are numbered from 0.
class stiffness_engine {
 public:
  virtual ~stiffness_engine() = default;

  /// Add the spring of pair `pair` (from 0), or remove it.
  virtual void switch_spring(int pair, bool closed) = 0;

  /// Solve K w* = R* and write d* where each pair acts to `d_star` [pairs]. Throws no_factor.
  virtual void respond(const residual_load& residual, std::span<double> d_star) = 0;

  /// Solve K u = load + the pairs' forces, for every dof. `pair_forces` [pairs]. Throws no_factor.
  virtual void recover(std::span<const double> load, std::span<const double> pair_forces,
                       std::span<double> u) = 0;

  [[nodiscard]] virtual engine_counts counts() const { return {}; }

  /// Reciprocal condition of the current K, its diagonal scaled to 1.
  [[nodiscard]] virtual double reciprocal_condition() = 0;
};

/// Make an engine by name: "refactor" and "updated" for anything, "condensed" for beams with pairs, "petsc",
/// which is "updated" by a factor that ranks share, if this process has joined an MPI job
/// (contct/solve/mpi_job.hpp). `s` must outlive it. Throws std::invalid_argument when there is none of that
/// name, or when it does not suit `s`.
[[nodiscard]] std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_structure& s);

/// The engine that is quickest for `s`: "condensed" where it suits, otherwise "updated".
[[nodiscard]] std::string_view quickest_engine(const linear_structure& s);

/// Throws std::invalid_argument, naming what there is, when no engine has that name.
void refuse_unknown_engine(std::string_view name);

/// The names of all engines of this process.
[[nodiscard]] std::vector<std::string> engine_names();

}  // namespace contct
