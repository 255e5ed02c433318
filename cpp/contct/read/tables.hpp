// Reads the tables of a problem file: its structure, [beam], [plate], [matrix] or [calculix]; and its steps,
// which are [[step]]s, or [[combination]]s and [[train]]s of [[case]]s.
#pragma once

#include <span>
#include <vector>

#include "contct/read/node_reader.hpp"

namespace contct {

/// Reads the table of the document `top` that describes the structure. Refuses a document with no such table
/// or with several. `files` finds the files that the table names; `warnings` receives warnings about numbers
/// in these files.
[[nodiscard]] model read_model(const toml_value& top, const named_files& files,
                               std::vector<std::string>& warnings);

/// Adds entries of 0 to the stiffness of `a` where pairs between two dofs need entries; then orders the rows
/// and chooses the storage, by the table [matrix] or [calculix] in `top`.
void store_matrix(const toml_value& top, std::span<const contact_pair> pairs, assembled& a);

/// Reads the key "polynomial", for a load or for faces along a beam: coefficients in x, constant first.
/// Refuses the key for other structures; `elsewhere` tells in the message what is allowed.
[[nodiscard]] std::vector<double> read_polynomial(const toml_value& t, const model& m,
                                                  std::string_view elsewhere);

/// Refuses the loads of the table `t` if a sum of loads, or a settlement, is beyond the range of doubles.
void refuse_endless_sums(const toml_value& t, const model& m, const load& l);

/// Reads the loads of all [[step]]s or [[case]]s. See read_steps.
[[nodiscard]] std::vector<load> read_loads(const std::vector<toml_value>& tables, const node_reader& nodes,
                                           const named_files& files, problem& p);

/// Reads the steps of the document `top`. Each [[step]] continues from the step before it. Each combination,
/// and each place of a train, starts from the unloaded structure. `p` already has its supports and pairs.
/// `files` finds the files that a table names; `p` receives the cases, and warnings about numbers of files.
[[nodiscard]] std::vector<load> read_steps(const toml_value& top, const node_reader& nodes,
                                           const named_files& files, problem& p);

}  // namespace contct
