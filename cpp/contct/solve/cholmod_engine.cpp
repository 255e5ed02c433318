#include "contct/solve/cholmod_engine.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "contct/matrix/cholesky.hpp"
#include "contct/matrix/cholmod_library.hpp"
#include "contct/matrix/sparse_columns.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/refine.hpp"

namespace contct {
namespace {

constexpr int first_check = 16;
constexpr int longest_between_checks = 256;
constexpr double drift_allowed = 1e-10;  // of the response, relative to the largest

}  // namespace

class cholmod_engine::sparse {
 public:
  explicit sparse(const linear_structure& s)
      : structure_(s),
        wanted_(s.pairs.size()),
        applied_(s.pairs.size()),
        k_(entries_of(s.stiffness)),
        work_(rows()) {
    for (std::size_t i = 0; i < wanted_.size(); ++i) wanted_[i] = s.pairs[i].closed ? 1 : 0;
    common_->final_ll = 0;
    common_->supernodal = CHOLMOD_SIMPLICIAL;  // what can be updated
    if (s.stiffness.is_band()) {               // no better order than AMD's is worth its search then
      common_->nmethods = 1;
      common_->method[0].ordering = CHOLMOD_AMD;
    }
    for (int row = 0; row < s.stiffness.order(); ++row) bare_diagonal_.push_back(k_.diagonal(row));
    right_hand_side_ = made_by_cholmod(cholmod_zeros(rows(), 1, CHOLMOD_REAL, common_));
  }
  ~sparse() {
    cholmod_free_factor(&factor_, common_);
    cholmod_free_dense(&right_hand_side_, common_);
    cholmod_free_dense(&solution_, common_);
    cholmod_free_dense(&y_, common_);
    cholmod_free_dense(&e_, common_);
  }
  sparse(const sparse&) = delete;
  sparse& operator=(const sparse&) = delete;
  sparse(sparse&&) = delete;
  sparse& operator=(sparse&&) = delete;

  void want(int pair, bool closed) {
    wanted_[static_cast<std::size_t>(pair)] = closed ? 1 : 0;
    switched_.push_back(pair);
  }

  /// The factor, with the springs that are wanted: what closes first, then what opens.
  void bring_up_to_date() {
    if (factor_ == nullptr || !sound_) return factor_anew();
    for (const char closed : {char{1}, char{0}}) {
      for (const int pair : switched_) {
        const auto p = static_cast<std::size_t>(pair);
        if (wanted_[p] == closed && applied_[p] != closed && !update(pair)) return factor_anew();
      }
    }
    switched_.clear();
  }

  /// A factor that no update has been through.
  void factor_afresh() {
    const bool fresh = sound_ && applied_ == wanted_ && counts.updates == updates_at_factor_;
    if (!fresh) factor_anew();
  }

  void factor_anew() {
    applied_ = wanted_;
    switched_.clear();
    set_diagonal(diagonal_with_springs());
    cholmod_sparse k = seen_by_cholmod(k_.columns());
    if (factor_ == nullptr) factor_ = made_by_cholmod(cholmod_analyze(&k, common_));
    ++counts.factors;
    sound_ = cholmod_factorize(&k, factor_, common_) != 0 && common_->status == CHOLMOD_OK &&
             factor_->minor == factor_->n;
    set_diagonal(bare_diagonal_);
    if (!sound_)
      throw no_factor(
          "the structure is held, but its stiffness matrix is too ill-conditioned to be factored in double "
          "precision");
    until_check = 1;
    updates_at_factor_ = counts.updates;
  }

  /// K x = b, both in the order of the rows.
  void solve(std::span<const double> b, std::span<double> x) {
    std::copy(b.begin(), b.end(), static_cast<double*>(right_hand_side_->x));
    if (cholmod_solve2(CHOLMOD_A, factor_, right_hand_side_, nullptr, &solution_, nullptr, &y_, &e_,
                       common_) == 0)
      throw std::bad_alloc();
    ++counts.solves;
    std::copy_n(static_cast<const double*>(solution_->x), x.size(), x.begin());
  }

