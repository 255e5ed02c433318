// CHOLMOD alone: semismooth Newton, which is a guess of the springs that press, a solve, the next guess.
//     updown   L D L' in AMD's order, updated and downdated by the springs that change
//     factor   the supernodal L L', computed anew for each guess
#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bench/peers/exchange.hpp"

namespace {

using bench::peers::answer;
using bench::peers::contact_problem;

class newton {
 public:
  newton(const contact_problem& p, bool updown) : problem_(p), updown_(updown), closed_(p.springs.size()) {
    (void)cholmod_start(&common_);
    common_.supernodal = updown ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
    common_.final_ll = updown ? 0 : 1;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
    matrix_ = matrix_of(p.stiffness);
    factor_ = cholmod_analyze(matrix_, &common_);
    load_ = cholmod_zeros(static_cast<std::size_t>(p.rows()), 1, CHOLMOD_REAL, &common_);
    if (cholmod_factorize(matrix_, factor_, &common_) == 0 || common_.status != CHOLMOD_OK)
      throw std::runtime_error("the supports alone do not hold the structure");
  }
  newton(const newton&) = delete;
  newton& operator=(const newton&) = delete;
  ~newton() {
    (void)cholmod_free_dense(&load_, &common_);
    (void)cholmod_free_factor(&factor_, &common_);
    (void)cholmod_free_sparse(&matrix_, &common_);
    (void)cholmod_finish(&common_);
  }

  answer run() {
    constexpr int most = 200;
    answer a;
    while (!a.found && a.steps++ < most) {
      a.u = displacement();
      a.found = !take_pressed(a.u);
    }
    return a;
  }

 private:
  cholmod_sparse* matrix_of(const contct::matrix::sparse_columns& k) {
    const auto n = static_cast<std::size_t>(k.order());
    cholmod_sparse* a = cholmod_allocate_sparse(n, n, k.values.size(), 1, 1, -1, CHOLMOD_REAL, &common_);
    std::copy(k.starts.begin(), k.starts.end(), static_cast<int*>(a->p));
    std::copy(k.rows.begin(), k.rows.end(), static_cast<int*>(a->i));
    std::copy(k.values.begin(), k.values.end(), static_cast<double*>(a->x));
    return a;
  }

  std::vector<double> displacement() {
    auto* b = static_cast<double*>(load_->x);
    std::copy(problem_.load.begin(), problem_.load.end(), b);
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      const bench::peers::one_sided_spring& s = problem_.springs[i];
      if (closed_[i] != 0) b[s.row] += s.stiffness * s.face;
    }
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, load_, &common_);
    const auto* first = static_cast<const double*>(x->x);
    std::vector<double> u(first, first + problem_.rows());
    (void)cholmod_free_dense(&x, &common_);
    return u;
  }

  /// False where the springs that press under `u` are those that are in.
  bool take_pressed(const std::vector<double>& u) {
    std::vector<std::size_t> in, out;
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      const bench::peers::one_sided_spring& s = problem_.springs[i];
      const char pressed = s.side * (u[s.row] - s.face) > 0.0 ? 1 : 0;
      if (pressed != closed_[i]) (pressed != 0 ? in : out).push_back(i);
      closed_[i] = pressed;
    }
    if (in.empty() && out.empty()) return false;
    if (updown_) {
      change(in, 1);
      change(out, 0);
    } else {
      factor_anew();
    }
    return true;
  }

  /// A column for each spring: sqrt(k) at its row of the factor.
  void change(const std::vector<std::size_t>& springs, int add) {
    if (springs.empty()) return;
    const auto n = static_cast<std::size_t>(problem_.rows());
    cholmod_sparse* c =
        cholmod_allocate_sparse(n, springs.size(), springs.size(), 1, 1, 0, CHOLMOD_REAL, &common_);
    places_.resize(n);
    const auto* order = static_cast<const int*>(factor_->Perm);
    for (std::size_t i = 0; i < n; ++i) places_[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    for (std::size_t j = 0; j < springs.size(); ++j) {
      const bench::peers::one_sided_spring& s = problem_.springs[springs[j]];
      static_cast<int*>(c->p)[j] = static_cast<int>(j);
      static_cast<int*>(c->i)[j] = places_[static_cast<std::size_t>(s.row)];
      static_cast<double*>(c->x)[j] = std::sqrt(s.stiffness);
    }
    static_cast<int*>(c->p)[springs.size()] = static_cast<int>(springs.size());
    const int good = cholmod_updown(add, c, factor_, &common_);
    (void)cholmod_free_sparse(&c, &common_);
    if (good == 0 || common_.status != CHOLMOD_OK) throw std::runtime_error("cholmod_updown failed");
  }

  void factor_anew() {
    auto* x = static_cast<double*>(matrix_->x);
    std::copy(problem_.stiffness.values.begin(), problem_.stiffness.values.end(), x);
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      const bench::peers::one_sided_spring& s = problem_.springs[i];
      if (closed_[i] != 0) x[problem_.stiffness.starts[s.row]] += s.stiffness;
    }
    if (cholmod_factorize(matrix_, factor_, &common_) == 0 || common_.status != CHOLMOD_OK)
      throw std::runtime_error("K with the springs has no factor");
  }

  const contact_problem& problem_;
  bool updown_;
  std::vector<char> closed_;  // [springs]
  std::vector<int> places_;   // [rows] in the factor
  cholmod_common common_{};
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* load_ = nullptr;
};

answer solve(const std::string& method, const std::string& folder) {
  if (method != "updown" && method != "factor")
    throw std::invalid_argument("found method " + method + "; allowed: updown, factor");
  const contact_problem p = bench::peers::read_problem(folder);
  const double start = bench::peers::process_seconds();
  answer a = newton(p, method == "updown").run();
  a.seconds = bench::peers::process_seconds() - start;
  a.forces = bench::peers::forces_under(p, a.u);
  return a;
}

}  // namespace

int main(int argc, char** argv) {
  return bench::peers::solve_as_asked(argc, argv, solve);
}
