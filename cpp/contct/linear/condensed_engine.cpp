// The engine "condensed" for beams: condenses the stiffness onto the nodes with pairs, and factors the
// condensed stiffness from both ends.
#include <algorithm>
#include <boost/qvm/map_mat_mat.hpp>
#include <boost/qvm/mat.hpp>
#include <boost/qvm/mat_operations2.hpp>
#include <boost/qvm/vec.hpp>
#include <boost/qvm/vec_mat_operations2.hpp>
#include <boost/qvm/vec_operations2.hpp>
#include <cmath>

#include "contct/linear/factored_stiffness.hpp"
#include "contct/linear/spring_engine.hpp"

namespace contct {
namespace {

constexpr double below_rounding = 1e-18;
// If a spring k with k c_p above this is removed (see update_response), the response is checked at once,
// because the update multiplies the rounding of x_p by k c_p.
constexpr double stiff = 100.0;

namespace qvm = boost::qvm;

// The dofs of a node.
constexpr int w = 0;
constexpr int theta = 1;
using node_vector = qvm::vec<double, 2>;
using node_matrix = qvm::mat<double, 2, 2>;

[[noreturn, gnu::noinline]] void refuse_pivot() {
  throw no_factor(
      "the structure is held, but its condensed stiffness matrix is too ill-conditioned for double "
      "precision");
}

/// M^-1 v for a symmetric positive definite M. Throws no_factor if M is not positive definite.
[[gnu::always_inline]] inline node_vector solved(const node_matrix& m, const node_vector& v) {
  const double ratio = m.a[theta][w] / m.a[w][w];
  const double pivot = m.a[theta][theta] - ratio * m.a[w][theta];
  if (!(m.a[w][w] > 0.0) || !(pivot > 0.0)) refuse_pivot();
  const double turn = (v.a[theta] - ratio * v.a[w]) / pivot;
  return {(v.a[w] - m.a[w][theta] * turn) / m.a[w][w], turn};
}
[[gnu::always_inline]] inline node_matrix solved_by_columns(const node_matrix& m, const node_matrix& b) {
  const node_vector left = solved(m, {b.a[w][w], b.a[theta][w]});
  const node_vector right = solved(m, {b.a[w][theta], b.a[theta][theta]});
  return {{{left.a[w], right.a[w]}, {left.a[theta], right.a[theta]}}};
}
bool is_definite(const node_matrix& m) {
  return m.a[w][w] > 0.0 && m.a[theta][theta] - m.a[theta][w] / m.a[w][w] * m.a[w][theta] > 0.0;
}

/// Calls each of two functions until it returns false, in turn: for a chain of operations that wait for each
/// other and another, independent chain, this takes little longer than one chain. `first`, `second`: whether
/// to call them at all.
template <class First, class Second>
void alternate(bool first, First do_first, bool second, Second do_second) {
  while (first && second) {
    first = do_first();
    second = do_second();
  }
  while (first) first = do_first();
  while (second) second = do_second();
}

node_matrix block(const band_matrix& k, int row_node, int column_node) {
  const auto entry = [&k](int row, int column) { return k.at(std::max(row, column), std::min(row, column)); };
  const int r = 2 * row_node;
  const int c = 2 * column_node;
  return {{{entry(r, c), entry(r, c + 1)}, {entry(r + 1, c), entry(r + 1, c + 1)}}};
}

/// For structures whose nodes form a chain, with two dofs each. Nodes without pairs are eliminated once,
/// without approximation. The remaining K is block tridiagonal, with D_i on and E_i beside the diagonal. The
/// engine keeps two sweeps over K:
///
///     L_i = D_i - E_{i-1}^T L_{i-1}^-1 E_{i-1}   from the left,   R_i from the right in the same way
///
/// The block of K^-1 at node p is (L_p + R_p - D_p)^-1. The matrices -L_i^-1 E_i continue a column of the
/// block to the left of p, and -R_i^-1 E_{i-1}^T to the right, until the column is below rounding. An event
/// at p changes the L_i from p to the right and the R_i from p to the left; a sweep ends where it gives the
/// same bits as before. On a beam with many supports, columns and sweeps end within some tens of supports:
/// the cost of an event does not depend on the length of the beam.
class condensed_engine final : public spring_engine {
 public:
  explicit condensed_engine(const linear_system& s) : spring_engine(s, usual_factor(s.stiffness)) {
    if (!can_be_condensed(s))
      throw std::invalid_argument(
          "engine \"condensed\": found a structure of another kind; allowed: a beam with pairs");
    for (const pair_in<double>& p : s.pairs) kept_.push_back(p.dof / s.dofs_per_node);
    std::sort(kept_.begin(), kept_.end());
    kept_.erase(std::unique(kept_.begin(), kept_.end()), kept_.end());
    for (std::size_t i = 0; i < s.pairs.size(); ++i) {
      place_.push_back(std::lower_bound(kept_.begin(), kept_.end(), s.pairs[i].dof / s.dofs_per_node) -
                       kept_.begin());
      spring_.push_back(s.fixed[s.pairs[i].dof] != 0 ? 0.0 : s.pairs[i].stiffness);
    }
    pairs_at_.resize(kept_.size());
    for (std::size_t i = 0; i < place_.size(); ++i) pairs_at_[place_[i]].push_back(static_cast<int>(i));
    x_.resize(kept_.size());
    load_.resize(kept_.size());
    column_.resize(kept_.size());
  }

