#include "contct/matrix/supernodal_solve.hpp"

#include <algorithm>
#include <cstddef>

#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct {
namespace {

/// One supernode.
struct block {
  const int* rows;
  const double* entries;
  std::size_t height;  // rows
  std::size_t width;   // columns

  [[nodiscard]] const double* column(std::size_t j) const { return entries + j * height; }
};

block block_of(const supernodes& l, std::size_t s) {
  return {&l.rows[static_cast<std::size_t>(l.row_places[s])],
          &l.entries[static_cast<std::size_t>(l.entry_places[s])],
          static_cast<std::size_t>(l.row_places[s + 1] - l.row_places[s]),
          static_cast<std::size_t>(l.columns[s + 1] - l.columns[s])};
}

double* row_at(double* b, int row) {
  return b + static_cast<std::size_t>(row) * side_by_side;
}

bool is_reached(const block& l, const double* b) {
  const double* const first = b + static_cast<std::size_t>(l.rows[0]) * side_by_side;
  return std::any_of(first, first + l.width * side_by_side, [](double x) { return x != 0.0; });
}

/// Two columns at a time: every row below is loaded and stored once for both.
void go_down(const block& l, double* b) {
  std::size_t j = 0;
  for (; j + 1 < l.width; j += 2) {
    const double* const one = l.column(j);
    const double* const two = l.column(j + 1);
    rows_side_by_side x_one = rows_side_by_side::load(row_at(b, l.rows[j]));
    rows_side_by_side x_two = rows_side_by_side::load(row_at(b, l.rows[j + 1]));
    x_one.divide(one[j]);
    x_one.store(row_at(b, l.rows[j]));
    x_two.subtract(one[j + 1], x_one);
    x_two.divide(two[j + 1]);
    x_two.store(row_at(b, l.rows[j + 1]));
    for (std::size_t i = j + 2; i < l.height; ++i) {
      double* const at = row_at(b, l.rows[i]);
      rows_side_by_side row = rows_side_by_side::load(at);
      row.subtract(one[i], x_one);
      row.subtract(two[i], x_two);
      row.store(at);
    }
  }
  if (j == l.width) return;
  const double* const last = l.column(j);
  rows_side_by_side x = rows_side_by_side::load(row_at(b, l.rows[j]));
  x.divide(last[j]);
  x.store(row_at(b, l.rows[j]));
  for (std::size_t i = j + 1; i < l.height; ++i) {
    rows_side_by_side row = rows_side_by_side::load(row_at(b, l.rows[i]));
    row.subtract(last[i], x);
    row.store(row_at(b, l.rows[i]));
  }
}

void go_up(const block& l, double* b) {
  for (std::size_t j = l.width; j-- > 0;) {
    const double* const column = l.column(j);
    rows_side_by_side sum{};
    for (std::size_t i = j + 1; i < l.height; ++i)
      sum.add(column[i], rows_side_by_side::load(row_at(b, l.rows[i])));
    rows_side_by_side x = rows_side_by_side::load(row_at(b, l.rows[j]));
    x.subtract(sum);
    x.divide(column[j]);
    x.store(row_at(b, l.rows[j]));
  }
}

}  // namespace

void solve_many(const supernodes& l, std::span<double> b) {
  for (std::size_t s = 0; s < l.count(); ++s) {
    const block of_s = block_of(l, s);
    if (is_reached(of_s, b.data())) go_down(of_s, b.data());
  }
  for (std::size_t s = l.count(); s-- > 0;) go_up(block_of(l, s), b.data());
}

}  // namespace contct
