// What the certificate says, in words for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/structure/problem.hpp"

namespace contct::write {

/// A few words for a step: "certified", "NOT certified", or "no certificate".
[[nodiscard]] std::string certificate_mark(const std::optional<certificate>& c);

/// One line for a whole run, in parts: that it is certified and how closely, or the first step that is
/// not. Empty when no step came to its end.
[[nodiscard]] std::vector<std::string> certificate_summary(const certifier& judged);

/// For every step that is not certified a line that says what is wrong, how far off, and which
/// increment toggled which pair away from its face before.
[[nodiscard]] std::vector<std::string> certificate_complaints(const problem& p, const certifier& judged,
                                                              const early_toggles& early);

}  // namespace contct::write