  void respond(const residual_load& residual, std::span<double> d_star) override {
    if (!is_condensed_) condense();
    // Before the first response, a part of the springs may not hold the structure, so no sweep begins until
    // all springs are applied.
    bool has_response = response_to_ == residual.version;
    (void)apply_switched([&](int pair) {
      add_springs(place_[pair]);
      has_response = has_response && update_response(pair);
      return true;
    });
    if (!has_response || (drift_.is_due() && !refine_response())) respond_anew(residual);
    for (std::size_t i = 0; i < d_star.size(); ++i) d_star[i] = residual.share * x_[place_[i]].a[w];
  }

 private:
  void factor_wanted() override {
    stiffness_.factor(wanted_);
    ++counts_.factors;
  }

  /// Eliminates the nodes between two nodes with pairs; -1 and the number of nodes stand for the ends of the
  /// beam. `left`: the place of `left_node` in kept_.
  void eliminate_between(const band_matrix& k, int left_node, int right_node, std::size_t left) {
    const bool has_left = left_node >= 0;
    const bool has_right = right_node < k.order() / 2;
    if (left_node + 1 == right_node) {
      if (has_left && has_right) e_[left] = block(k, left_node, right_node);
      return;
    }
    node_matrix pivot = block(k, left_node + 1, left_node + 1);
    node_matrix to_left = has_left ? block(k, left_node, left_node + 1) : node_matrix{};
    for (int node = left_node + 1; node < right_node; ++node) {
      if (has_left) d_[left] = d_[left] - to_left * solved_by_columns(pivot, transposed(to_left));
      if (node + 1 == k.order() / 2) return;
      const node_matrix next = block(k, node, node + 1);
      const node_matrix by_pivot = solved_by_columns(pivot, next);
      to_left = -(to_left * by_pivot);
      const node_matrix less = transposed(next) * by_pivot;
      if (node + 1 < right_node) {
        pivot = block(k, node + 1, node + 1) - less;
      } else {
        const std::size_t right = has_left ? left + 1 : 0;
        d_[right] = d_[right] - less;
        if (has_left) e_[left] = to_left;
      }
    }
  }

