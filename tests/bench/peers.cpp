#include "bench/bench.hpp"

#ifndef CONTCT_BENCH_CHOLMOD

std::vector<bench::json> bench::time_cholmod(const contct::problem& /*p*/,
                                             const contct::linear_structure& /*s*/, int /*rounds*/,
                                             const std::string& /*only*/) {
  return {};
}

#else

#include <cholmod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>

#include "contct/path/solve_problem.hpp"
#include "contct/proof/certificate.hpp"

namespace bench {
namespace {

using namespace contct;
using contct::sparse_columns;

/// Newton's method for K u + forces of the pressed springs = load, in the rows of K.
class newton {
 public:
  // NOLINTBEGIN(cppcoreguidelines-prefer-member-initializer): CHOLMOD is to be started first
  newton(const linear_structure& s, const sparse_columns& k, std::span<const double> load, bool updown)
      : u(load.size()), s_(s), k_(k), load_(load), updown_(updown), closed_(s.pairs.size()) {
    (void)cholmod_start(&common_);
    common_.supernodal = updown ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
    common_.final_ll = updown ? 0 : 1;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_AMD;
    common_.postorder = 1;
    matrix_ =
        cholmod_allocate_sparse(load.size(), load.size(), k.values.size(), 1, 1, -1, CHOLMOD_REAL, &common_);
    std::copy(k.starts.begin(), k.starts.end(), static_cast<int*>(matrix_->p));
    std::copy(k.rows.begin(), k.rows.end(), static_cast<int*>(matrix_->i));
    right_ = cholmod_zeros(load.size(), 1, CHOLMOD_REAL, &common_);
    factor_ = cholmod_analyze(matrix_, &common_);
    places_.resize(load.size());
    const auto* order = static_cast<const int*>(factor_->Perm);
    for (std::size_t i = 0; i < places_.size(); ++i) places_[order[i]] = static_cast<int>(i);
    factor();
  }
  // NOLINTEND(cppcoreguidelines-prefer-member-initializer)
  newton(const newton&) = delete;
  newton& operator=(const newton&) = delete;
  ~newton() {
    (void)cholmod_free_dense(&right_, &common_);
    (void)cholmod_free_factor(&factor_, &common_);
    (void)cholmod_free_sparse(&matrix_, &common_);
    (void)cholmod_finish(&common_);
  }

  /// Solves until no pair changes, and returns the number of steps. Throws std::runtime_error after 200
  /// steps.
  int run() {
    constexpr int most = 200;
    for (int steps = 1; steps <= most; ++steps) {
      solve();
      if (!take_pressed()) return steps;
    }
    throw std::runtime_error("Newton's method does not end");
  }

  /// Follows the path of a step from `u` to `load`, with one solve and one update of the factor for each
  /// event. Returns the number of events.
  int follow(std::span<const double> load) {
    load_ = load;
    for (int events = 0;; ++events) {
      std::vector<double> from = u;
      solve();
      const auto [pair, share] = first_event(from);
      if (pair == closed_.size()) return events;
      for (std::size_t row = 0; row < u.size(); ++row) u[row] = from[row] + share * (u[row] - from[row]);
      closed_[pair] = closed_[pair] != 0 ? 0 : 1;
      change({pair}, closed_[pair]);
    }
  }
  /// Puts the springs of the pairs that are in contact at the start into the factor.
  void close_at_start() {
    std::vector<std::size_t> closed;
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      if (!s_.pairs[i].closed) continue;
      closed_[i] = 1;
      closed.push_back(i);
    }
    change(closed, 1);
  }

  [[nodiscard]] double mib() const { return static_cast<double>(common_.memory_usage) / (1 << 20); }

  std::vector<double> u;  ///< [rows]

