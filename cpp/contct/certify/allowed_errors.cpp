#include "contct/certify/allowed_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace contct::certify {
namespace {

/// Numbers below this share of what stands beside them are as good as 0.
constexpr double beside_it_none = 1e-12;

constexpr quantity force_kinds[] = {quantity::force, quantity::reaction, quantity::shear};

/// The size of each kind of number in a state: forces, reactions and shears are of one kind, and moments are
/// measured by them too.
by_quantity sizes_of(const error_bounds& b, double span) {
  by_quantity sizes = b.size;
  double force = 0.0;
  for (const quantity q : force_kinds) force = std::max(force, b.size[q].value_or(0.0));
  for (const quantity q : force_kinds) sizes[q] = force;
  sizes[quantity::moment] = std::max(b.size[quantity::moment].value_or(0.0), force * span);
  return sizes;
}

/// What measures kinds of which all numbers may be 0: deflections by slopes and slopes by deflections, forces
/// by moments, and both by what it takes to move a settling dof alone.
by_quantity sizes_beside(const error_bounds& b, const by_quantity& sizes, double span) {
  by_quantity beside;
  const double force = b.beside[quantity::force].value_or(0.0);
  const double moment = std::max(b.beside[quantity::moment].value_or(0.0), force * span);
  beside[quantity::w] = sizes[quantity::slope].value_or(0.0) * span;
  if (span > 0.0) beside[quantity::slope] = sizes[quantity::w].value_or(0.0) / span;
  for (const quantity q : force_kinds)
    beside[q] = span > 0.0 ? std::max(sizes[quantity::moment].value_or(0.0), moment) / span : force;
  beside[quantity::moment] = moment;
  return beside;
}

}  // namespace

by_quantity allowed_errors::of(const error_bounds& b, double span) {
  const by_quantity sizes = sizes_of(b, span);
  const by_quantity beside = sizes_beside(b, sizes, span);
  by_quantity allowed;
  for (std::size_t q = 0; q < sizes.all.size(); ++q) {
    if (sizes.all[q]) largest_.take(static_cast<quantity>(q), *sizes.all[q]);
    if (!b.error.all[q]) continue;
    double size = sizes.all[q].value_or(0.0);
    const double of_beside = beside.all[q].value_or(0.0);
    const bool untold = b.size.all[q].value_or(0.0) <= std::max(*b.error.all[q], beside_it_none * of_beside);
    if (b.unloaded || untold) size = std::max(size, of_beside);
    const bool of_path = b.unloaded || (untold && static_cast<quantity>(q) == quantity::slope);
    if (of_path) size = std::max(size, largest_.all[q].value_or(0.0));
    allowed.all[q] = certified_share * size;
  }
  return allowed;
}

double share_of(const std::optional<double>& error, const std::optional<double>& allowed) {
  if (error.value_or(0.0) == 0.0) return 0.0;
  const double share = certified_share * *error / allowed.value_or(0.0);
  return std::isnan(share) ? std::numeric_limits<double>::infinity() : share;
}

double worst_share(const by_quantity& error, const by_quantity& allowed) {
  double worst = 0.0;
  for (std::size_t q = 0; q < error.all.size(); ++q) {
    worst = std::max(worst, share_of(error.all[q], allowed.all[q]));
  }
  return worst;
}

std::string worst_bound(const by_quantity& error, const by_quantity& allowed) {
  constexpr const char* words[] = {"a deflection", "a slope",  "a contact force",
                                   "a reaction",   "a moment", "a shear force"};
  const double worst = worst_share(error, allowed);
  if (worst <= certified_share) return "";
  std::size_t q = 0;
  while (q + 1 < error.all.size() && share_of(error.all[q], allowed.all[q]) < worst) ++q;
  char text[120];
  if (std::isfinite(worst))
    (void)std::snprintf(text, sizeof text, "%s may be off by %.2g, %.2g of the largest", words[q],
                        *error.all[q], worst);
  else
    (void)std::snprintf(text, sizeof text, "%s may be off by %.2g", words[q], error.all[q].value_or(0.0));
  return text;
}

}  // namespace contct::certify
