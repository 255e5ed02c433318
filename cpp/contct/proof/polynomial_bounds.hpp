// Bounds on the values of polynomials from t = 0 to 1, and where they exceed a number.
#pragma once

#include "contct/structure/extremes.hpp"

namespace contct {

/// A stretch of a part of an element, as shares of the part's length; empty if both are equal.
struct stretch {
  double from = 0.0, to = 0.0;

  [[nodiscard]] double length() const { return to - from; }
};

/// most_of is at most this share of sum_of_sizes above the largest value.
inline constexpr double close_to_most = 2e-10;

[[nodiscard]] line_polynomial<double> negative(line_polynomial<double> p);

/// The larger of `most` and a bound on the largest value of p.
[[nodiscard]] double most_of(double most, const line_polynomial<double>& p);

/// The integral from 0 to 1.
[[nodiscard]] double mean_of(const line_polynomial<double>& p);

/// Does p exceed `least` along a stretch, and certainly?
[[nodiscard]] bool exceeds(const line_polynomial<double>& p, double least, const stretch& s);

/// A stretch along which p certainly exceeds `least`; empty if none is found. Begins with almost the whole,
/// and takes away more and more of the ends where p is too small.
[[nodiscard]] stretch stretch_beyond(const line_polynomial<double>& p, double least);

/// A bound from below on the share of a stretch along which p exceeds `least` >= 0. Each end of this part is
/// off by at most 2^-20.
[[nodiscard]] double share_beyond(const line_polynomial<double>& p, double least,
                                  const stretch& s = {0.0, 1.0});

}  // namespace contct
