#include "contct/structure/rigid_modes.hpp"

#include <limits>
#include <stdexcept>
#include <string>

#include "contct/linear/cholesky.hpp"
#include "contct/linear/fortran_names.h"  // CONTCT_FC_GLOBAL(name, NAME), made by CMake
#include "contct/number/random.hpp"

extern "C" void CONTCT_FC_GLOBAL(dsyev, DSYEV)(const char* jobz, const char* uplo, const int* n, double* a,
                                               const int* lda, double* w, double* work, const int* lwork,
                                               int* info, std::size_t jobz_length, std::size_t uplo_length);

namespace contct {
namespace {

constexpr int most_tried = 10;              // eigenvectors: six rigid-body motions, and four more
constexpr double surely_held = 1e-11;       // reciprocal condition above which no motion is free
constexpr double free_if_declared = 1e-10;  // largest eigenvalue of a declared motion
constexpr double most_rounded = 1e-4;       // the same if the eigenvalues stand apart, in magnitude
constexpr double shifts[] = {1e-13, 1e-12, 1e-11, 1e-10, 1e-8, 1e-6, 1e-4, 1e-3};
constexpr int most_iterations = 40;

using numbers = std::vector<double>;

double long_dot(const numbers& a, const numbers& b) {
  long double sum = 0.0L;
  for (std::size_t i = 0; i < a.size(); ++i) sum += static_cast<long double>(a[i]) * b[i];
  return static_cast<double>(sum);
}

std::string short_words(double x) {
  char text[40];
  (void)std::snprintf(text, sizeof text, "%.2g", x);
  return text;
}

[[noreturn]] void refuse_negative(const std::string& size, const std::string& way_out = "") {
  throw std::invalid_argument(
      "the matrix is not positive semidefinite: with its diagonal scaled to 1 it has "
      "an eigenvalue " +
      size + "; allowed: no eigenvalue below -" + short_words(negative_beyond) + way_out);
}

/// Returns D K D with 1 on the diagonal; `d` becomes the diagonal of D.
stiffness_matrix scaled(const stiffness_matrix& k, numbers& d) {
  stiffness_matrix a = k;
  for (int row = 0; row < k.order(); ++row) d.push_back(1.0 / std::sqrt(k.diagonal(row)));
  a.scale(d);
  return a;
}

/// Adds a shift to the diagonal of A and factors A, with the least of `shifts` for which this succeeds.
/// Throws std::invalid_argument if there is none.
void factor_shifted(stiffness_factor& a, int order) {
  for (const double shift : shifts) {
    std::vector<spring_at> everywhere(order);
    for (int row = 0; row < order; ++row) everywhere[row] = {row, shift};
    if (a.factor(everywhere)) return;
  }
  refuse_negative("below -" + short_words(*std::rbegin(shifts)));
}

/// The smallest eigenvalues of A and their eigenvectors, by inverse subspace iteration.
class subspace {
 public:
  explicit subspace(const stiffness_matrix& a) : a_(a), factor_(a) {
    factor_shifted(factor_, a.order());
    random_numbers random(1);
    vectors.assign(std::min(most_tried, a.order()), {});
    for (numbers& x : vectors)
      for (int i = 0; i < a.order(); ++i) x.push_back(random.unit() - 0.5);
  }

  void improve() {
    for (numbers& x : vectors) factor_.solve(x);
    for (int pass = 0; pass < 2; ++pass) make_orthonormal();
    rotate();
  }

  numbers values;
  std::vector<numbers> vectors;  // eigenvectors of `values`, orthonormal
  numbers left_over;             // the length of A x - lambda x for each eigenvector x

 private:
  void make_orthonormal() {
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double share = long_dot(vectors[i], vectors[j]);
        for (std::size_t r = 0; r < vectors[i].size(); ++r) vectors[i][r] -= share * vectors[j][r];
      }
      const double length = std::sqrt(long_dot(vectors[i], vectors[i]));
      for (double& entry : vectors[i]) entry /= length;
    }
  }

