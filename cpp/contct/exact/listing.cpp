#include "contct/exact/listing.hpp"

#include <utility>

namespace contct::exact {
namespace {

// The constants as they are printed: 1.E-20, 1.E-10 and .390625E-02.
const rational& delta() {
  static const rational value(integer(1), boost::multiprecision::pow(integer(10), 20U));
  return value;
}
const rational& epsgap() {
  static const rational value(integer(1), boost::multiprecision::pow(integer(10), 10U));
  return value;
}
const rational& epsmul() {
  static const rational value(1, 256);
  return value;
}

/// DO 10: s of one pair, and the branch that gave it.
std::pair<rational, way_to_s> scale_factor(const listing_pair& p) {
  const rational gap = p.c - p.d;
  if (p.d_star == 0) return {1, way_to_s::no_response};
  if (abs(gap) < epsgap()) {
    const rational s_chk = (p.closed ? -p.surface : p.surface) / p.d_star;
    if (s_chk > 0) return {s_chk * delta(), way_to_s::stationary_event};
    return {1, way_to_s::stationary};
  }
  return {gap / p.d_star, way_to_s::moving};
}

}  // namespace

std::vector<int> listing_answer::winners() const {
  std::vector<int> all;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (s_min != 1 && s[i] == s_min) all.push_back(static_cast<int>(i));
  return all;
}

listing_answer answer_exactly(std::span<const listing_pair> pairs) {
  listing_answer a;
  for (const listing_pair& p : pairs) {
    auto [s, way] = scale_factor(p);
    if (s > 0 && s < a.s_min) a.s_min = s;
    a.s.push_back(std::move(s));
    a.way.push_back(way);
  }
  if (a.s_min == 1) return a;
  for (std::size_t i = 0; i < a.s.size(); ++i)  // DO 30
    if (abs(a.s[i] - a.s_min) / a.s_min < epsmul()) a.toggled.push_back(static_cast<int>(i));
  return a;
}

}  // namespace contct::exact
