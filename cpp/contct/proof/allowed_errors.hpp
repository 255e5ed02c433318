// The errors that a certified state may have. For each kind of number (deflection, contact force, ..), the
// allowed error is a share of the size of this kind, which is computed from the largest numbers of the state
// (reference/certificate-proof.md, "Sizes").
#pragma once

#include <optional>
#include <string>

#include "contct/proof/error_bounds.hpp"

namespace contct {

/// The allowed error of a number in a certified state, relative to the size of its kind.
inline constexpr double certified_share = 1e-6;

class allowed_errors {
 public:
  /// Returns the allowed error of each kind of number in the state with error bounds `b`; empty for a kind
  /// without a bound. `extent`: the largest side of the structure. Must be called for the steps of a path in
  /// order, because the sizes of an unloaded state are the largest on the path so far.
  [[nodiscard]] by_quantity of(const error_bounds& b, double extent);

 private:
  by_quantity largest_;  // the largest proved size of each kind so far
};

/// Returns the error relative to the size of its kind: certified_share if `error` equals `allowed`, 0 without
/// an error, infinite if no error is allowed or `error` is NaN.
[[nodiscard]] double share_of(const std::optional<double>& error, const std::optional<double>& allowed);

/// The largest `share_of(error, allowed)` over all kinds.
[[nodiscard]] double worst_share(const by_quantity& error, const by_quantity& allowed);

/// The unit of a kind with a blank before the unit; empty for slopes, and if the problem names no units.
[[nodiscard]] std::string unit_of(const problem& p, quantity q);

/// Describes the error that exceeds its allowed value by the largest factor, with units if `of` is given;
/// empty if no error exceeds its allowed value.
[[nodiscard]] std::string worst_bound(const by_quantity& error, const by_quantity& allowed,
                                      const problem* of = nullptr);

}  // namespace contct
