// What a run's page has to draw a structure from elsewhere from, where its nodes have places.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "contct/write/finished_run.hpp"
#include "contct/write/load_text.hpp"
#include "contct/write/page_sampling.hpp"

namespace contct {

/// "kind" is "mesh": "names" and places of the nodes shown, "edges" between them, by their numbers there, two
/// by two; the "axes" that displacements have, the "unit" these are given in, and the largest of them,
/// "reach"; "still": nodes without a dof; the "views" there are, and which "view" shows most. Or "kind" is
/// "none".
[[nodiscard]] nlohmann::ordered_json mesh_json(const finished_run& r, const shown_parts& shown);

/// Add to the page's "pairs" and "supports" at which node they are and in which direction, 1 to 6 (null and 0
/// where that is not known), and to each frame "u", the displacements of all nodes shown along the axes, as
/// whole numbers of units, and "points", its largest loads: [node, direction, dof, value, label].
void add_mesh(const finished_run& r, const load_path& loads, const shown_parts& shown,
              nlohmann::ordered_json& page, nlohmann::ordered_json& frames);

}  // namespace contct
