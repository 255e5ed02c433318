#include "contct/proof/bed_bound.hpp"

#include <algorithm>
#include <cmath>

#include "contct/proof/polynomial_bounds.hpp"

namespace contct {

using poly = line_polynomial<double>;

double wrong_in(const line_part& part, const bed_along& b, const poly& d) {
  return most_of(-part.slack, b.pressed.length() > 0.0 ? negative(d) : d) + part.slack;
}

bed_bound::bed_bound(bed_line& line)
    : line_(line), system_(*line.with_pressed), left_(system_.residual(line.u, line.loads())) {}

double bed_bound::reach_in(const line_element& on) const {
  const auto largest = [&](std::size_t i) { return std::max(reach(on.dofs[i]), reach(on.dofs[i + 2])); };
  return largest(0) + on.h.hi / 4 * largest(1) + std::sqrt(std::pow(on.h.hi, 3) / 192 / on.EI.hi);
}

double bed_bound::of_moment(const line_element& on, bool inside) const {
  const double h = on.h.hi;
  return std::sqrt((inside ? 8 : 4) * on.EI.hi / h + on.modulus() * h * h * h / 105) * forces_;
}

double bed_bound::of_shear(const line_element& on, bool inside) const {
  const double h = on.h.hi;
  return std::sqrt((inside ? 96 : 12) * on.EI.hi / (h * h * h) + on.modulus() * h * 13 / 35) * forces_;
}

/// Bounds |r| in all parts, and begins A with all stretches and pairs that press.
void bed_bound::measure() {
  double deepest = 0.0;
  for (line_element& on : line_.elements)
    for (line_part& part : on.parts)
      for (const bed_along& b : part.beds) deepest = most_of(deepest, part.depth(b));
  for (line_element& on : line_.elements)
    for (line_part& part : on.parts) {
      const double late = sum_of_sizes(part.late()) + part.slack_of_b;
      for (bed_along& b : part.beds) {
        const poly d = part.depth(b);
        const bool presses = b.pressed.length() > 0.0;
        part.off += b.modulus.hi * ((presses ? late : 0.0) + wrong_in(part, b, d));
        b.certain = stretch_beyond(d, 0x1p-20 * deepest + part.slack);
      }
    }
  for (std::size_t i = 0; i < system_.pairs.size(); ++i)
    if (system_.depth(i, line_.u).hi > 0.0) line_.closed.push_back(static_cast<int>(i));
}

/// Factors K_A, and proves mu and eta.
bool bed_bound::hold() {
  const long_system system = line_.system_with(&bed_along::certain);
  scaled_stiffness held = line_.scaled(system);
  const double mu = held.factor(line_.closed) ? held.least_eigenvalue() : 0.0;
  line_.held = held.proof();
  double eta = 0.0;
  for (const line_element& on : line_.elements)
    eta = std::max(eta, on.modulus() * std::pow(on.h.hi, 4) / 500.56 / on.EI.hi);
  root_ = std::sqrt((1 + eta) / mu) * (1 + summation_slack);
  scale_.clear();
  for (std::size_t dof = 0; dof < system.dofs(); ++dof) scale_.push_back(held.scale(dof));
  return mu > 0.0;
}

/// rho and Xh by A.
void bed_bound::sum_up() {
  double nodal = 0.0;   // squares
  double inside = 0.0;  // A, squares
  double all = 0.0;     // all beds, squares
  double outside = 0.0;
  for (std::size_t dof = 0; dof < system_.dofs(); ++dof) {
    const double off = reach(dof) * (std::abs(left_.force[dof].hi) + left_.slack[dof]);
    nodal += off * off;
  }
  for (const line_element& on : line_.elements)
    for (const line_part& part : on.parts) {
      if (part.beds.empty()) continue;
      const double h = part.load.h.hi;
      const auto of_A =
          std::ranges::max_element(part.beds, {}, [](const bed_along& b) { return b.certain.length(); });
      const double share = of_A->certain.length();
      inside += share * h * part.off * part.off / of_A->modulus.hi;
      all += h * part.off * part.off / part.modulus();
      outside += reach_in(on) * ((1 - share) * part.off + part.modulus() * part.slack_of_b) * h;
    }
  rho_ = (std::sqrt(nodal) + std::sqrt(inside) + outside) * (1 + summation_slack);
  forces_ = (rho_ + std::sqrt(all)) * (1 + summation_slack);
}

/// Takes out of A what may not press; false if nothing was taken out.
bool bed_bound::shrink() {
  bool any = false;
  for (line_element& on : line_.elements) {
    const double least = reach_in(on) * rho_ * (1 + summation_slack);
    for (line_part& part : on.parts)
      for (bed_along& b : part.beds) {
        if (b.certain.length() == 0.0) continue;
        const poly d = part.depth(b);
        if (exceeds(d, least + part.slack, b.certain)) continue;
        b.certain = stretch_beyond(d, 2 * least + part.slack);
        any = true;
      }
  }
  return std::erase_if(line_.closed,
                       [&](int i) {
                         return !(system_.depth(i, line_.u).hi - system_.doubt(i, line_.u) >
                                  reach(system_.pairs[i].dof) * rho_);
                       }) > 0 ||
         any;
}

std::string bed_bound::find() {
  constexpr int most = 12;
  measure();
  for (int i = 0; i < most; ++i) {
    if (!hold()) return "it is not certain that contact holds the beam; use a finer mesh (element_size)";
    sum_up();
    if (!std::isfinite(forces_)) break;
    if (!shrink()) return "";
  }
  return "it is not certain where the beds press; use a finer mesh (element_size)";
}

}  // namespace contct
