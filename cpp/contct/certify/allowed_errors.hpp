// What errors may reach for a state to be certified: a share of the size of their kind.
#pragma once

#include <optional>
#include <string>

#include "contct/certify/error_bounds.hpp"

namespace contct {

/// Certified means: every proved bound on an error is at most this share of the size of its kind in this
/// state.
inline constexpr double certified_share = 1e-6;

/// Knows how large the numbers of a path have been (reference/certificate-proof.md, "Sizes").
class allowed_errors {
 public:
  /// What each kind of number of the state that `b` is about may be off by; none for kinds without a bound.
  /// `extent`: the largest side of the structure. The steps of a path come in their order.
  [[nodiscard]] by_quantity of(const error_bounds& b, double extent);

 private:
  by_quantity largest_;  // so far
};

/// A bound as a share of the size of its kind; 0 without one, infinite where nothing is allowed, or it is no
/// number.
[[nodiscard]] double share_of(const std::optional<double>& error, const std::optional<double>& allowed);

/// The largest share of any kind.
[[nodiscard]] double worst_share(const by_quantity& error, const by_quantity& allowed);

/// The bound that is furthest above what is allowed, in words; empty where none is.
[[nodiscard]] std::string worst_bound(const by_quantity& error, const by_quantity& allowed);

}  // namespace contct
