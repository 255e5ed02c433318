// The allowed errors of a certified state: a share of the size of their kind.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "contct/certify/error_bounds.hpp"

namespace contct {

/// The largest bound on an error in a certified state, as a share of the size of its kind.
inline constexpr double certified_share = 1e-6;

/// Computes allowed errors from the sizes of the numbers of a path (reference/certificate-proof.md, "Sizes").
class allowed_errors {
 public:
  /// The allowed error of each kind of number in the state of `b`; empty for kinds without a bound. `extent`:
  /// the largest side of the structure. Must be called for the steps of a path in their order.
  [[nodiscard]] by_quantity of(const error_bounds& b, double extent);

 private:
  by_quantity largest_;  // the largest proved size of each kind so far
};

/// `error` as a share of `allowed`: 0 without an error, infinite if nothing is allowed or the error is NaN.
[[nodiscard]] double share_of(const std::optional<double>& error, const std::optional<double>& allowed);

/// The largest `share_of` of any kind.
[[nodiscard]] double worst_share(const by_quantity& error, const by_quantity& allowed);

/// "deflection", "contact force", ..: the name of one number of a kind.
[[nodiscard]] std::string_view name_of_kind(quantity q);

/// The unit of a kind, after a blank; empty if the problem names no unit.
[[nodiscard]] std::string unit_of(const problem& p, quantity q);

/// The error most above its allowed value, in words, with units if `of` is given; empty if there is none.
[[nodiscard]] std::string worst_bound(const by_quantity& error, const by_quantity& allowed,
                                      const problem* of = nullptr);

}  // namespace contct
