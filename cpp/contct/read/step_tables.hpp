// Tables with the keys of a [[step]], as [[case]]s are: loads and settlements.
#pragma once

#include <vector>

#include "contct/read/named_files.hpp"
#include "contct/read/node_reader.hpp"

namespace contct {

/// The coefficients under the key "polynomial", the constant first: a beam's load, or a face along it, in x
/// as the nodes have it. Of other structures it is refused; allowed is what is said in `elsewhere`.
[[nodiscard]] std::vector<double> read_polynomial(const toml_value& t, const model& m,
                                                  std::string_view elsewhere);

/// Refuse loads of the table `t` whose sums, or settlements, are beyond doubles.
void refuse_endless_sums(const toml_value& t, const model& m, const load& l);

/// The loads of these tables, on these supports. `files` finds those that a table names; `warnings` gets
/// those about their numbers.
[[nodiscard]] std::vector<load> read_loads(const std::vector<toml_value>& tables, const node_reader& nodes,
                                           const std::vector<support>& supports,
                                           const std::vector<contact_pair>& pairs, const named_files& files,
                                           std::vector<std::string>& warnings);

}  // namespace contct
