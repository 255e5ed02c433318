#include "contct/distributed/petsc/own_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "contct/structure/plate_rows.hpp"
#include "contct/structure/true_plate.hpp"

namespace contct::distributed::petsc {
namespace {

using matrix::full_rows;

double rounded(double x) {
  return x;
}
double rounded(const double_double& x) {
  return x.hi;
}

/// Calls each(row, column, value) for own rows; rows from 0 here, columns of the whole.
template <class Number, class Each>
void each_entry(const full_rows<Number>& k, const Each& each) {
  for (std::size_t row = 0; row + 1 < k.starts.size(); ++row)
    for (std::size_t at = k.starts[row]; at < k.starts[row + 1]; ++at)
      each(row, static_cast<std::size_t>(k.columns[at]), k.values[at]);
}

template <class Number>
std::vector<Number> diagonal_of(const full_rows<Number>& k) {
  std::vector<Number> own(k.starts.size() - 1);
  each_entry(k, [&](std::size_t row, std::size_t column, const Number& x) {
    if (column == row + static_cast<std::size_t>(k.first)) own[row] = x;
  });
  return own;
}

template <class Number>
std::vector<double> sums_of(const full_rows<Number>& k, std::span<const double> x) {
  std::vector<double> own(k.starts.size() - 1);
  each_entry(k, [&](std::size_t row, std::size_t column, const Number& /*value*/) { own[row] += x[column]; });
  return own;
}

}  // namespace

template <class Number>
upper_rows upper_of(const full_rows<Number>& k, std::span<const double> d) {
  upper_rows own;
  for (std::size_t row = 0; row + 1 < k.starts.size(); ++row) {
    const int number = k.first + static_cast<int>(row);
    own.columns.push_back(number);
    own.values.push_back(0.0);
    for (std::size_t at = k.starts[row]; at < k.starts[row + 1]; ++at) {
      const int column = k.columns[at];
      const double by = d[static_cast<std::size_t>(number)] * d[static_cast<std::size_t>(column)];
      if (column == number) own.values.back() = rounded(k.values[at] * by);
      if (column <= number) continue;
      own.columns.push_back(column);
      own.values.push_back(rounded(k.values[at] * by));
    }
    own.starts.push_back(static_cast<PetscInt>(own.columns.size()));
  }
  return own;
}
template upper_rows upper_of(const full_rows<double>&, std::span<const double>);
template upper_rows upper_of(const full_rows<double_double>&, std::span<const double>);

std::vector<double_double> own_truth::diagonal() const {
  return diagonal_of(rows);
}

std::vector<double_double> own_truth::times(std::span<const double_double> x) const {
  std::vector<double_double> own(rows.starts.size() - 1);
  each_entry(rows, [&](std::size_t row, std::size_t column, const double_double& value) {
    own[row] += value * x[column];
  });
  return own;
}

std::vector<double> own_truth::sums(std::span<const double> x) const {
  return sums_of(rows, x);
}

int own_truth::widest_row() const {
  std::size_t most = 0;
  for (std::size_t row = 0; row + 1 < rows.starts.size(); ++row)
    most = std::max(most, rows.starts[row + 1] - rows.starts[row]);
  return static_cast<int>(most);
}

void own_matrix::scale(std::span<const double> d) {
  for (std::size_t own = 0; own + 1 < rows.starts.size(); ++own)
    for (std::size_t at = rows.starts[own]; at < rows.starts[own + 1]; ++at) {
      const auto [lower, upper] = std::minmax(
          {own + static_cast<std::size_t>(rows.first), static_cast<std::size_t>(rows.columns[at])});
      rows.values[at] =
          rows.values[at] * d[upper] * d[lower];  // as stiffness_matrix::scale, in both triangles
    }
}

std::vector<double> own_matrix::diagonal() const {
  return diagonal_of(rows);
}

std::vector<matrix::matrix_entry> own_matrix::entries_in(std::span<const char> columns) const {
  std::vector<matrix::matrix_entry> found;
  each_entry(rows, [&](std::size_t row, std::size_t column, double value) {
    const auto number = rows.first + static_cast<int>(row);
    if (columns[column] != 0 && value != 0.0 && static_cast<int>(column) != number)
      found.push_back({number, static_cast<int>(column), value});
  });
  return found;
}

std::vector<long double> own_matrix::times(std::span<const long double> x) const {
  std::vector<long double> own(rows.starts.size() - 1);
  each_entry(rows, [&](std::size_t row, std::size_t column, double value) {
    if (column != row + static_cast<std::size_t>(rows.first)) own[row] += value * x[column];
  });
  return own;
}

std::vector<double> own_matrix::magnitudes(std::span<const double> d) const {
  std::vector<double> own(rows.starts.size() - 1);
  each_entry(rows, [&](std::size_t row, std::size_t column, double value) {
    const std::size_t number = row + static_cast<std::size_t>(rows.first);
    if (column != number) own[row] += std::abs(value * (d[number] * d[column]));
  });
  return own;
}

std::vector<double> own_matrix::half_units(std::span<const double> x) const {
  std::vector<double> own(rows.starts.size() - 1);
  if (last_digits.empty()) return own;
  for (std::size_t row = 0; row + 1 < rows.starts.size(); ++row)
    for (std::size_t at = rows.starts[row]; at < rows.starts[row + 1]; ++at)
      if (last_digits[at] != matrix::sparse_matrix::exact_entry)
        own[row] += 0.5 * std::pow(10.0, last_digits[at]) * x[static_cast<std::size_t>(rows.columns[at])];
  return own;
}

std::vector<double> own_matrix::sums(std::span<const double> x) const {
  return sums_of(rows, x);
}

own_truth own_matrix::truth() const {
  const int count = rows.count();
  if (from) {
    structure::true_element_stiffness stiffness(*from);
    return {structure::rows_of<double_double>(*from, rows.first, count, stiffness)};
  }
  own_truth t{{rows.first, rows.starts, rows.columns, {}}};
  for (const double x : rows.values) t.rows.values.push_back(numeric::long_decimal(x));
  return t;
}

own_motions own_matrix::rigid_motions(std::span<const double> d) const {
  if (!from) return {};
  own_motions motions(3);
  for (int row = rows.first; row < rows.first + rows.count(); ++row) {
    const int node = row / 3;
    const double x = from->x[static_cast<std::size_t>(node % from->columns())] - from->x.front();
    const double y = from->y[static_cast<std::size_t>(node / from->columns())] - from->y.front();
    const double at[3][3] = {{1, x, y}, {0, 1, 0}, {0, 0, 1}};
    const double scale = d[static_cast<std::size_t>(row)];
    for (std::size_t m = 0; m < 3; ++m) motions[m].push_back(scale == 0.0 ? 0.0 : at[row % 3][m] / scale);
  }
  return motions;
}

own_matrix matrix_of(const std::shared_ptr<const structure::plate>& p, const own_rows& own) {
  return {structure::stiffness_rows(*p, own.first, own.count), {}, p};
}

}  // namespace contct::distributed::petsc
