#include "contct/certify/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "contct/kernel/call.hpp"

namespace contct::certify {
namespace {

double share(double part, double whole) {
  return part > 0.0 ? part / whole : 0.0;
}

/// The worst of what is above the tolerance, in words.
std::string worst_of(const certificate& c) {
  const std::pair<double, const char*> parts[] = {
      {c.displacement_error, "the deflections are off"},
      {c.shape_error, "the displacements are off"},
      {c.penetration, "an open pair is beyond its face"},
      {c.tension, "a closed pair pulls: it is off its face"},
      {c.equilibrium, "loads and forces do not balance: they differ"},
  };
  for (const auto& [amount, words] : parts) {
    if (amount <= c.tolerance) continue;
    char text[120];
    (void)std::snprintf(text, sizeof text, "%s by %.2g", words, amount);
    return text;
  }
  return "";
}

}  // namespace

certifier::certifier(const linear_structure& s, load_history total_load)
    : structure_(s), total_load_(std::move(total_load)), reference_(s) {
  for (int dof = 0; dof < s.dofs(); ++dof) {
    scale_.push_back(std::sqrt(s.stiffness.diagonal(s.row_of(dof))));
    const std::size_t at = dof;
    if (deflects(at) && s.fixed[at] == 0) largest_scale_ = std::max(largest_scale_, scale_[at]);
  }
}

void certifier::step_ended(const step_state& s) {
  steps_.push_back(s.fraction == 1.0 ? std::optional(judge(s)) : std::nullopt);
}

bool certifier::all_exact() const {
  return std::all_of(steps_.begin(), steps_.end(), [](const auto& c) { return c && c->exact; });
}

certificate certifier::judge(const step_state& s) {
  certificate c;
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(s.displacement.begin(), s.displacement.end(), finite)) {
    c.problem = "a displacement is not a finite number";  // it would slip through every comparison below
    return c;
  }
  std::vector<double> load(s.displacement.size(), 0.0);
  total_load_(s.step, load);
  const reference_answer answer = reference_.solve(load);
  remember_sizes(s.displacement);
  remember_sizes(answer.displacement);
  c.rcond = s.rcond;
  c.independent = !s.from_reference;
  c.tolerance = std::min(certificate_factor * std::numeric_limits<double>::epsilon() / s.rcond,
                         certificate_never_above);
  c.unique = answer.unique;
  measure_state(s, load, c);
  c.unfounded = answer.how == reference_answer::outcome::no_equilibrium;
  if (c.unfounded) {
    c.problem = "there is no equilibrium: nothing stops a rigid motion that the load drives";
  } else if (answer.how == reference_answer::outcome::not_found) {
    c.problem = "the oracle came to no answer: the stiffness is too ill-conditioned";
  } else {
    if (c.unique) compare_with(answer, s, c);
    c.problem = worst_of(c);
    c.exact = c.problem.empty();
  }
  return c;
}

void certifier::remember_sizes(std::span<const double> displacement) {
  for (std::size_t dof = 0; dof < displacement.size(); ++dof) {
    const double size = std::abs(displacement[dof]);
    largest_displacement_ = std::max(largest_displacement_, scale_[dof] * size);
    if (deflects(dof)) largest_deflection_ = std::max(largest_deflection_, size);
  }
}

double certifier::largest_length() const {
  if (largest_scale_ == 0.0) return largest_deflection_;
  return std::max(largest_deflection_, largest_displacement_ / largest_scale_);
}

/// From the state alone: equilibrium, penetration, tension.
void certifier::measure_state(const step_state& s, std::span<const double> load, certificate& c) const {
  const auto row = [this](std::size_t dof) { return structure_.row_of(static_cast<int>(dof)); };
  std::vector<double> u(load.size());
  std::vector<long double> left(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    u[row(dof)] = s.displacement[dof];
    left[row(dof)] = load[dof];
  }
  structure_.stiffness.subtract_product(std::span<const double>(u), left);
  std::vector<double> stiffness(load.size());  // on the diagonal, springs included
  for (std::size_t dof = 0; dof < load.size(); ++dof) stiffness[dof] = scale_[dof] * scale_[dof];
  double deepest = 0.0;
  double farthest = 0.0;
  for (std::size_t i = 0; i < structure_.pairs.size(); ++i) {
    const contact_pair& p = structure_.pairs[i];
    const std::size_t dof = structure_.dof_of_pair(static_cast<int>(i));
    const double pressing = p.surface * (s.displacement[dof] - p.face);
    if (s.isep[i] == separated) {
      deepest = std::max(deepest, pressing);
    } else {
      farthest = std::max(farthest, -pressing);
      left[row(dof)] -=
          static_cast<long double>(p.stiffness) * (static_cast<long double>(s.displacement[dof]) - p.face);
      stiffness[dof] += p.stiffness;
    }
  }
  double unbalanced = 0.0;
  for (std::size_t dof = 0; dof < load.size(); ++dof) {
    const double there = std::abs(static_cast<double>(left[row(dof)])) / std::sqrt(stiffness[dof]);
    if (structure_.fixed[dof] == 0) unbalanced = std::max(unbalanced, there);
  }
  c.penetration = share(deepest, largest_length());
  c.tension = share(farthest, largest_length());
  c.equilibrium = share(unbalanced, largest_displacement_);
}

void certifier::compare_with(const reference_answer& a, const step_state& s, certificate& c) const {
  double deflection = 0.0;
  double any = 0.0;
  for (std::size_t dof = 0; dof < s.displacement.size(); ++dof) {
    const double off = std::abs(s.displacement[dof] - a.displacement[dof]);
    any = std::max(any, scale_[dof] * off);
    if (deflects(dof)) deflection = std::max(deflection, off);
  }
  c.displacement_error = share(deflection, largest_length());
  c.shape_error = share(any, largest_displacement_);
}

}  // namespace contct::certify
