#include "contct/proof/polynomial_bounds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "contct/proof/error_bounds.hpp"

namespace contct {
namespace {

using poly = line_polynomial<double>;

double bound_on_most(const poly& p) {
  return bound_on_largest(p, close_to_most / 2 * sum_of_sizes(p));  // and rounding
}

/// A bound that is found quickly, and may be far above p.
double rough_bound_on_most(const poly& p) {
  const double sizes = sum_of_sizes(p);
  return p.front() - std::abs(p.front()) + sizes + 0x1p-48 * sizes;
}

}  // namespace

poly negative(poly p) {
  for (double& c : p) c = -c;
  return p;
}

double most_of(double most, const poly& p) {
  return rough_bound_on_most(p) <= most ? most : std::max(most, bound_on_most(p));
}

double mean_of(const poly& p) {
  double sum = 0.0;
  for (std::size_t i = p.size(); i > 0; --i) sum += p[i - 1] / static_cast<double>(i);
  return sum;
}

bool exceeds(const poly& p, double least, const stretch& s) {
  if (-rough_bound_on_most(negative(p)) > least) return true;
  const auto part =
      formulas::in_element<double>(std::span<const double>(p.data(), p.size()), s.from, s.length());
  return -bound_on_most(negative(poly(part.begin(), part.end()))) - 0x1p-45 * sum_of_sizes(p) > least;
}

stretch stretch_beyond(const poly& p, double least) {
  const std::array<bool, 2> cut = {p.front() <= least, polynomial_at(p, 1.0) <= least};
  for (int halvings = 8; halvings > 1; --halvings) {
    const double share = std::ldexp(1.0, -halvings);
    const stretch s{cut[0] ? share : 0.0, cut[1] ? 1.0 - share : 1.0};
    if (exceeds(p, least, s)) return s;
  }
  return {};
}

double share_beyond(const poly& p, double least, const stretch& s) {
  if (exceeds(p, least, s)) return s.length();
  const bool stays_below = sum_of_sizes(p) <= least || exceeds(negative(p), -least, s);
  if (s.length() < 0x1p-19 || stays_below) return 0.0;
  const double middle = s.from + s.length() / 2;
  return share_beyond(p, least, {s.from, middle}) + share_beyond(p, least, {middle, s.to});
}

}  // namespace contct
