// The steps of a problem file: its [[step]]s, or its [[combination]]s and [[train]]s of [[case]]s.
#pragma once

#include <string>
#include <vector>

#include "contct/read/named_files.hpp"
#include "contct/read/node_reader.hpp"

namespace contct {

/// The steps of the document `top`, on these supports: each [[step]] goes on from the one before it, each
/// combination and each place of a train starts from the unloaded structure. `files` finds those that a load
/// names; `warnings` gets those about their numbers.
[[nodiscard]] std::vector<load> read_steps(const toml_value& top, const node_reader& nodes,
                                           const std::vector<support>& supports,
                                           const std::vector<contact_pair>& pairs, const named_files& files,
                                           std::vector<std::string>& warnings);

}  // namespace contct