  /// b - K x with the springs in the factor; products and sums in long double.
  void residual(std::span<const double> b, std::span<const double> x, std::span<double> left) {
    std::vector<long double> r(b.begin(), b.end());
    k_.subtract_product(x, r);
    for (std::size_t i = 0; i < applied_.size(); ++i) {
      if (applied_[i] != 0 && !is_fixed(i))
        r[row_of(i)] -= static_cast<long double>(structure_.pairs[i].stiffness) * x[row_of(i)];
    }
    for (std::size_t i = 0; i < r.size(); ++i) left[i] = static_cast<double>(r[i]);
  }

  /// Of K as it is factored now.
  [[nodiscard]] std::vector<double> diagonal_with_springs() const {
    std::vector<double> diagonal = bare_diagonal_;
    for (std::size_t i = 0; i < applied_.size(); ++i)
      if (applied_[i] != 0 && !is_fixed(i)) diagonal[row_of(i)] += structure_.pairs[i].stiffness;
    return diagonal;
  }

  /// A load by dofs, in the order of the rows; none on what is fixed.
  [[nodiscard]] std::vector<double> in_rows(std::span<const double> load) const {
    std::vector<double> b(rows());
    for (std::size_t dof = 0; dof < load.size(); ++dof) {
      if (structure_.fixed[dof] == 0) b[row(dof)] = load[dof];
    }
    return b;
  }

  [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(structure_.stiffness.order()); }
  [[nodiscard]] std::size_t row(std::size_t dof) const {
    return static_cast<std::size_t>(structure_.row_of(static_cast<int>(dof)));
  }
  [[nodiscard]] std::size_t row_of(std::size_t pair) const {
    return row(static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(pair))));
  }

  /// Is x, which solved K x = b, still good? Corrects it by what is left over. What a fresh factor leaves
  /// over is rounding, and no new one would do better.
  [[nodiscard]] bool still_solves(std::span<const double> b, std::span<double> x) {
    ++counts.checks;
    std::vector<double> correction(rows());
    residual(b, x, work_);
    solve(work_, correction);
    double size = 0.0;
    double off = 0.0;
    for (std::size_t i = 0; i < applied_.size(); ++i) {
      size = std::max(size, std::abs(x[row_of(i)]));
      off = std::max(off, std::abs(correction[row_of(i)]));
    }
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += correction[i];
    if (counts.updates == updates_at_factor_) rounding_ = size > 0.0 ? off / size : 0.0;
    const bool good = off <= std::max(drift_allowed, 8 * rounding_) * size;
    if (!good) check_every = std::max(check_every / 2, 4);
    if (off < drift_allowed / 8 * size) check_every = std::min(2 * check_every, longest_between_checks);
    until_check = check_every;
    return good;
  }

  const linear_structure& structure_;
  engine_counts counts;
  int until_check = first_check;
  int check_every = first_check;
  std::vector<double> increment_rows;  // of the version
  std::uint64_t version = 0;

 private:
  [[nodiscard]] bool is_fixed(std::size_t pair) const {
    return structure_.fixed[static_cast<std::size_t>(structure_.dof_of_pair(static_cast<int>(pair)))] != 0;
  }

  /// L D L^T + sigma k e e^T for one pair. False when the factor has lost its soundness.
  bool update(int pair) {
    const auto p = static_cast<std::size_t>(pair);
    applied_[p] = wanted_[p];
    if (is_fixed(p)) return true;
    const auto* const order = static_cast<const int*>(factor_->Perm);
    if (place_.empty()) {
      place_.resize(rows());
      for (std::size_t i = 0; i < rows(); ++i)
        place_[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    }
    int starts[2] = {0, 1};
    int at = place_[row_of(p)];
    double value = std::sqrt(structure_.pairs[p].stiffness);
    cholmod_sparse one{};
    one.nrow = rows();
    one.ncol = 1;
    one.nzmax = 1;
    one.p = starts;
    one.i = &at;
    one.x = &value;
    one.itype = CHOLMOD_INT;
    one.xtype = CHOLMOD_REAL;
    one.dtype = CHOLMOD_DOUBLE;
    one.sorted = 1;
    one.packed = 1;
    ++counts.updates;
    // What a spring stiffer than the structure has swamped is not there again when it opens: look at once.
    if (wanted_[p] == 0 && structure_.pairs[p].stiffness > bare_diagonal_[row_of(p)]) until_check = 1;
    sound_ =
        cholmod_updown(wanted_[p] != 0 ? 1 : 0, &one, factor_, common_) != 0 && common_->status == CHOLMOD_OK;
    return sound_;
  }

  void set_diagonal(std::span<const double> diagonal) {
    for (std::size_t row = 0; row < rows(); ++row)
      k_.columns().diagonal(static_cast<int>(row)) = diagonal[row];
  }

  static sparse_columns entries_of(const stiffness_matrix& k) {
    return k.is_band() ? columns_of(k.band()) : k.columns();
  }

  cholmod_library common_;
  std::vector<char> wanted_, applied_;  // [pairs] closed
  std::vector<int> switched_;
  stiffness_matrix k_;                 // without zeros
  std::vector<double> bare_diagonal_;  // K's, without springs of pairs [rows]
  cholmod_factor* factor_ = nullptr;
  bool sound_ = false;
  std::int64_t updates_at_factor_ = 0;
  double rounding_ = 0.0;   // what is left over with a fresh factor, relative
  std::vector<int> place_;  // of each row in the factor's order
  cholmod_dense* right_hand_side_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
  std::vector<double> work_;  // [rows]
};