 private:
  [[nodiscard]] int row_of(std::size_t pair) const { return s_.row_of(s_.pairs[pair].dof); }
  void solve() {
    auto* b = static_cast<double*>(right_->x);
    std::copy(load_.begin(), load_.end(), b);
    for (std::size_t i = 0; i < closed_.size(); ++i)
      if (closed_[i] != 0) b[row_of(i)] += s_.pairs[i].stiffness * s_.pairs[i].face;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, right_, &common_);
    const auto* first = static_cast<const double*>(x->x);
    u.assign(first, first + load_.size());
    (void)cholmod_free_dense(&x, &common_);
  }

  /// The first pair that meets or leaves its face between the displacements `from` and `u`, and the share of
  /// the way; the number of pairs if there is none.
  [[nodiscard]] std::pair<std::size_t, double> first_event(std::span<const double> from) const {
    std::pair<std::size_t, double> first{closed_.size(), 1.0};
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      const pair_in<double>& p = s_.pairs[i];
      const double depth = p.surface * (from[row_of(i)] - p.face);
      const double change = p.surface * (u[row_of(i)] - from[row_of(i)]);
      if (closed_[i] != 0 ? !(change < 0.0) : !(change > 0.0)) continue;
      const double share = std::max(0.0, -depth / change);
      if (share < first.second) first = {i, share};
    }
    return first;
  }

  /// Updates the pressed pairs from `u`. Returns false if no pair changed.
  bool take_pressed() {
    std::array<std::vector<std::size_t>, 2> changed;  // pairs no longer pressed, and newly pressed
    for (std::size_t i = 0; i < closed_.size(); ++i) {
      const pair_in<double>& p = s_.pairs[i];
      const char pressed = p.surface * (u[row_of(i)] - p.face) > 0.0 ? 1 : 0;
      if (pressed != closed_[i]) changed[pressed].push_back(i);
      closed_[i] = pressed;
    }
    if (changed[0].empty() && changed[1].empty()) return false;
    if (updown_) {
      for (const int add : {1, 0}) change(changed[add], add);
    } else {
      factor();
    }
    return true;
  }

  /// Updates the factor by one column for each spring, with sqrt(k) at the spring's row.
  void change(const std::vector<std::size_t>& springs, int add) {
    if (springs.empty()) return;
    const std::size_t count = springs.size();
    cholmod_sparse* c = cholmod_allocate_sparse(load_.size(), count, count, 1, 1, 0, CHOLMOD_REAL, &common_);
    for (std::size_t j = 0; j < count; ++j) {
      static_cast<int*>(c->p)[j] = static_cast<int>(j);
      static_cast<int*>(c->i)[j] = places_[row_of(springs[j])];
      static_cast<double*>(c->x)[j] = std::sqrt(s_.pairs[springs[j]].stiffness);
    }
    static_cast<int*>(c->p)[count] = static_cast<int>(count);
    const int good = cholmod_updown(add, c, factor_, &common_);
    (void)cholmod_free_sparse(&c, &common_);
    if (good == 0 || common_.status != CHOLMOD_OK) throw std::runtime_error("cholmod_updown failed");
  }

  /// Factors K with the springs of the pairs in contact.
  void factor() {
    auto* x = static_cast<double*>(matrix_->x);
    std::copy(k_.values.begin(), k_.values.end(), x);
    for (std::size_t i = 0; i < closed_.size(); ++i)
      if (closed_[i] != 0) x[k_.starts[row_of(i)]] += s_.pairs[i].stiffness;
    if (cholmod_factorize(matrix_, factor_, &common_) == 0 || common_.status != CHOLMOD_OK)
      throw std::runtime_error("K with the springs that press has no factor");
  }

  const linear_structure& s_;
  const sparse_columns& k_;
  std::span<const double> load_;
  bool updown_;
  std::vector<char> closed_;  // [pairs]
  std::vector<int> places_;   // [rows] the row in the factor
  cholmod_common common_{};
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* right_ = nullptr;
};

