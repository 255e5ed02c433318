// The structure of a problem file, [beam], [plate], [matrix] or [calculix]; and its steps: its [[step]]s, or
// its
// [[combination]]s and [[train]]s of [[case]]s, which have the keys of a step.
#pragma once

#include <span>
#include <vector>

#include "contct/read/node_reader.hpp"

namespace contct {

/// Read the one table of the document `top` that describes a structure; refuses a document with none of them,
/// or with several. `files` finds the files that it names; `warnings` receives warnings about numbers in
/// them.
[[nodiscard]] model read_model(const toml_value& top, const named_files& files,
                               std::vector<std::string>& warnings);

/// Gives the stiffness of a matrix that `top` names a place, with 0, where pairs between two dofs need one,
/// and orders and stores it again.
void make_room_for_pairs(const toml_value& top, std::span<const contact_pair> pairs, assembled& a);

/// The coefficients under the key "polynomial", the constant first: a beam's load, or a face along it, in x
/// of the nodes. Other structures refuse it, with `elsewhere` as the allowed alternative.
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
