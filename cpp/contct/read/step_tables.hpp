// The steps of a problem file: its [[step]]s, or its [[combination]]s and [[train]]s of [[case]]s, which have
// the keys of a step.
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

/// The loads of these tables on `p`, which has its supports and pairs and gets warnings about numbers of the
/// files that a table names, which `files` finds.
[[nodiscard]] std::vector<load> read_loads(const std::vector<toml_value>& tables, const node_reader& nodes,
                                           const named_files& files, problem& p);

/// Likewise the steps of the document `top`: each [[step]] goes on from the one before it, each combination
/// and each place of a train starts from the unloaded structure.
[[nodiscard]] std::vector<load> read_steps(const toml_value& top, const node_reader& nodes,
                                           const named_files& files, problem& p);

}  // namespace contct