/// Our own certified state at the end of the last step, and the proved bounds on its errors.
struct certified_end {
  certified_end(const problem& p, const linear_structure& s) {
    const solved_path found = certifier(p, s).find_final_states();
    if (found.steps.empty() || !found.all_certified())
      throw std::runtime_error("the end of " + p.title + " is not certified");
    const solved_step& last = found.steps.back();
    u = last.displacement;
    forces = last.numbers.pair_forces;
    for (const quantity q : {quantity::w, quantity::slope, quantity::force})
      bounds.push_back(last.judged->error[q].value_or(0.0));
  }

  std::vector<double> u, forces, bounds;
};

/// Compares `u` with our state. The digits are from the distance to our state plus the bound on our state's
/// error, so that no answer gets more digits than are proved; they are those of the worst number, at most 15.
json compared(const certified_end& ours, const linear_structure& s, const std::vector<double>& u) {
  std::array<double, 3> size{}, off{};  // index: deflections, other displacements, forces
  int values = 0, wrong_statuses = 0;
  const auto compare = [&](std::size_t kind, double right, double found) {
    size[kind] = std::max(size[kind], std::abs(right));
    off[kind] = std::max(off[kind], std::abs(right - found));
    ++values;
  };
  for (int dof = 0; dof < s.dofs(); ++dof) compare(s.deflects(dof) ? 0 : 1, ours.u[dof], u[s.row_of(dof)]);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const pair_in<double>& p = s.pairs[i];
    const double force = std::max(0.0, p.stiffness * p.surface * (u[s.row_of(s.pairs[i].dof)] - p.face));
    compare(2, ours.forces[i], force);
    wrong_statuses += (force > 0.0) != (ours.forces[i] > 0.0) ? 1 : 0;
  }
  double worst = 1e-15;
  for (std::size_t kind = 0; kind < size.size(); ++kind)
    if (size[kind] > 0.0) worst = std::max(worst, (off[kind] + ours.bounds[kind]) / size[kind]);
  const double digits = worst < 1.0 ? -std::log10(worst) : 0.0;
  return {{"digits", digits}, {"wrong_statuses", wrong_statuses}, {"values", values}};
}

}  // namespace

std::vector<json> time_cholmod(const problem& p, const linear_structure& s, int rounds,
                               const std::string& only) {
  const sparse_columns& k = s.stiffness;
  std::vector<std::vector<double> > loads(p.steps.size(), std::vector<double>(s.dofs()));
  for (std::size_t step = 0; step < loads.size(); ++step) {
    const std::vector<double> at_dofs = load_history(p, s).total(static_cast<int>(step) + 1);
    for (std::size_t dof = 0; dof < at_dofs.size(); ++dof)
      loads[step][s.row_of(dof)] = s.in_row(dof, at_dofs[dof]);
  }
  const certified_end ours(p, s);
  std::vector<json> answers;
  const auto time = [&](const char* method, bool updown, const auto& run) {
    if (!only.empty() && only != method) return;
    std::vector<double> seconds, u;
    int steps = 0;
    double mib = 0.0;
    while (std::ssize(seconds) < rounds && (seconds.empty() || seconds.back() < long_enough)) {
      const double start = now();
      newton solver(s, k, loads.front(), updown);
      steps = run(solver);
      seconds.push_back(now() - start);
      mib = solver.mib();
      u = solver.u;
    }
    std::ranges::sort(seconds);
    answers.push_back(
        {{"method", method}, {"ms", 1e3 * seconds[seconds.size() / 2]}, {"mib", mib}, {"steps", steps}});
    answers.back().update(compared(ours, s, u));
  };
  time("path, up/downdating", true, [&](newton& solver) {
    solver.close_at_start();
    int events = 0;
    for (const auto& load : loads) events += solver.follow(load);
    return events;
  });
  if (loads.size() > 1) return answers;  // Newton's method knows no history
  time("up/downdating", true, [](newton& solver) { return solver.run(); });
  time("a factor for each step", false, [](newton& solver) { return solver.run(); });
  return answers;
}

}  // namespace bench

#endif
