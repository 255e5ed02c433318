#include "contct/matrix/supernodal_solve.hpp"

#include <algorithm>

#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct::matrix {
namespace {

struct supernode {
  const int* rows;
  const double* entries;
  std::size_t height;  // rows
  std::size_t width;   // columns
  double* b;           // the right-hand sides

  [[nodiscard]] const double* column(std::size_t j) const { return entries + j * height; }
  /// The right-hand sides' row that belongs to row i of the supernode.
  [[nodiscard]] double* row(std::size_t i) const { return b + rows[i] * block_width; }
};

supernode supernode_at(const supernodes& l, std::size_t s, std::span<double> b) {
  const std::size_t height = l.row_places[s + 1] - l.row_places[s];
  const std::size_t width = l.columns[s + 1] - l.columns[s];
  return {&l.rows[l.row_places[s]], &l.entries[l.entry_places[s]], height, width, b.data()};
}

bool is_zero(const supernode& s) {
  return std::all_of(s.row(0), s.row(0) + s.width * block_width, [](double x) { return x == 0.0; });
}

/// Two columns at a time: every row below is loaded and stored once for both.
void forward_substitution(supernode s) {
  std::size_t j = 0;
  for (; j + 1 < s.width; j += 2) {
    const double* const one = s.column(j);
    const double* const two = s.column(j + 1);
    const block_row x_one = divide(s.row(j), one[j]);
    subtract_from(s.row(j + 1), one[j + 1], x_one);
    const block_row x_two = divide(s.row(j + 1), two[j + 1]);
    for (std::size_t i = j + 2; i < s.height; ++i) subtract_from(s.row(i), one[i], x_one, two[i], x_two);
  }
  if (j == s.width) return;
  const double* const last = s.column(j);
  const block_row x = divide(s.row(j), last[j]);
  for (std::size_t i = j + 1; i < s.height; ++i) subtract_from(s.row(i), last[i], x);
}

void back_substitution(supernode s) {
  for (std::size_t j = s.width; j-- > 0;) {
    const double* const column = s.column(j);
    block_row sum{};
    for (std::size_t i = j + 1; i < s.height; ++i) sum.add(column[i], block_row::load(s.row(i)));
    divide(s.row(j), column[j], sum);
  }
}

}  // namespace

void solve_block(const supernodes& l, std::span<double> b) {
  for (std::size_t s = 0; s < l.count(); ++s) {
    const supernode of_s = supernode_at(l, s, b);
    if (!is_zero(of_s)) forward_substitution(of_s);
  }
  for (std::size_t s = l.count(); s-- > 0;) back_substitution(supernode_at(l, s, b));
}

}  // namespace contct::matrix
