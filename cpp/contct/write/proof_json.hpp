// The proof of a run's bounds, for whoever checks it without this program (--proof).
#pragma once

#include <string>

#include "contct/certify/certificate.hpp"

namespace contct::write {

/// Format "contct-proof-1", of reference/proof-format.md. `judged` has kept its proofs; `p` is the problem of
/// `file`.
[[nodiscard]] std::string proof_json(const problem& p, const std::string& file,
                                     const certify::certifier& judged);

}  // namespace contct::write
