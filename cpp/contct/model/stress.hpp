// Stresses at the extreme fibres: of beams with a section modulus, of plates with a thickness. Those of the
// lower fibre, or face, where sagging is tension; at the upper one they have the other sign.
#pragma once

#include <cstddef>
#include <optional>

#include "contct/model/problem.hpp"

namespace contct {

/// M / W at both ends of each element of a beam, as "stress"; "sx", "sy", "txy", principal "s1" >= "s2" and
/// "von_mises" at the corners of each element of a plate, sx = 6 m_x / t^2 and so on. Nothing where W, or the
/// thickness, is not known. `forces`: results_in_elements.
[[nodiscard]] element_results stresses_of(const model& m, const element_results& forces);

/// What each of those stresses may be off by, and any along a beam, where no moment is off by more than
/// `moment` and no stress is larger than `largest`. Nothing where there are no stresses.
[[nodiscard]] std::optional<double> stress_error(const model& m, double moment, double largest);

}  // namespace contct
