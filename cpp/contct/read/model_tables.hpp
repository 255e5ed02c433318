// The structure itself in a problem file: [beam], [plate], [matrix] or [calculix].
#pragma once

#include <span>

#include "contct/model/problem.hpp"
#include "contct/read/named_files.hpp"
#include "contct/read/toml_reader.hpp"

namespace contct {

/// Read the one table of the document `top` that describes a structure; refuses a document with none
/// of them, or with several. `files` finds others that it names; `warnings` gets those about their numbers.
[[nodiscard]] model read_model(const toml_value& top, const named_files& files,
                               std::vector<std::string>& warnings);

/// Gives the stiffness of a matrix that `top` names a place, with 0, where pairs between two dofs need one,
/// and orders and stores it again.
void make_room_for_pairs(const toml_value& top, std::span<const contact_pair> pairs, assembled& a);

}  // namespace contct
