#include "bench/peers.hpp"

#ifdef CONTCT_BENCH_CHOLMOD

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "bench/cpu_clock.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/path/solve_problem.hpp"

namespace bench {
namespace {

using namespace contct;

/// It presses at a row of K with stiffness * side * (u - face) where that is positive.
struct one_sided_spring {
  int row, side;
  double face, stiffness;
};

/// Find u with K u + the springs' forces = load, at the dofs that no support fixes.
struct contact_problem {
  contct::sparse_columns stiffness;
  std::vector<double> load;
  std::vector<one_sided_spring> springs;
  std::vector<int> dofs;  // of each row
};

contact_problem contact_problem_of(const problem& p, const linear_structure& s) {
  const contct::sparse_columns all =
      s.stiffness.is_band() ? contct::columns_of(s.stiffness.band()) : s.stiffness.columns();
  std::vector<int> dof_at(static_cast<std::size_t>(s.dofs()));
  for (int dof = 0; dof < s.dofs(); ++dof) dof_at[s.row_of(dof)] = dof;
  std::vector<int> number(dof_at.size(), -1);  // of each row, among those that are free
  contact_problem c;
  for (int row = 0; row < all.order(); ++row) {
    if (s.fixed[dof_at[row]] != 0) continue;
    number[row] = static_cast<int>(c.dofs.size());
    c.dofs.push_back(dof_at[row]);
  }
  for (int column = 0; column < all.order(); ++column) {
    if (number[column] < 0) continue;
    for (int i = all.starts[column]; i < all.starts[column + 1]; ++i) {
      if (number[all.rows[i]] < 0) continue;
      c.stiffness.rows.push_back(number[all.rows[i]]);
      c.stiffness.values.push_back(all.values[i]);
    }
    c.stiffness.starts.push_back(static_cast<int>(c.stiffness.rows.size()));
  }
  std::vector<double> load(static_cast<std::size_t>(s.dofs()));
  loads_of(p, s)(1, load);
  for (const int dof : c.dofs) c.load.push_back(load[dof]);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const contact_pair& at = s.pairs[i];
    const int row = number[s.row_of(s.dof_of_pair(i))];
    if (row < 0) throw std::invalid_argument("found a pair at a fixed dof, which other programs do not have");
    c.springs.push_back({row, at.surface, at.face, at.stiffness});
  }
  return c;
}

class newton {
 public:
  // NOLINTBEGIN(cppcoreguidelines-prefer-member-initializer): CHOLMOD is to be started first
  newton(const contact_problem& p, bool updown) : problem_(p), updown_(updown), closed_(p.springs.size()) {
    (void)cholmod_start(&common_);
    common_.supernodal = updown ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
    common_.final_ll = updown ? 0 : 1;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
    matrix_ = matrix_of(p.stiffness);
    factor_ = cholmod_analyze(matrix_, &common_);
    load_ = cholmod_zeros(p.load.size(), 1, CHOLMOD_REAL, &common_);
    if (cholmod_factorize(matrix_, factor_, &common_) == 0 || common_.status != CHOLMOD_OK)
      throw std::runtime_error("the supports alone do not hold the structure");
  }
  // NOLINTEND(cppcoreguidelines-prefer-member-initializer)
  newton(const newton&) = delete;
  newton& operator=(const newton&) = delete;
  ~newton() {
    (void)cholmod_free_dense(&load_, &common_);
    (void)cholmod_free_factor(&factor_, &common_);
    (void)cholmod_free_sparse(&matrix_, &common_);
    (void)cholmod_finish(&common_);
  }

  /// Returns how many steps that took.
  int run() {
    constexpr int most = 200;
    for (int steps = 1; steps <= most; ++steps) {
      u = displacement();
      if (!take_pressed()) return steps;
    }
    throw std::runtime_error("Newton's method does not end");
  }

  std::vector<double> u;

