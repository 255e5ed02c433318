// Columns of the inverse stiffness at the pairs, while springs go in and out of one factored stiffness.
#pragma once

#include <cstddef>
#include <list>
#include <span>
#include <vector>

#include "contct/solve/factored_stiffness.hpp"

namespace contct::solve {

/// K0 is factored; K = K0 + the springs that have been taken in since, or less those taken out. With
/// c_j = K_j^-1 e_j, the column of toggle j when it came, and g_j = sigma k / (1 + sigma k (c_j)_p),
///
///     K^-1 = K0^-1 - sum g_j c_j c_j^T                                  (Sherman and Morrison)
///
/// restricted to the pairs everywhere. Columns of K0^-1 do not depend on the toggles: those of pairs that
/// are likely to be next are solved for together, in one pass over the factor, and corrected together, in
/// one pass over the c_j.
class inverse_columns {
 public:
  /// Both must outlive this object.
  inverse_columns(const linear_structure& s, factored_stiffness& k0);

  /// The factor is a new one: drop all that depended on the last.
  void start_anew();

  /// K^-1 e for the dof of a pair, at the pairs [pairs]; good until the next call of anything. `last_s`: the
  /// kernel's last scale factors [pairs], or nothing; the pairs with the least are likely to be next.
  [[nodiscard]] std::span<const double> column(int pair, std::span<const double> last_s);

  /// K becomes K + sigma_k e e^T, for the pair whose column was asked for last. Returns g.
  double take_in(int pair, double sigma_k);

  /// K0^-1 b becomes K^-1 b, at the pairs [pairs].
  void correct(std::span<double> at_pairs) const;

  [[nodiscard]] std::size_t toggles() const { return toggles_.size(); }

  struct toggle {
    int pair;
    double sigma_k;
    double weight;  // g
  };
  [[nodiscard]] std::span<const toggle> all_toggles() const { return toggles_; }

  [[nodiscard]] int passes() const { return passes_; }  ///< over the factor, so far

 private:
  /// A block of columns: entries[pair * block_width + i] belong to that of pairs[i].
  struct block {
    std::vector<int> pairs;
    std::vector<double> entries;
    std::size_t corrected = 0;  // the toggles that it has been corrected by
    std::size_t unused = 0;
  };

  [[nodiscard]] std::vector<int> likely_next(int pair, std::span<const double> last_s) const;
  void solve_alone(int pair);
  void solve_block(const std::vector<int>& chosen);
  void bring_up_to_date(block& b) const;

  const linear_structure& structure_;
  factored_stiffness& k0_;
  std::size_t pairs_;
  std::vector<toggle> toggles_;
  std::vector<std::vector<double>> columns_;    // c_j [toggles][pairs]
  std::vector<std::vector<double>> at_toggle_;  // [j][l] = (c_l) at the pair of toggle j, l < j
  std::list<block> blocks_;
  std::vector<double> column_;       // the last one asked for [pairs]
  std::vector<double> dofs_, rows_;  // working space: one solution, a block of them
  int passes_ = 0;
  std::size_t solved_ahead_ = 0, used_ahead_ = 0;
};

}  // namespace contct::solve
