// The proof of a run's bounds, for whoever checks it without this program (--proof).
#pragma once

#include <string>

#include "contct/certify/certificate.hpp"

namespace contct::write {

/// Format "contct-proof-2", of reference/proof-format.md. `judged` has kept its proofs of `p`.
[[nodiscard]] std::string proof_json(const problem& p, const certify::certifier& judged);

}  // namespace contct::write