  /// Eliminates the nodes without pairs, and applies the wanted springs. Called at the first response,
  /// because a path without responses needs no factor. Throws no_factor.
  void condense() {
    const band_matrix k = structure_.stiffness.band();
    const std::size_t n = kept_.size();
    e_.assign(n, {});
    d_.clear();
    reach_.clear();
    without_springs_.clear();
    for (const int node : kept_) {
      d_.push_back(block(k, node, node));
      reach_.push_back(std::sqrt(d_.back().a[theta][theta] / d_.back().a[w][w]));
    }
    eliminate_between(k, -1, kept_.front(), 0);
    for (std::size_t i = 0; i + 1 < n; ++i) eliminate_between(k, kept_[i], kept_[i + 1], i);
    eliminate_between(k, kept_.back(), k.order() / 2, n - 1);
    for (const node_matrix& d : d_) without_springs_.push_back(d.a[w][w]);
    apply_all();
    for (std::size_t at = 0; at < n; ++at) add_springs(at);
    left_.assign(n, {});
    right_.assign(n, {});
    go_left_.assign(n, {});
    go_right_.assign(n, {});
    is_condensed_ = true;
  }

  /// Sets D_ww of a kept node to its value without springs plus the applied springs. If a stiff spring were
  /// subtracted instead, the digits that it had cancelled would stay lost.
  void add_springs(std::size_t at) {
    d_[at].a[w][w] = without_springs_[at];
    for (const int pair : pairs_at_[at])
      if (applied_[pair] != 0) d_[at].a[w][w] += spring_[pair];
  }

  /// Computes L_i, and the matrix that continues a column from i + 1 to i. True if L_i has changed.
  bool step_right(std::size_t i) {
    const node_matrix before = left_[i];
    left_[i] = i == 0 ? d_[0] : d_[i] + transposed(e_[i - 1]) * go_left_[i - 1];
    if (i + 1 < d_.size()) go_left_[i] = -solved_by_columns(left_[i], e_[i]);
    return before != left_[i];
  }

  /// Computes R_i, and the matrix that continues a column from i - 1 to i. True if R_i has changed.
  bool step_left(std::size_t i) {
    const node_matrix before = right_[i];
    right_[i] = i + 1 == d_.size() ? d_[i] : d_[i] + e_[i] * go_right_[i + 1];
    if (i > 0) go_right_[i] = -solved_by_columns(right_[i], transposed(e_[i - 1]));
    return before != right_[i];
  }

  /// Updates L to the right and R to the left of `at`, after D_at has changed, until L and R do not change
  /// any more.
  void sweep_from(std::size_t at) {
    step_right(at);
    step_left(at);
    std::size_t right = at + 1;
    std::size_t left = at;
    const std::size_t n = d_.size();
    const auto goes_right = [&] { return step_right(right) && ++right < n; };
    const auto goes_left = [&] { return step_left(left - 1) && --left > 0; };
    alternate(left > 0, goes_left, right < n, goes_right);
  }

  /// x -= factor c, where c is the column of K^-1 for w of kept node `at`, and `peak` its entries at this
  /// node. Goes from `at` to both sides until c is below rounding.
  void subtract_column(std::size_t at, const node_vector& peak, double factor) {
    const auto subtract = [this, factor](std::size_t i, const node_vector& c) {
      x_[i] = x_[i] - factor * c;
      return std::abs(c.a[w]) + reach_[i] * std::abs(c.a[theta]);
    };
    const double negligible = below_rounding * subtract(at, peak);
    const std::size_t n = d_.size();
    std::size_t left = at;
    std::size_t right = at;
    node_vector c_left = peak;
    node_vector c_right = peak;
    const auto goes_left = [&] {
      c_left = go_left_[left - 1] * c_left;
      return subtract(--left, c_left) >= negligible && left > 0;
    };
    const auto goes_right = [&] {
      c_right = go_right_[right + 1] * c_right;
      return subtract(++right, c_right) >= negligible && right + 1 < n;
    };
    alternate(left > 0, goes_left, right + 1 < n, goes_right);
  }

