#include "contct/linear/cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "contct/linear/fortran_names.h"  // CONTCT_FC_GLOBAL(name, NAME), made by CMake

// gfortran passes the lengths of CHARACTER arguments after all other arguments.
extern "C" {
void CONTCT_FC_GLOBAL(dpbtrf, DPBTRF)(const char* uplo, const int* n, const int* kd, double* ab,
                                      const int* ldab, int* info, std::size_t uplo_length);
void CONTCT_FC_GLOBAL(dpbtrs, DPBTRS)(const char* uplo, const int* n, const int* kd, const int* nrhs,
                                      const double* ab, const int* ldab, double* b, const int* ldb, int* info,
                                      std::size_t uplo_length);
void CONTCT_FC_GLOBAL(dlacn2, DLACN2)(const int* n, double* v, double* x, int* isgn, double* est, int* kase,
                                      int* isave);
}

namespace contct {
namespace {

/// 1 / sqrt of each entry, which scales a matrix with this diagonal to a unit diagonal. Empty if an entry is
/// not positive.
std::vector<double> unit_scale(std::span<const double> diagonal) {
  std::vector<double> d;
  for (const double entry : diagonal) {
    if (!(entry > 0.0)) return {};
    d.push_back(1.0 / std::sqrt(entry));
  }
  return d;
}

/// Hager and Higham's estimate of the 1-norm of the inverse (dlacn2), by a handful of solves. Unlike dpbcon,
/// this function does not guard its solves against overflow: for an ill-conditioned matrix dpbcon's guard
/// (dlatbs) scans the rest of the vector at every row, which takes minutes on a beam of 100,000 nodes.
double norm_of_inverse(int n, const in_place_solver& solve) {
  std::vector<double> v(n);
  std::vector<double> x(n);
  std::vector<int> isgn(n);
  int isave[3] = {};
  int kase = 0;
  double estimate = 0.0;
  do {
    CONTCT_FC_GLOBAL(dlacn2, DLACN2)(&n, v.data(), x.data(), isgn.data(), &estimate, &kase, isave);
    if (kase != 0) solve(x);  // dlacn2 asks for A^-1 x or A^-T x, which are equal
  } while (kase != 0);
  return estimate;
}

double reciprocal(double norm, double inverse_norm) {
  return std::isfinite(norm) && std::isfinite(inverse_norm) ? 1.0 / inverse_norm / norm : 0.0;
}

class lapack_factor final : public matrix_factor {
 public:
  lapack_factor(int order, int subdiagonals) : order_(order), subdiagonals_(subdiagonals) {}

  [[nodiscard]] bool factor(const sparse_columns& a) override { return factor_with(a, {}); }
  [[nodiscard]] bool factor_with(const sparse_columns& k, std::span<const spring_at> springs) {
    if (band_.order() == 0) band_ = {order_, subdiagonals_};  // a factor that is never used takes no memory
    put_in(k, band_);
    for (const spring_at& s : springs) {
      band_.add(s.row, s.row, s.stiffness);
      if (s.other < 0) continue;
      band_.add(s.other, s.other, s.stiffness);
      band_.add(s.row, s.other, -s.stiffness);
    }
    return contct::factor(band_);
  }
  void solve(std::span<double> b) override { solve_with(band_, b); }
  [[nodiscard]] double flops() const override {
    const double kd = subdiagonals_;
    return order_ * kd * kd;
  }
  [[nodiscard]] bool is_band() const override { return true; }

 private:
  int order_, subdiagonals_;
  band_matrix band_;
};

}  // namespace

bool factor(band_matrix& matrix) {
  const int n = matrix.order();
  const int kd = matrix.subdiagonals();
  const int ldab = kd + 1;
  int info = 0;
  CONTCT_FC_GLOBAL(dpbtrf, DPBTRF)("L", &n, &kd, matrix.data(), &ldab, &info, 1);
  return info == 0;
}

void solve_with(const band_matrix& factor_of_a, std::span<double> b) {
  const int n = factor_of_a.order();
  const int kd = factor_of_a.subdiagonals();
  const int ldab = kd + 1;
  const int columns = n > 0 ? static_cast<int>(b.size()) / n : 0;
  int info = 0;
  CONTCT_FC_GLOBAL(dpbtrs, DPBTRS)("L", &n, &kd, &columns, factor_of_a.data(), &ldab, b.data(), &n, &info, 1);
}

double reciprocal_condition(const stiffness_matrix& k, std::span<const double> diagonal,
                            const in_place_solver& solve) {
  const std::vector<double> scale = unit_scale(diagonal);
  if (scale.empty()) return 0.0;
  const double inverse_norm = norm_of_inverse(k.order(), [diagonal, &solve](std::span<double> x) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] *= std::sqrt(diagonal[i]);
    solve(x);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] *= std::sqrt(diagonal[i]);
  });
  return reciprocal(k.one_norm(diagonal, scale), inverse_norm);
}

std::unique_ptr<matrix_factor> usual_factor(const stiffness_matrix& k) {
  if (!k.is_band()) return sparse_factor::make(k);
  return std::make_unique<lapack_factor>(k.order(), *k.subdiagonals);
}

int digits_left(double rcond) {
  if (!(rcond > 0.0)) return 0;
  const double digits = -std::log10(std::numeric_limits<double>::epsilon() / 2.0 / rcond);
  return std::clamp(static_cast<int>(digits), 0, 15);
}

bool stiffness_factor::factor(std::span<const spring_at> springs) {
  if (auto* const band = dynamic_cast<lapack_factor*>(factor_.get())) return band->factor_with(k_, springs);
  return factor_->factor(k_.with(springs));
}

/// The norm omits the off-diagonal entries of springs between two rows. With one such spring at a row, these
/// entries at most double the norm.
double stiffness_factor::reciprocal_condition(std::span<const spring_at> springs) {
  const std::vector<double> diagonal = k_.diagonal_with(springs);
  const auto solves = [this](std::span<double> b) { solve(b); };
  if (!factor_->is_band()) return factor(springs) ? contct::reciprocal_condition(k_, diagonal, solves) : 0.0;
  const std::vector<double> scale = unit_scale(diagonal);
  if (scale.empty()) return 0.0;
  const double norm = k_.one_norm(diagonal, scale);
  stiffness_matrix scaled = k_.with(springs);
  scaled.scale(scale);
  if (!std::isfinite(norm) || !factor_->factor(scaled)) return 0.0;
  return reciprocal(norm, norm_of_inverse(k_.order(), solves));
}

}  // namespace contct
