#include "contct/solve/inverse_columns.hpp"

#include <algorithm>
#include <utility>

#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct::solve {
namespace {

constexpr int used_up = -1;  // in place of a pair

/// A toggle's column, and how much of it is subtracted from each column of a block.
struct part {
  const double* column;
  block_row coefficients;
};

}  // namespace

inverse_columns::inverse_columns(const linear_structure& s, factored_stiffness& k0)
    : structure_(s), k0_(k0), pairs_(s.pairs.size()), column_(pairs_), dofs_(s.dofs()) {}

void inverse_columns::start_anew() {
  toggles_.clear();
  columns_.clear();
  at_toggle_.clear();
  blocks_.clear();
}

void inverse_columns::correct(std::span<double> at_pairs) const {
  for (std::size_t j = 0; j < toggles_.size(); ++j) {
    const double* const c = columns_[j].data();
    const double factor = toggles_[j].weight * at_pairs[toggles_[j].pair];
    for (std::size_t i = 0; i < pairs_; ++i) at_pairs[i] -= factor * c[i];
  }
}

/// The pair, and as many others as fill a block: those with the least scale factors whose columns are not yet
/// solved for. Only the pair itself while fewer than half of such columns are used.
std::vector<int> inverse_columns::likely_next(int pair, std::span<const double> last_s) const {
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

std::span<const double> inverse_columns::column(int pair, std::span<const double> last_s) {
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

void inverse_columns::solve_alone(int pair) {
  std::fill(dofs_.begin(), dofs_.end(), 0.0);
  k0_.solve_unit(structure_.dof_of_pair(pair), dofs_);
  gather_at_pairs(structure_, dofs_, column_);
  correct(column_);
}

void inverse_columns::solve_block(const std::vector<int>& chosen) {
  std::vector<int> at_dofs;
  at_dofs.reserve(chosen.size());
  for (const int p : chosen) at_dofs.push_back(structure_.dof_of_pair(p));
  k0_.solve_units(at_dofs, rows_);
  block& b = blocks_.emplace_back();
  b.pairs = chosen;
  b.unused = chosen.size();
  b.entries.resize(pairs_ * block_width);
  for (std::size_t i = 0; i < pairs_; ++i) {
    const int row = structure_.row_of(structure_.dof_of_pair(i));
    std::copy_n(&rows_[row * block_width], block_width, &b.entries[i * block_width]);
  }
  solved_ahead_ += chosen.size() - 1;
}

/// Apply the toggles since the block's last correction. What toggle j subtracts from a column depends on what
/// those before it have left at its pair: these coefficients come first, from the few entries that they need.
/// Then the columns are corrected in stretches that stay in the cache.
void inverse_columns::bring_up_to_date(block& b) const {
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

double inverse_columns::take_in(int pair, double sigma_k) {
  const double g = sigma_k / (1.0 + sigma_k * column_[pair]);
  std::vector<double> seen(toggles_.size());
  for (std::size_t l = 0; l < seen.size(); ++l) seen[l] = columns_[l][pair];
  at_toggle_.push_back(std::move(seen));
  columns_.push_back(column_);
  toggles_.push_back({pair, sigma_k, g});
  return g;
}

}  // namespace contct::solve
