#include "contct/proof/certain_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contct/linear/factored_stiffness.hpp"

namespace contct {
namespace {

/// A bound on the error of products that underflow.
constexpr double underflow = 1e-300;

std::vector<int> rows_of(const linear_structure& s) {
  std::vector<int> rows(s.dofs());
  for (std::size_t dof = 0; dof < rows.size(); ++dof) rows[dof] = s.row_of(dof);
  return rows;
}

}  // namespace

certain_contacts::certain_contacts(const problem& p, const linear_structure& s, const long_system& system,
                                   bool keeps_proofs)
    : problem_(p),
      structure_(s),
      system_(system),
      stiffness_(system, rows_of(s), s.stiffness.subdiagonals, is_faster_by_cholmod(s), keeps_proofs) {}

/// rho: the norm of the residual in K_A^-1, from above. z is about K_A^-1 r, e = r - K_A z, and
/// rho^2 = r'z + z'e + e' K_A^-1 e. z = 0 is enough where r is little more than what it may be off by.
std::optional<double> certain_contacts::norm_of(const long_residual& r) {
  const std::size_t n = system_.dofs();
  z_.assign(n, 0.0);
  std::vector<double> e(n);
  long_vector left = r.force;
  std::vector<double> sizes(n);  // of the products in row i
  double square = 0.0;
  for (int pass = 0; pass < 3; ++pass) {
    double least = 0.0;
    square = square_of_norm(r, left, sizes, least);
    if (square <= 1.5 * least || pass == 2) break;
    for (std::size_t dof = 0; dof < n; ++dof) e[dof] = left[dof].hi;
    stiffness_.solve(e);
    for (std::size_t dof = 0; dof < n; ++dof) z_[dof] += e[dof];
    sizes.assign(n, 0.0);
    const long_vector product = stiffness_.times(z_, sizes);
    for (std::size_t dof = 0; dof < n; ++dof)
      left[dof] = system_.fixed[dof] != 0 ? double_double(0.0) : r.force[dof] - product[dof];
  }
  if (!std::isfinite(square)) return std::nullopt;
  return std::sqrt(square) * (1 + summation_slack);
}

/// rho^2 with z_, and with r - K_A z_ in `left`; `least`: what it is with any z, as r may be off.
double certain_contacts::square_of_norm(const long_residual& r, const long_vector& left,
                                        std::span<const double> sizes, double& least) const {
  double_double work;
  double slack = 0.0;
  double rest = 0.0;
  bool any = false;  // a residual, or a residual that underflows
  for (std::size_t dof = 0; dof < system_.dofs(); ++dof) {
    if (system_.fixed[dof] != 0) continue;
    any = any || r.force[dof].hi != 0.0 || r.slack[dof] > 0.0;
    work += z_[dof] * (r.force[dof] + left[dof]);
    double size = sizes[dof];
    const double root = 1.0 / stiffness_.scale(dof);
    size += root * root * std::abs(z_[dof].hi) * 2;  // the springs of A
    const double off = r.slack[dof] + 2 * long_rounding * size;
    slack += 2 * std::abs(z_[dof].hi) * off;
    const double scaled = stiffness_.scale(dof) * (std::abs(left[dof].hi) + off);
    rest += scaled * scaled;
    least += stiffness_.scale(dof) * r.slack[dof] * stiffness_.scale(dof) * r.slack[dof];
  }
  least /= mu_;
  return (std::max(work.hi, 0.0) + slack + rest / mu_ + (any ? underflow : 0.0)) * (1 + summation_slack);
}

std::vector<int> certain_contacts::pressed(std::span<const double_double> u) const {
  std::vector<int> pairs;
  for (std::size_t i = 0; i < system_.pairs.size(); ++i)
    if (system_.fixed[system_.pairs[i].dof] == 0 && system_.depth(i, u).hi > 0.0)
      pairs.push_back(static_cast<int>(i));
  return pairs;
}

rigid_rank certain_contacts::held_by(const std::vector<int>& closed) const {
  return structure_.held_by(
      [&](std::size_t i) { return std::ranges::binary_search(closed, static_cast<int>(i)); });
}

std::vector<int> certain_contacts::holding(std::span<const double_double> u, std::vector<int> closed) const {
  rigid_rank rank = held_by(closed);
  if (structure_.is_held(rank)) return closed;
  std::vector<int> nearest;
  for (int i = 0; i < static_cast<int>(system_.pairs.size()); ++i)
    if (system_.fixed[system_.pairs[i].dof] == 0 && !std::ranges::binary_search(closed, i))
      nearest.push_back(i);
  std::ranges::stable_sort(nearest, {}, [&](int i) { return -system_.depth(i, u).hi; });
  for (const int i : nearest) {
    const int before = rank.rank();
    structure_.hold(rank, i);
    if (rank.rank() > before) closed.push_back(i);
  }
  std::ranges::sort(closed);
  // A spring at a dof, numbered after the pairs, holds a motion of a beam or plate that no pair can hold.
  for (int dof = 0; structure_.truth && !structure_.is_held(rank) && dof < structure_.dofs(); ++dof) {
    const int before = rank.rank();
    rank.hold(dof);
    if (rank.rank() > before) closed.push_back(static_cast<int>(system_.pairs.size()) + dof);
  }
  return closed;
}

bool certain_contacts::proves(const std::vector<int>& closed) {
  if (factored_ != closed) {
    factored_ = closed;
    mu_ = stiffness_.factor(closed) ? stiffness_.least_eigenvalue() : 0.0;
    inverse_root_mu_ = (1 + summation_slack) / std::sqrt(mu_);
  }
  return mu_ > 0.0;
}

std::string nearly_free_words(const linear_structure& s) {
  const bool one = s.rigid_motions == 1;
  char text[200];
  (void)std::snprintf(
      text, sizeof text, "%d %s nearly free: %s stiffness is %.1g of the largest; set free_motions = %d%s",
      s.rigid_motions, one ? "motion is" : "motions are", one ? "its" : "their", s.rigid_stiffness,
      s.rigid_motions, s.rigid_stiffness > 0.0 ? ", or 0 if this stiffness holds the structure" : "");
  return text;
}

/// Sets A and rho in `b`. Returns "" if A and rho are proved, otherwise the reason in words. `balanced`:
/// springs of further pairs, without force, hold the structure (find_balanced).
std::string certain_contacts::search(std::span<const double_double> u, const long_residual& r, bool balanced,
                                     contact_set& b) {
  b.closed = pressed(u);
  for (int tries = 0; tries < 3; ++tries) {
    if (!proves(balanced ? holding(u, b.closed) : b.closed))
      return !structure_.truth
                 ? "the stiffness is too ill-conditioned, or it is not certain that the structure is held"
             : structure_.is_held(held_by(b.closed))
                 ? "the stiffness is too ill-conditioned; use fewer elements, or supports that hold it"
                 : "it is not certain that the structure is held: a pair that must hold it may not press";
    if (!balanced && !structure_.truth && !structure_.is_held(held_by(b.closed))) {
      const bool declared = std::get<assembled>(problem_.geometry.kind).free_motions.has_value();
      return declared ? "no support and no pair stops a motion that free_motions counts"
                      : nearly_free_words(structure_);
    }
    const std::optional<double> rho = norm_of(r);
    if (!rho) return "the numbers are too large or too small";
    if (erase_doubtful(u, *rho, b.closed)) continue;
    b.rho = *rho;
    return "";
  }
  return "it is not certain which pairs are in contact";
}

bool certain_contacts::find(std::span<const double_double> u, const long_residual& r, contact_set& b) {
  b.not_proved = search(u, r, false, b);
  return b.not_proved.empty();
}

double certain_contacts::reach_of_pair(std::size_t pair, std::span<const double_double> u, double rho) const {
  const int dof = system_.pairs[pair].dof;
  const double moved =
      system_.fixed[dof] != 0 || rho == 0.0 ? 0.0 : reach(system_.pairs[pair]) * rho * (1 + summation_slack);
  return moved + system_.doubt(pair, u);
}

bool certain_contacts::is_certainly_open(std::size_t pair, std::span<const double_double> u,
                                         double rho) const {
  return system_.depth(pair, u).hi < -reach_of_pair(pair, u, rho);
}

bool certain_contacts::erase_doubtful(std::span<const double_double> u, double rho,
                                      std::vector<int>& closed) const {
  return std::erase_if(closed, [&](int i) {
           const long_pair& p = system_.pairs[i];
           const double moved = std::min(reach(p), (1 + summation_slack) / std::sqrt(p.stiffness.hi)) * rho;
           return !(system_.depth(i, u).hi * (1 - summation_slack) - system_.doubt(i, u) > moved);
         }) > 0;
}

bool certain_contacts::find_balanced(int step, std::span<const double_double> u, const long_residual& r,
                                     contact_set& b) {
  contact_set balanced;
  balanced.unique = false;
  if (!structure_.truth || !search(u, r, true, balanced).empty() || !stands_free(step, u, balanced))
    return false;
  b = std::move(balanced);
  return true;
}

/// True if there are rigid-body motions that neither the supports nor A stop, the load does no work on them,
/// and all pairs that they move are certainly separated.
bool certain_contacts::stands_free(int step, std::span<const double_double> u, const contact_set& b) const {
  const rigid_rank held = held_by(b.closed);
  const rigid_work work = structure_.truth->work_of(problem_.steps[step - 1]);
  if (structure_.is_held(held) || structure_.driven_motion(held, {}, work)) return false;
  for (std::size_t i = 0; i < system_.pairs.size(); ++i) {
    rigid_rank with_it = held;
    structure_.hold(with_it, i);
    if (with_it.rank() > held.rank() && !is_certainly_open(i, u, b.rho)) return false;
  }
  return true;
}

}  // namespace contct