  /// Rayleigh-Ritz: replaces the vectors by the best approximations to eigenvectors in their span.
  void rotate() {
    const std::size_t m = vectors.size();
    const std::vector<numbers> before = vectors;
    std::vector<std::vector<long double>> minus_ax;
    for (const numbers& x : before) {
      minus_ax.emplace_back(x.size(), 0.0L);
      a_.subtract_product(x, minus_ax.back());
    }
    numbers h(m * m);
    for (std::size_t i = 0; i < m * m; ++i) {
      long double sum = 0.0L;
      for (std::size_t r = 0; r < before.front().size(); ++r) sum -= before[i / m][r] * minus_ax[i % m][r];
      h[i] = static_cast<double>(sum);
    }
    diagonalise(h);
    left_over.assign(m, 0.0);
    for (std::size_t i = 0; i < m; ++i) {
      long double left = 0.0L;
      for (std::size_t r = 0; r < vectors[i].size(); ++r) {
        long double entry = 0.0L;
        long double ax = 0.0L;
        for (std::size_t j = 0; j < m; ++j) {
          entry += static_cast<long double>(h[i * m + j]) * before[j][r];
          ax -= h[i * m + j] * minus_ax[j][r];
        }
        vectors[i][r] = static_cast<double>(entry);
        left += (ax - values[i] * entry) * (ax - values[i] * entry);
      }
      left_over[i] = static_cast<double>(std::sqrt(left));
    }
  }

  /// Replaces `h` by its eigenvectors, one after the other, and sets `values` to its eigenvalues.
  void diagonalise(numbers& h) {
    const int m = static_cast<int>(vectors.size());
    values.assign(vectors.size(), 0.0);
    numbers work(8 * vectors.size());
    const int room = static_cast<int>(work.size());
    int info = 0;
    CONTCT_FC_GLOBAL(dsyev, DSYEV)
    ("V", "L", &m, h.data(), &m, values.data(), work.data(), &room, &info, 1, 1);
    if (info != 0) throw std::runtime_error("dsyev found no eigenvalues of " + std::to_string(m) + " rows");
  }

  const stiffness_matrix& a_;
  stiffness_factor factor_;
};

int count_free(const numbers& values) {
  return static_cast<int>(
      std::count_if(values.begin(), values.end(), [](double v) { return v <= free_below; }));
}

/// Iterates until the smallest eigenvalues no longer change and the vectors of rigid-body motions no longer
/// improve.
void converge(subspace& space, std::optional<int> known) {
  double before = std::numeric_limits<double>::infinity();
  double first_held_before = 0.0;
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    space.improve();
    const std::size_t m = known.value_or(count_free(space.values));
    double left = 0.0;
    for (std::size_t i = 0; i < std::min(m, space.values.size()); ++i)
      left = std::max(left, space.left_over[i]);
    const double first_held = m < space.values.size() ? space.values[m] : 1.0;
    const bool still = std::abs(first_held - first_held_before) <= 0.01 * first_held;
    if (still && iteration > 2 && left >= before / 2) return;
    before = left;
    first_held_before = first_held;
  }
}

/// The displacements by the rigid-body motions [rows of the matrix]; the largest is 1. A row that is not
/// larger than its rounding error becomes 0.
std::vector<rigid_row> rows_of(const subspace& space, const numbers& d, const free_motions& f) {
  std::vector<rigid_row> rows(d.size());
  numbers sizes(d.size());
  for (std::size_t r = 0; r < d.size(); ++r) {
    for (int i = 0; i < f.count; ++i) rows[r][i] = space.vectors[i][r];
    sizes[r] = largest_of(rows[r]);
  }
  const double rounding = f.rounding * *std::max_element(sizes.begin(), sizes.end());
  double largest = 0.0;
  for (std::size_t r = 0; r < d.size(); ++r) {
    for (double& entry : rows[r]) entry = sizes[r] > rounding ? entry * d[r] : 0.0;
    largest = std::max(largest, largest_of(rows[r]));
  }
  for (rigid_row& row : rows)
    for (double& entry : row) entry /= largest;
  return rows;
}

/// True if the first `count` eigenvalues are rounding, because the next one is far larger. The eigenvalues of
/// a flexible structure have no such gap: for a cantilever, the second is 39 times the first.
bool stand_apart(const numbers& values, std::size_t count) {
  constexpr double gap = 1e3;
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(values[i]));
  return (count < values.size() ? values[count] : 1.0) > gap * largest;
}

/// The number of rigid-body motions: eigenvalues of at most `free_below` that stand apart from the others, or
/// else do not exceed their uncertainty.
int count_in_doubt(const subspace& space, const numbers& d,
                   const std::function<double(std::span<const double>)>& doubt) {
  int count = count_free(space.values);
  if (!doubt || stand_apart(space.values, count)) return count;
  const double of_values = 8 * std::numeric_limits<double>::epsilon() * space.values.back();  // dsyev's error
  for (int i = 0; i < count; ++i) {
    numbers u = space.vectors[i];
    for (std::size_t r = 0; r < u.size(); ++r) u[r] *= d[r];
    if (space.values[i] > doubt(u) + of_values) return i;
  }
  return count;
}

