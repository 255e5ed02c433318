// Writes the outputs of a run: the table of the terminal, an HTML page, CSV files, and grids for ParaView.
// Also writes an exact path as text and as JSON.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "contct/results/exact_run.hpp"
#include "contct/results/run.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// Returns the result as an HTML page that needs no other file. The page draws the structure, shows the
/// result in tables, and contains the parallel edition of the two kernels, folded.
[[nodiscard]] std::string run_page(const run_result& r, bool appendix = false);

/// A state as an unstructured grid in VTK's XML format: lines or quadrilaterals, and a vertex for each pair
/// (a line between two dofs), in the undeformed structure. Beams lie along x, plates in x and y, and z is up.
/// In cells of pairs "state" is 0 (separated), 1 (in contact) or 2 (at its face); in cells of elements
/// "state" is -1 and "pair" 0. Of a matrix, edges and pairs have cells if their positions are known.
[[nodiscard]] std::string vtu_of_state(const problem& p, const structure_state& s);

/// A VTK collection of `count` files of states; "timestep" counts from 0. `stem`: see name_of_state.
[[nodiscard]] std::string pvd_of_states(const std::string& stem, std::size_t count);

/// Returns "out.007.vtu" for the stem "out" and number 7.
[[nodiscard]] std::string name_of_state(const std::string& stem, std::size_t number);

/// A field of a CSV file, quoted if necessary.
[[nodiscard]] std::string csv_field(std::string_view raw);

/// Writes the increments of a run whose recorder keeps states, as CSV (RFC 4180) with all digits, and
/// finishes the files. `watched` is a node from 0, or -1 for the node with the largest deflection at the ends
/// of steps. A row of kind "end" is a step that ended without an increment, one of kind "exact" or
/// "reference" a state of the exact path or of the reference solution. `pairs` may be null.
void write_csv(const run_result& r, int watched, output_file& increments, output_file* pairs);

/// Writes the states at the ends of steps in the format of write_csv. Beams: the ends of each element, and
/// the places inside where w, moment or shear is extreme; stress, if section moduli are known. Plates: nodes,
/// with the moments and stresses that are largest in the elements at the node. Matrices: dofs.
void write_states_csv(const run_result& r, output_file& out);

/// Writes the numbers of supports, pairs of [[contact]], beds and of the whole structure at the ends of
/// steps: a row for each entry of these lists and a column for each quantity, with six digits.
void write_supports_csv(const run_result& r, output_file& out);

/// Writes the least and the largest w, moment, shear and pressure of beds along a beam over the states of the
/// envelope, with their steps: x, w_min, w_min_step, w_max, w_max_step, .. For plates and matrices writes
/// only "x".
void write_envelope_csv(const run_result& r, output_file& out);

/// Writes and finishes all requested outputs of a run.
void write_outputs(const run& r);

/// The table of a run for the terminal: a row for each increment, or for each combination if there are many.
struct run_table {
  std::string text;                 ///< the rows
  std::vector<std::string> legend;  ///< the meanings of columns and words, to be printed below the table
};
/// Makes the table of `r`. `detail`: the table includes every event, and all numbers at the end of each step.
[[nodiscard]] run_table table_of(const run_result& r, const terminal& t, bool detail);

/// An exact path as text: events with their shares and loads, the ends of the steps, and the kernels. A
/// fraction of more than `digits` digits is written as a decimal of `digits` digits.
[[nodiscard]] std::string exact_text(const exact_run& r, int digits, const terminal& t);

/// Writes an exact path as JSON, format "contct-exact-1". Every number is a string "p/q" or "p".
void write_exact_json(const exact_run& r, output_file& out);

}  // namespace contct
