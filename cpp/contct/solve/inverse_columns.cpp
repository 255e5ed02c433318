#include "contct/solve/inverse_columns.hpp"

#include <algorithm>
#include <utility>

#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct {
namespace {

constexpr int used_up = -1;  // in place of a pair

/// A toggle's column, and what of it goes off each column of a block.
struct part {
  const double* column;
  rows_side_by_side coefficients;
};

/// Take two toggles' parts off the rows `from` to `to` of a block.
void subtract(double* rows, const part& one, const part& two, std::size_t from, std::size_t to) {
  for (std::size_t i = from; i < to; ++i) {
    rows_side_by_side at = rows_side_by_side::load(rows + i * side_by_side);
    at.subtract(one.column[i], one.coefficients);
    at.subtract(two.column[i], two.coefficients);
    at.store(rows + i * side_by_side);
  }
}

}  // namespace

inverse_columns::inverse_columns(const linear_structure& s, factored_stiffness& k0)
    : structure_(s),
      k0_(k0),
      pairs_(s.pairs.size()),
      column_(pairs_),
      dofs_(static_cast<std::size_t>(s.dofs())) {}

void inverse_columns::start_anew() {
  toggles_.clear();
  columns_.clear();
  at_toggle_.clear();
  blocks_.clear();
}

void inverse_columns::correct(std::span<double> at_pairs) const {
  for (std::size_t j = 0; j < toggles_.size(); ++j) {
    const double* const c = columns_[j].data();
    const double much = toggles_[j].weight * at_pairs[static_cast<std::size_t>(toggles_[j].pair)];
    for (std::size_t i = 0; i < pairs_; ++i) at_pairs[i] -= much * c[i];
  }
}

/// The pair, and as many others as fill a pass over the factor: those whose events the kernel last saw
/// nearest, and whose columns are not there yet. Only the pair itself while too few of such columns are ever
/// used.
std::vector<int> inverse_columns::likely_next(int pair, std::span<const double> last_s) const {
  std::vector<int> chosen = {pair};
  constexpr int worth_a_look = 4 * side_by_side;
  const bool seldom_used = solved_ahead_ >= worth_a_look && 2 * used_ahead_ < solved_ahead_;
  if (last_s.size() != pairs_ || seldom_used) return chosen;
  std::vector<char> there(pairs_);
  for (const block& b : blocks_)
    for (const int p : b.pairs)
      if (p != used_up) there[static_cast<std::size_t>(p)] = 1;
  std::vector<std::pair<double, int>> nearest;
  for (std::size_t i = 0; i < pairs_; ++i) {
    if (last_s[i] < 1.0 && static_cast<int>(i) != pair && there[i] == 0)
      nearest.emplace_back(last_s[i], static_cast<int>(i));
  }
  const auto wanted = std::min<std::size_t>(side_by_side - 1, nearest.size());
  std::partial_sort(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(wanted), nearest.end());
  for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(nearest[i].second);
  return chosen;
}

bool inverse_columns::is_ahead(int pair) const {
  return std::any_of(blocks_.begin(), blocks_.end(), [pair](const block& b) {
    return std::find(b.pairs.begin(), b.pairs.end(), pair) != b.pairs.end();
  });
}

std::span<const double> inverse_columns::column(int pair, std::span<const double> last_s) {
  if (is_ahead(pair)) {
    ++used_ahead_;
  } else {
    ++passes_;
    const std::vector<int> chosen = likely_next(pair, last_s);
    if (chosen.size() == 1) {
      solve_alone(pair);
      return column_;
    }
    solve_block(chosen);
  }
  for (auto b = blocks_.begin(); b != blocks_.end(); ++b) {
    const auto found = std::find(b->pairs.begin(), b->pairs.end(), pair);
    if (found == b->pairs.end()) continue;
    bring_up_to_date(*b);
    const auto at = static_cast<std::size_t>(found - b->pairs.begin());
    for (std::size_t i = 0; i < pairs_; ++i) column_[i] = b->entries[i * side_by_side + at];
    *found = used_up;
    if (--b->unused == 0) blocks_.erase(b);
    break;
  }
  return column_;
}

void inverse_columns::solve_alone(int pair) {
  std::fill(dofs_.begin(), dofs_.end(), 0.0);
  k0_.solve_unit(structure_.dof_of_pair(pair), dofs_);
  for (std::size_t i = 0; i < pairs_; ++i)
    column_[i] = dofs_[static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(i)))];
  correct(column_);
}

void inverse_columns::solve_block(const std::vector<int>& chosen) {
  std::vector<int> at_dofs;
  for (const int p : chosen) at_dofs.push_back(structure_.dof_of_pair(p));
  k0_.solve_units(at_dofs, many_);
  block& b = blocks_.emplace_back();
  b.pairs = chosen;
  b.unused = chosen.size();
  b.entries.resize(pairs_ * side_by_side);
  for (std::size_t i = 0; i < pairs_; ++i) {
    const auto at = static_cast<std::size_t>(structure_.row_of(structure_.dof_of_pair(static_cast<int>(i))));
    std::copy_n(&many_[at * side_by_side], side_by_side, &b.entries[i * side_by_side]);
  }
  solved_ahead_ += static_cast<int>(chosen.size()) - 1;
}

/// Apply the toggles that a block has not seen. What toggle j takes from a column depends on what those
/// before it have left at its pair: these coefficients come first, from the few entries they need. Then
/// the columns are gone through in stretches that stay in the cache.
void inverse_columns::bring_up_to_date(block& b) const {
  const std::size_t first = b.corrected;
  const std::size_t last = toggles_.size();
  b.corrected = last;
  std::vector<part> parts;
  for (std::size_t j = first; j < last; ++j) {
    rows_side_by_side here =
        rows_side_by_side::load(&b.entries[static_cast<std::size_t>(toggles_[j].pair) * side_by_side]);
    for (std::size_t l = first; l < j; ++l) here.subtract(at_toggle_[j][l], parts[l - first].coefficients);
    rows_side_by_side coefficients{};
    coefficients.add(toggles_[j].weight, here);
    parts.push_back({columns_[j].data(), coefficients});
  }
  const std::vector<double> zeros(parts.size() % 2 != 0 ? pairs_ : 0);
  if (!zeros.empty()) parts.push_back({zeros.data(), {}});  // two at a time
  constexpr std::size_t stretch = 256;
  for (std::size_t from = 0; from < pairs_; from += stretch) {
    const std::size_t to = std::min(from + stretch, pairs_);
    for (std::size_t j = 0; j < parts.size(); j += 2)
      subtract(b.entries.data(), parts[j], parts[j + 1], from, to);
  }
}

double inverse_columns::take_in(int pair, double sigma_k) {
  const double g = sigma_k / (1.0 + sigma_k * column_[static_cast<std::size_t>(pair)]);
  std::vector<double> seen(toggles_.size());
  for (std::size_t l = 0; l < seen.size(); ++l) seen[l] = columns_[l][static_cast<std::size_t>(pair)];
  at_toggle_.push_back(std::move(seen));
  columns_.push_back(column_);
  toggles_.push_back({pair, sigma_k, g});
  return g;
}

}  // namespace contct
