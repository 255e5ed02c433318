// The files of a run that is over, and those of them that are for other programs: a page in HTML, tables for
// spreadsheets and data frames, and grids for ParaView.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "contct/session/run.hpp"
#include "contct/text/output_file.hpp"

namespace contct {

/// One HTML page that needs nothing else: it draws itself from the result in it. The parallel edition of the
/// two kernels is in it, folded.
[[nodiscard]] std::string run_page(const run_result& r);

/// A state as an unstructured grid, for everything that reads VTK's XML files: lines or quadrilaterals, and a
/// vertex for each pair, at the undeformed places; beams lie along x, plates in x and y, z is up. Points have
/// "displacement" (0, 0, w), each dof by its name, the "reaction" at each dof and, where there is a bed, its
/// "pressure"; cells have "pair" (0 for an element), "state" (0 open,
/// 1 closed, 2 at its face; -1 for an element), "surface", "direction" (1 to 3 along the axes, 4 to 6 about
/// them; 0), "face", "gap", "force", and what the element's ends or corners read, by name. The field data say
/// step, increment and share.
///
/// A structure given by its matrix is drawn where its nodes have places: its edges as lines, "displacement"
/// and "reaction" as they are, "rotation" where it has any; pairs at dofs without a place have no cell.
[[nodiscard]] std::string vtu_of_state(const problem& p, const structure_state& s);

/// A collection of `count` files, by their place in which they were kept; "time" counts them from 0.
/// `stem` is their common name without folder: see name_of_state.
[[nodiscard]] std::string pvd_of_states(const std::string& stem, std::size_t count);

/// "out.007.vtu" for 7, of a stem "out".
[[nodiscard]] std::string name_of_state(const std::string& stem, std::size_t number);

/// A field of a table in a file: quoted where it has to be.
[[nodiscard]] std::string csv_field(std::string_view raw);

/// Writes a run whose recorder keeps states, by RFC 4180, numbers with all their digits; the files appear.
///
/// The first table has a row an increment: step, increment, kind ("load"; "snap": a rigid-body motion at
/// constant load; "end": the step ended without an increment, "rescue": in the state of a fallback), s, share
/// (of the step's load), force (sum of the loads), events ("make 1, break 3"), closed, open and at_face (how
/// many pairs), smin (of the call, as the kernel gave it), kernels ("equal" or "differ"; empty: not
/// compared), node (the watched one, from 0, or -1 for the one that deflects most at the ends of steps: a
/// number or a label) and w, its deflection.
///
/// The second, where `pairs` is not null, has a row for each pair in each of these: step, increment, pair,
/// node, surface, state ("contact", "separated"; a dof's label stands for the node where each dof is one),
/// look ("closed", "open", "at its face"), w, gap, force.
void write_csv(const run_result& r, int watched, output_file& increments, output_file* pairs);

/// Writes the states at the ends of steps, likewise. Beams: a row for each end of each element and for each
/// place inside where w, the moment or the shear is extreme: step, name, element, node (empty inside), x, w,
/// slope, moment, shear and, at nodes, pressure (of the bed; empty without one). Plates: a row for each node:
/// step, name, node, x, y, w, wx, wy, pressure. A matrix: step, name, dof, value.
void write_states_csv(const run_result& r, output_file& out);

/// Writes the least and the largest w, moment and shear along a beam over the states of the envelope, with
/// their steps: x, w_min, w_min_step, w_max, w_max_step, .. Nothing but headings for others.
void write_envelope_csv(const run_result& r, output_file& out);

/// Complete and name them.
void write_outputs(const run& r);

}  // namespace contct