void refuse_count(const numbers& values, int in_doubt, std::optional<int> known) {
  const std::size_t declared = known.value_or(0);
  const auto are_rounded = [&values](std::size_t count) {
    return count <= values.size() && std::max(-values.front(), values[count - 1]) <= most_rounded &&
           stand_apart(values, count);
  };
  if (declared > 0 && are_rounded(declared)) return;
  if (values.front() < -negative_beyond) {
    const auto count = std::ranges::count_if(values, [&](double v) { return v <= -10 * values.front(); });
    const std::string number = std::to_string(count);
    refuse_negative("of " + short_words(values.front()),
                    are_rounded(count) ? ". If rounded entries are the cause, " + number +
                                             (count == 1 ? " motion is" : " motions are") +
                                             " nearly free: set free_motions = " + number
                                       : "");
  }
  if (declared > values.size() || (declared > 0 && values[declared - 1] > free_if_declared))
    throw std::invalid_argument("free_motions: found " + std::to_string(declared) +
                                "; allowed: " + std::to_string(in_doubt) +
                                ", the number of rigid-body motions of the matrix with its supports");
  if (!known && in_doubt > most_rigid_motions)
    throw std::invalid_argument("the matrix, with its supports, has more than " +
                                std::to_string(most_rigid_motions) +
                                " rigid-body motions; allowed: one free body, or parts that supports hold");
}

}  // namespace

void rigid_rank::hold(int dof, int other) {
  if (truth_ != nullptr) {
    if (rank_ == truth_->motions() || !truth_->is_independent(dofs(), dof)) return;
    dofs_.push_back(dof);
    ++rank_;
    return;
  }
  if (rank_ == most_rigid_motions) return;
  // Only the direction of the row counts: a slope's row, 1 over a length, may be of any size.
  rigid_row direction = rows_[dof];
  double size = 0.0;  // the largest entry of the two rows
  if (other >= 0) {
    size = std::max(largest_of(direction), largest_of(rows_[other]));
    for (std::size_t i = 0; i < direction.size(); ++i) direction[i] -= rows_[other][i];
  }
  const double largest = largest_of(direction);
  if (!(largest > independent_ * size)) return;
  for (double& entry : direction) entry /= largest;
  rigid_row rest = free_part(direction);
  const double left = std::sqrt(along(rest, rest));
  if (!(left > independent_ * std::sqrt(along(direction, direction)))) return;
  for (double& entry : rest) entry /= left;
  dofs_.push_back(dof);
  basis_[rank_++] = rest;
}

rigid_row rigid_rank::free_part(const rigid_row& motion) const {
  rigid_row rest = motion;
  for (int pass = 0; pass < 2; ++pass) {  // for Gram-Schmidt two passes are enough
    for (int k = 0; k < rank_; ++k) {
      const double share = along(rest, basis_[k]);
      for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= share * basis_[k][i];
    }
  }
  return rest;
}

free_motions find_free_motions(const stiffness_matrix& k, std::optional<int> known,
                               const std::function<double(std::span<const double>)>& doubt) {
  free_motions found;
  found.rows.assign(k.order(), rigid_row{});
  if (known.value_or(0) == 0) {
    const double rcond = stiffness_factor(k).reciprocal_condition({});
    if (rcond > surely_held || (known && rcond > 0.0)) return found;
  }
  numbers d;
  const stiffness_matrix a = scaled(k, d);
  subspace space(a);
  converge(space, known);
  const int in_doubt = count_in_doubt(space, d, doubt);
  refuse_count(space.values, in_doubt, known);
  found.count = known.value_or(in_doubt);
  const std::size_t m = found.count;
  if (m == 0) return found;
  double off = std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < m; ++i) {
    off = std::max({off, space.left_over[i], std::abs(space.values[i])});
    if (std::abs(space.values[i]) >= std::abs(found.stiffness)) found.stiffness = space.values[i];
  }
  const double softest_held = m < space.values.size() ? space.values[m] : 1.0;
  found.rounding = std::clamp(16 * off / softest_held, 1e-12, 1e-2);
  found.rows = rows_of(space, d, found);
  return found;
}

}  // namespace contct
