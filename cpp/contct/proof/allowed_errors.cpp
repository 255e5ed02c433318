#include "contct/proof/allowed_errors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace contct {
namespace {

/// An error up to this share of the size of a related kind is always allowed. For example, a beam that is
/// bent only by couples has no shear: its computed shears are the rounding of 32 digits.
constexpr double of_related = 0x1p-60;

/// If no load acts, an error up to this share of error_bounds::settling is always allowed.
constexpr double of_settling = 0x1p-70;

constexpr quantity force_kinds[] = {quantity::force, quantity::reaction, quantity::shear};

/// The size of each kind of number in a state. Forces, reactions and shears have a common size. The size of
/// moments is at least this common size times `extent`; the size of gaps is at least that of deflections.
by_quantity sizes_of(const error_bounds& b, double extent) {
  by_quantity sizes = b.size;
  double force = 0.0;
  for (const quantity q : force_kinds) force = std::max(force, b.size[q].value_or(0.0));
  for (const quantity q : force_kinds) sizes[q] = force;
  sizes[quantity::moment] = std::max(b.size[quantity::moment].value_or(0.0), force * extent);
  sizes[quantity::gap] = std::max(b.size[quantity::gap].value_or(0.0), b.size[quantity::w].value_or(0.0));
  return sizes;
}

/// The sizes computed from the largest numbers less their error bounds: a number that is not certified may be
/// too large, and without loads every number that is not 0 is an error.
by_quantity proved_sizes_of(error_bounds b, double extent) {
  for (std::size_t q = 0; q < b.size.all.size(); ++q)
    if (b.size.all[q]) b.size.all[q] = std::max(0.0, *b.size.all[q] - b.error.all[q].value_or(0.0));
  return sizes_of(b, extent);
}

/// The error of each kind that is always allowed, because all numbers of the kind may be 0.
by_quantity floors_of(const error_bounds& b, const by_quantity& sizes, double extent) {
  by_quantity floors;
  const double force = of_settling * b.settling[quantity::force].value_or(0.0);
  const double moment = std::max(of_settling * b.settling[quantity::moment].value_or(0.0), force * extent);
  floors[quantity::w] = floors[quantity::gap] = of_related * sizes[quantity::slope].value_or(0.0) * extent;
  if (extent > 0.0) floors[quantity::slope] = of_related * sizes[quantity::w].value_or(0.0) / extent;
  for (const quantity q : force_kinds)
    floors[q] =
        extent > 0.0 ? std::max(of_related * sizes[quantity::moment].value_or(0.0), moment) / extent : force;
  floors[quantity::moment] = moment;
  return floors;
}

}  // namespace

by_quantity allowed_errors::of(const error_bounds& b, double extent) {
  const by_quantity sizes = sizes_of(b, extent);
  const by_quantity floors = floors_of(b, sizes, extent);
  const by_quantity proved = proved_sizes_of(b, extent);
  by_quantity allowed;
  for (std::size_t q = 0; q < sizes.all.size(); ++q) {
    if (proved.all[q]) largest_.take(static_cast<quantity>(q), *proved.all[q]);
    if (!b.error.all[q]) continue;
    allowed.all[q] =
        b.unloaded ? certified_share * largest_.all[q].value_or(0.0)
                   : std::max(certified_share * sizes.all[q].value_or(0.0), floors.all[q].value_or(0.0));
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

std::string unit_of(const problem& p, quantity q) {
  const bool of_plate = std::holds_alternative<plate>(p.geometry.kind);
  const unit in_order[] = {
      unit::length, unit::none,  unit::force, unit::force, of_plate ? unit::plate_moment : unit::moment,
      unit::force,  unit::length};
  return unit_words(p, in_order[static_cast<std::size_t>(q)]);
}

std::string worst_bound(const by_quantity& error, const by_quantity& allowed, const problem* of) {
  const double worst = worst_share(error, allowed);
  if (worst <= certified_share) return "";
  std::size_t q = 0;
  while (q + 1 < error.all.size() && share_of(error.all[q], allowed.all[q]) < worst) ++q;
  const auto kind = static_cast<quantity>(q);
  char size[40];
  (void)std::snprintf(size, sizeof size, "%.2g", error.all[q].value_or(0.0));
  std::string words = "a ";
  words.append(name_of(kind).words).append(" may be off by ").append(size);
  if (of != nullptr) words += unit_of(*of, kind);
  return words + (std::isfinite(worst)
                      ? ", " + percent_words(worst) + " of the largest of its kind"
                      : ", and the state has no load or number of its kind to compare it with");
}

}  // namespace contct
