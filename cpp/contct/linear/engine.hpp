// The linear algebra of a path: adds and removes springs, and solves for responses and displacements.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "contct/linear/system.hpp"

namespace contct {

/// R*, the residual load: the share of a step's load increment that has not been applied yet.
struct residual_load {
  std::span<const double> increment;  ///< [dofs] the step's total load minus that of the step before
  double share;                       ///< from 1 at the start of the step to 0 at its end
  std::uint64_t version = 0;          ///< differs if `increment` differs; never 0 on a path
  /// [pairs] the kernel's last scale factors, or empty. Only a hint: the springs of the pairs with the
  /// smallest factors are likely to be switched next.
  std::span<const double> last_s = {};
};

struct engine_counts {
  std::int64_t factors = 0;  ///< factorisations
  std::int64_t solves = 0;   ///< solves with a factor
  std::int64_t updates = 0;  ///< springs switched without a factorisation
  std::int64_t checks = 0;   ///< checks for drift
};

/// Thrown if the stiffness matrix of a held structure has no Cholesky factor: it is too ill-conditioned for
/// double precision.
class no_factor : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// K with the springs of the pairs in contact. Dofs are numbered from 0.
class stiffness_engine {
 public:
  virtual ~stiffness_engine() = default;

  /// Adds the spring of pair `pair` (from 0) if `closed`, else removes it.
  virtual void switch_spring(int pair, bool closed) = 0;

  /// Solves K w* = R*, and writes the response d* of each pair to `d_star` [pairs]. Throws no_factor.
  virtual void respond(const residual_load& residual, std::span<double> d_star) = 0;

  /// Solves K u = load + forces of the pairs; `load`, `u` [dofs], `pair_forces` [pairs]. Throws no_factor.
  virtual void recover(std::span<const double> load, std::span<const double> pair_forces,
                       std::span<double> u) = 0;

  [[nodiscard]] virtual engine_counts counts() const { return {}; }

  /// Reciprocal condition of the current K, its diagonal scaled to 1.
  [[nodiscard]] virtual double reciprocal_condition() = 0;
};

/// Makes an engine by name. "refactor" and "updated" suit any structure, "condensed" suits beams with pairs.
/// "petsc" is "updated" with a factor that MPI ranks share, if this process has joined an MPI job
/// (contct/linear/mpi_job.hpp). `s` must outlive the engine. Throws std::invalid_argument if no engine has
/// this name, or if the engine does not suit `s`.
[[nodiscard]] std::unique_ptr<stiffness_engine> make_engine(std::string_view name, const linear_system& s);

/// The fastest engine for `s`: "condensed" if it suits `s`, otherwise "updated".
[[nodiscard]] std::string_view quickest_engine(const linear_system& s);

/// The names of the engines that this process can use.
[[nodiscard]] std::vector<std::string> engine_names();

}  // namespace contct