 private:
  cholmod_sparse* matrix_of(const contct::sparse_columns& k) {
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
      const one_sided_spring& s = problem_.springs[i];
      if (closed_[i] != 0) b[s.row] += s.stiffness * s.face;
    }
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, load_, &common_);
    const auto* first = static_cast<const double*>(x->x);
    std::vector<double> found(first, first + problem_.load.size());
    (void)cholmod_free_dense(&x, &common_);
    return found;
  }

  /// False where the springs that press under `u` are those that are in.
  bool take_pressed() {
    std::vector<std::size_t> in, out;
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      const one_sided_spring& s = problem_.springs[i];
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
    const std::size_t n = problem_.load.size();
    cholmod_sparse* c =
        cholmod_allocate_sparse(n, springs.size(), springs.size(), 1, 1, 0, CHOLMOD_REAL, &common_);
    places_.resize(n);
    const auto* order = static_cast<const int*>(factor_->Perm);
    for (std::size_t i = 0; i < n; ++i) places_[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    for (std::size_t j = 0; j < springs.size(); ++j) {
      const one_sided_spring& s = problem_.springs[springs[j]];
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
      const one_sided_spring& s = problem_.springs[i];
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

/// Our own end, certified, and the proved bounds on it: no number of a kind is further from the truth.
class certified_end final : public observer {
 public:
  certified_end(const problem& p, const linear_structure& s) {
    certifier judge(p, s);
    observer* const observers[] = {&judge, this};
    (void)judge.find_final_states(observers);
    if (!judge.all_certified() || !judge.steps().front() || !judge.steps().front()->proved)
      throw std::runtime_error("the end of " + p.title + " is not certified");
    const certificate& c = *judge.steps().front();
    for (const quantity q : {quantity::w, quantity::slope, quantity::force})
      bounds.push_back(c.error[q].value_or(0.0));
  }

  void step_ended(const step_state& s) override {
    u.assign(s.displacement.begin(), s.displacement.end());
    if (s.numbers != nullptr) forces = s.numbers->pair_forces;
  }

  std::vector<double> u, forces, bounds;
};

/// The distance of an answer from our state, and the bound on our state's from the truth, are taken together:
/// no answer gets more digits than are proved.
void judge(const certified_end& ours, const contact_problem& c, const linear_structure& s,
           const std::vector<double>& u, peer_answer& a) {
  std::array<double, 3> size{}, off{};  // of deflections, other displacements, forces
  const auto compare = [&](std::size_t kind, double right, double found) {
    size[kind] = std::max(size[kind], std::abs(right));
    off[kind] = std::max(off[kind], std::abs(right - found));
    ++a.values;
  };
  for (std::size_t row = 0; row < u.size(); ++row)
    compare(s.deflects(c.dofs[row]) ? 0 : 1, ours.u[c.dofs[row]], u[row]);
  for (std::size_t i = 0; i < c.springs.size(); ++i) {
    const one_sided_spring& at = c.springs[i];
    const double force = std::max(0.0, at.stiffness * at.side * (u[at.row] - at.face));
    compare(2, ours.forces[i], force);
    a.wrong_statuses += (force > 0.0) != (ours.forces[i] > 0.0) ? 1 : 0;
  }
  double worst = 1e-15;
  for (std::size_t kind = 0; kind < size.size(); ++kind)
    if (size[kind] > 0.0) worst = std::max(worst, (off[kind] + ours.bounds[kind]) / size[kind]);
  a.digits = worst < 1.0 ? -std::log10(worst) : 0.0;
}

}  // namespace

std::vector<peer_answer> time_cholmod(const problem& p, const linear_structure& s, int rounds) {
  const contact_problem c = contact_problem_of(p, s);
  const certified_end ours(p, s);
  std::vector<peer_answer> answers;
  for (const bool updown : {true, false}) {
    peer_answer a;
    a.method = updown ? "up/downdating" : "a factor for each step";
    std::vector<double> seconds, u;
    for (int round = 0; round < rounds; ++round) {
      const auto start = cpu_clock::now();
      newton solver(c, updown);
      a.steps = solver.run();
      seconds.push_back(std::chrono::duration<double>(cpu_clock::now() - start).count());
      u = solver.u;
    }
    std::sort(seconds.begin(), seconds.end());
    a.seconds = seconds[seconds.size() / 2];
    judge(ours, c, s, u, a);
    answers.push_back(a);
  }
  return answers;
}

}  // namespace bench

#else

namespace bench {

std::vector<peer_answer> time_cholmod(const contct::problem& /*p*/, const contct::linear_structure& /*s*/,
                                      int /*rounds*/) {
  return {};
}

}  // namespace bench

#endif