cholmod_engine::cholmod_engine(const linear_structure& s) : sparse_(std::make_unique<sparse>(s)) {}
cholmod_engine::~cholmod_engine() = default;

void cholmod_engine::switch_spring(int pair, bool closed) {
  sparse_->want(pair, closed);
}

engine_counts cholmod_engine::counts() const {
  return sparse_->counts;
}

void cholmod_engine::respond(const residual_load& residual, std::span<double> d_star) {
  sparse& k = *sparse_;
  k.bring_up_to_date();
  if (k.version != residual.version || residual.version == 0) {
    k.increment_rows = k.in_rows(residual.increment);
    k.version = residual.version;
  }
  std::vector<double> x(k.rows());
  k.solve(k.increment_rows, x);
  if (--k.until_check <= 0 && !k.still_solves(k.increment_rows, x)) {
    k.factor_anew();
    k.solve(k.increment_rows, x);
  }
  for (std::size_t i = 0; i < d_star.size(); ++i) d_star[i] = residual.share * x[k.row_of(i)];
}

void cholmod_engine::recover(std::span<const double> load, std::span<const double> pair_forces,
                             std::span<double> u) {
  sparse& k = *sparse_;
  k.factor_afresh();
  const std::vector<double> b = k.in_rows(with_pair_forces(k.structure_, load, pair_forces));
  std::vector<double> x(k.rows());
  k.solve(b, x);
  const auto scale = [&k](std::size_t row) {
    return std::sqrt(k.structure_.stiffness.diagonal(static_cast<int>(row)));
  };
  std::vector<double> left(k.rows());
  refine(std::span<double>(x), scale, [&](std::span<const double> at, std::span<double> correction) {
    k.residual(b, at, left);
    k.solve(left, correction);
  });
  for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] = x[k.row(dof)];
}

double cholmod_engine::reciprocal_condition() {
  sparse& k = *sparse_;
  try {
    k.factor_afresh();
  } catch (const no_factor&) {
    return 0.0;
  }
  std::vector<double> x(k.rows());
  return contct::reciprocal_condition(k.structure_.stiffness, k.diagonal_with_springs(),
                                      [&k, &x](std::span<double> b) {
                                        k.solve(b, x);
                                        std::copy(x.begin(), x.end(), b.begin());
                                      });
}

}  // namespace contct
