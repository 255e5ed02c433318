// Solves sparse symmetric equations exactly: factors the matrix once modulo a prime, and finds the digits of
// the solution to the base of that prime (Dixon 1982). No number is longer than the solution needs.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "contct/number/rational.hpp"
#include "contct/structure/equations.hpp"

namespace contct {

using rational_rows = sparse_rows<rational>;

/// A stiffness added at `dof`. If `other` >= 0, a spring between the two dofs, for which the matrix must have
/// an entry (which may be 0).
struct added_spring {
  int dof;
  rational stiffness;
  int other = -1;
};

/// Factors K + springs, which must be positive semidefinite, on the free dofs, and solves with the factor.
class lifted_solver {
 public:
  /// The default of `longest`.
  static constexpr std::size_t most_bits = std::size_t{1} << 19;

  /// `place`: the row of each dof in a narrow band. `longest`: the most bits of a numerator or denominator.
  /// All arguments must outlive this object.
  lifted_solver(const rational_rows& k, std::span<const char> fixed, std::span<const int> place,
                std::size_t longest = most_bits);

  /// Throws too_long, and std::runtime_error if the matrix is indefinite.
  void factor(const std::vector<added_spring>& springs);

  /// An exact basis of the motions that K + springs does not resist [motions][dofs].
  [[nodiscard]] const std::vector<rational_vector>& free_motions() const { return free_motions_; }

  /// True if a dof is free and has a pivot. Each free dof without a pivot belongs to one rigid-body motion. K
  /// + springs is semidefinite if it is positive definite on the dofs with pivots.
  [[nodiscard]] bool has_pivot(std::size_t dof) const { return fixed_[dof] == 0 && free_[dof] == 0; }

  /// Solves (K + springs) x = b at every free dof, with x = 0 at fixed dofs. If there are rigid-body motions,
  /// b must do no work on them; one of the solutions is returned. Throws too_long.
  [[nodiscard]] rational_vector solve(const rational_vector& b) const;

 private:
  /// Arithmetic modulo the prime 2^61 - c with a small c: 2^61 = c modulo the prime.
  class field {
   public:
    explicit field(std::uint64_t prime) : p_(prime), c_((std::uint64_t{1} << 61U) - prime) {}
    [[nodiscard]] std::uint64_t prime() const { return p_; }
    [[nodiscard]] std::uint64_t minus(std::uint64_t a, std::uint64_t b) const {
      return a >= b ? a - b : a + p_ - b;
    }
    [[nodiscard]] std::uint64_t times(std::uint64_t a, std::uint64_t b) const {
      const wide product = static_cast<wide>(a) * b;  // below 2^122
      const wide rest = (product & low) + static_cast<wide>(high(product)) * c_;
      const std::uint64_t r = (static_cast<std::uint64_t>(rest) & low) + high(rest) * c_;
      return r >= p_ ? r - p_ : r;
    }
    [[nodiscard]] std::uint64_t inverse(std::uint64_t a) const;
    /// Computes the residue of a rational number; false if its denominator is a multiple of the prime.
    bool take(const rational& x, std::uint64_t& residue) const;

   private:
    __extension__ using wide = unsigned __int128;
    static constexpr std::uint64_t low = (std::uint64_t{1} << 61U) - 1;
    [[nodiscard]] static std::uint64_t high(wide x) { return static_cast<std::uint64_t>(x >> 61U); }
    std::uint64_t p_, c_;
  };

  /// A row of the equations, multiplied by the least number `scale` that makes all its entries integers.
  struct whole_row {
    std::vector<std::pair<int, integer>> entries;
    integer scale;
  };

  bool factor_modulo(std::uint64_t prime);
  bool find_free_motions();
  [[nodiscard]] whole_row whole(std::size_t dof) const;
  void solve_modulo(std::vector<std::uint64_t>& x) const;
  [[nodiscard]] rational entry(std::size_t row, int column, const rational& k) const;
  class lifting;

  const rational_rows& k_;
  std::span<const char> fixed_;
  std::span<const int> place_;
  std::size_t longest_;
  std::vector<int> dof_at_;                         // the inverse of place_
  std::size_t band_ = 0;                            // number of subdiagonals
  rational_vector spring_;                          // springs on the diagonal [dofs]
  std::map<std::pair<int, int>, rational> beside_;  // off-diagonal entries of springs; the key has both dofs
  field field_;                                     // field of the last factorisation
  std::vector<std::uint64_t> factor_;               // L and D of L D L' modulo the prime, as a band
  std::vector<std::uint64_t> inverse_;              // inverses of D; 0 without a pivot
  std::vector<char> free_;                          // 1: a free dof without a pivot [dofs]
  std::vector<whole_row> whole_;                    // rows of the equations [dofs]; empty without a pivot
  std::vector<std::uint64_t> unscale_;              // 1 / scale of each row, modulo the prime
  std::vector<rational_vector> free_motions_;
};

}  // namespace contct
