// Columns of the inverse stiffness at the pairs, while springs go in and out of one factored stiffness.
#pragma once

#include <algorithm>
#include <cstddef>
#include <list>
#include <span>
#include <utility>
#include <vector>

#include "contct/matrix/block_solve.hpp"
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
  inverse_columns(const linear_structure& s, factored_stiffness& k0)
      : structure_(s), k0_(k0), pairs_(s.pairs.size()), column_(pairs_), dofs_(s.dofs()) {}

  /// The factor is a new one: drop all that depended on the last.
  void start_anew() {
    toggles_.clear();
    columns_.clear();
    at_toggle_.clear();
    blocks_.clear();
  }

  /// K^-1 e for the dof of a pair, at the pairs [pairs]; good until the next call of anything. `last_s`: the
  /// kernel's last scale factors [pairs], or nothing; the pairs with the least are likely to be next.
  [[nodiscard]] std::span<const double> column(int pair, std::span<const double> last_s) {
    const auto place_in = [pair](block& b) { return std::find(b.pairs.begin(), b.pairs.end(), pair); };
    auto b =
        std::find_if(blocks_.begin(), blocks_.end(), [&](block& x) { return place_in(x) != x.pairs.end(); });
    if (b != blocks_.end()) {
      ++used_ahead_;
    } else {
      ++passes_;
      const std::vector<int> chosen = likely_next(pair, last_s);
      if (chosen.size() == 1) {
        solve_alone(pair);
        return column_;
      }
      solve_block(chosen);
      b = std::prev(blocks_.end());
    }
    bring_up_to_date(*b);
    const auto found = place_in(*b);
    const double* const entries = b->entries.data() + (found - b->pairs.begin());
    for (std::size_t i = 0; i < pairs_; ++i) column_[i] = entries[i * block_width];
    *found = used_up;
    if (--b->unused == 0) blocks_.erase(b);
    return column_;
  }

  /// K becomes K + sigma_k e e^T, for the pair whose column was asked for last. Returns g.
  double take_in(int pair, double sigma_k) {
    const double g = sigma_k / (1.0 + sigma_k * column_[pair]);
    std::vector<double> seen(toggles_.size());
    for (std::size_t l = 0; l < seen.size(); ++l) seen[l] = columns_[l][pair];
    at_toggle_.push_back(std::move(seen));
    columns_.push_back(column_);
    toggles_.push_back({pair, sigma_k, g});
    return g;
  }

  /// K0^-1 b becomes K^-1 b, at the pairs [pairs].
  void correct(std::span<double> at_pairs) const {
    for (std::size_t j = 0; j < toggles_.size(); ++j) {
      const double* const c = columns_[j].data();
      const double factor = toggles_[j].weight * at_pairs[toggles_[j].pair];
      for (std::size_t i = 0; i < pairs_; ++i) at_pairs[i] -= factor * c[i];
    }
  }

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
  static constexpr int used_up = -1;  // in place of a pair

  /// A toggle's column, and how much of it is subtracted from each column of a block.
  struct part {
    const double* column;
    block_row coefficients;
  };

  /// The pair, and as many others as fill a block: those with the least scale factors whose columns are not
  /// yet solved for. Only the pair itself while fewer than half of such columns are used.
  [[nodiscard]] std::vector<int> likely_next(int pair, std::span<const double> last_s) const {
    std::vector<int> chosen = {pair};
    constexpr std::size_t enough_to_judge = 4 * block_width;
    const bool seldom_used = solved_ahead_ >= enough_to_judge && 2 * used_ahead_ < solved_ahead_;
    if (last_s.size() != pairs_ || seldom_used) return chosen;
    std::vector<char> there(pairs_);
    for (const block& b : blocks_)
      for (const int p : b.pairs)
        if (p != used_up) there[p] = 1;
    there[pair] = 1;
    std::vector<std::pair<double, int>> nearest;
    for (int i = 0; i < static_cast<int>(pairs_); ++i)
      if (last_s[i] < 1.0 && there[i] == 0) nearest.emplace_back(last_s[i], i);
    const auto wanted = nearest.begin() + static_cast<int>(std::min(block_width - 1, nearest.size()));
    std::partial_sort(nearest.begin(), wanted, nearest.end());
    for (auto n = nearest.begin(); n != wanted; ++n) chosen.push_back(n->second);
    return chosen;
  }

  void solve_alone(int pair) {
    const int dof = structure_.dof_of_pair(pair);
    std::fill(dofs_.begin(), dofs_.end(), 0.0);
    k0_.solve_unit(dof, dofs_);
    gather_at_pairs(structure_, dofs_, column_);
    correct(column_);
  }

  void solve_block(const std::vector<int>& chosen) {
    std::vector<int> at_dofs;
    at_dofs.reserve(chosen.size());
    for (const int p : chosen) at_dofs.push_back(structure_.dof_of_pair(p));
    block& b = blocks_.emplace_back();
    k0_.solve_units_at_pairs(at_dofs, b.entries);
    b.pairs = chosen;
    b.unused = chosen.size();
    solved_ahead_ += chosen.size() - 1;
  }

  /// Apply the toggles since the block's last correction. What toggle j subtracts from a column depends on
  /// what those before it have left at its pair: these coefficients come first, from the few entries that
  /// they need. Then the columns are corrected in stretches that stay in the cache.
  void bring_up_to_date(block& b) const {
    const std::size_t first = b.corrected;
    const std::size_t last = toggles_.size();
    b.corrected = last;
    std::vector<part> parts;
    for (std::size_t j = first; j < last; ++j) {
      block_row here = block_row::load(&b.entries[toggles_[j].pair * block_width]);
      for (std::size_t l = first; l < j; ++l) here.subtract(at_toggle_[j][l], parts[l - first].coefficients);
      block_row coefficients{};
      coefficients.add(toggles_[j].weight, here);
      parts.push_back({columns_[j].data(), coefficients});
    }
    const std::vector<double> zeros(parts.size() % 2 != 0 ? pairs_ : 0);
    if (!zeros.empty()) parts.push_back({zeros.data(), {}});  // two at a time
    double* const rows = b.entries.data();
    constexpr std::size_t stretch = 256;
    for (std::size_t from = 0; from < pairs_; from += stretch) {
      const std::size_t to = std::min(from + stretch, pairs_);
      for (std::size_t j = 0; j < parts.size(); j += 2) {
        const auto& [one, by_one] = parts[j];
        const auto& [two, by_two] = parts[j + 1];
        for (std::size_t i = from; i < to; ++i)
          subtract_from(rows + i * block_width, one[i], by_one, two[i], by_two);
      }
    }
  }

  const linear_structure& structure_;
  factored_stiffness& k0_;
  std::size_t pairs_;
  std::vector<toggle> toggles_;
  std::vector<std::vector<double>> columns_;    // c_j [toggles][pairs]
  std::vector<std::vector<double>> at_toggle_;  // [j][l] = (c_l) at the pair of toggle j, l < j
  std::list<block> blocks_;
  std::vector<double> column_;  // the last one asked for [pairs]
  std::vector<double> dofs_;    // working space: one solution
  int passes_ = 0;
  std::size_t solved_ahead_ = 0, used_ahead_ = 0;
};

}  // namespace contct::solve