  /// Updates the response for a spring k at node p, added (sigma = 1) or removed (sigma = -1). With the new
  /// K', and c from K' c = e_p: x' = x - sigma k x_p c. False if rounding makes K' at p not positive
  /// definite.
  [[nodiscard]] bool update_response(int pair) {
    const std::size_t at = place_[pair];
    ++counts_.updates;
    const double sigma_k = applied_[pair] != 0 ? spring_[pair] : -spring_[pair];
    if (sigma_k == 0.0) return true;
    sweep_from(at);
    const node_matrix middle = left_[at] + right_[at] - d_[at];
    if (!is_definite(middle)) return false;
    const node_vector peak = solved(middle, {1.0, 0.0});
    if (-sigma_k * peak.a[w] > stiff) drift_.check_next();
    subtract_column(at, peak, sigma_k * x_[at].a[w]);
    return true;
  }

  void sweep_anew() {
    for (std::size_t i = 0; i < d_.size(); ++i) step_right(i);
    for (std::size_t i = d_.size(); i-- > 0;) step_left(i);
  }

  /// Solves the whole beam with a new factor. Sets the condensed load to the condensed K times the solution.
  void respond_anew(const residual_load& residual) {
    response_to_ = 0;
    sweep_anew();
    stiffness_.factor(applied_);
    std::vector<double> u(residual.increment.begin(), residual.increment.end());
    stiffness_.solve(u);
    ++counts_.factors;
    ++counts_.solves;
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const int dof = 2 * kept_[i];
      x_[i] = {u[dof], u[dof + 1]};
      load_[i] = {};
    }
    residual_of_response();
    for (std::size_t i = 0; i < kept_.size(); ++i) load_[i] = -column_[i];
    response_to_ = residual.version;
    drift_.start_interval();
  }

  /// Sets column_ to load - K x.
  void residual_of_response() {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      node_vector sum = d_[i] * x_[i];
      if (i > 0) sum = sum + transposed(e_[i - 1]) * x_[i - 1];
      if (i + 1 < kept_.size()) sum = sum + e_[i] * x_[i + 1];
      column_[i] = load_[i] - sum;
    }
  }

  /// Adds K^-1 (load - K x) to x. This correction is the drift; returns false if the drift is more than
  /// allowed.
  [[nodiscard]] bool refine_response() {
    ++counts_.checks;
    ++counts_.solves;
    residual_of_response();
    for (std::size_t i = 1; i < kept_.size(); ++i)  // forward substitution
      column_[i] = column_[i] + transposed(go_left_[i - 1]) * column_[i - 1];
    for (std::size_t i = kept_.size(); i-- > 0;) {
      node_vector correction = solved(left_[i], column_[i]);
      if (i + 1 < kept_.size()) correction = correction + go_left_[i] * column_[i + 1];
      column_[i] = correction;
      x_[i] = x_[i] + correction;
      drift_.include(x_[i].a[w], correction.a[w]);
    }
    return drift_.accepts();
  }

  bool is_condensed_ = false;
  std::vector<std::size_t> place_;               // [pairs] place of the pair's node in kept_
  std::vector<int> kept_;                        // nodes with pairs, from 0, ascending
  std::vector<std::vector<int>> pairs_at_;       // [kept nodes]
  std::vector<double> without_springs_;          // [kept nodes] D_ww without springs
  std::vector<double> spring_;                   // [pairs] k; 0 if the dof is fixed
  std::vector<node_matrix> d_, e_;               // D_i; E_i couples i (rows) with i + 1 (columns)
  std::vector<node_matrix> left_, right_;        // L_i, R_i
  std::vector<node_matrix> go_left_, go_right_;  // -L_i^-1 E_i; -R_i^-1 E_{i-1}^T
  std::vector<double> reach_;                    // sqrt(D_tt / D_ww): converts a rotation to a length
  std::vector<node_vector> x_, load_;            // [kept nodes] the response, the condensed load
  std::vector<node_vector> column_;              // the residual, then the correction
  std::uint64_t response_to_ = 0;
  drift_monitor drift_{32};
};

}  // namespace

bool can_be_condensed(const linear_system& s) {
  return s.dofs_per_node == 2 && s.stiffness.subdiagonals == 3 && s.rows.empty() && !s.pairs.empty();
}

std::unique_ptr<stiffness_engine> make_condensed_engine(const linear_system& s) {
  return std::make_unique<condensed_engine>(s);
}

}  // namespace contct
