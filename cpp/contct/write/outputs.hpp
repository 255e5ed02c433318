// What a run that is over is shown and written as: the table of the terminal, a page in HTML, tables for
// spreadsheets and data frames, and grids for ParaView. Exact paths, too.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "contct/session/exact_run.hpp"
#include "contct/session/run.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// One HTML page that needs nothing else: it draws itself from the result in it. The parallel edition of the
/// two kernels is in it, folded.
[[nodiscard]] std::string run_page(const run_result& r);

/// A state as an unstructured grid, for everything that reads VTK's XML files: lines or quadrilaterals, and a
/// vertex for each pair, at the undeformed places; beams lie along x, plates in x and y, z is up. In cells of
/// pairs "state" is 0 open, 1 closed, 2 at its face; of an element it is -1, and "pair" is 0. A matrix is
/// drawn where its nodes have places: its edges as lines; pairs at dofs without a place have no cell.
[[nodiscard]] std::string vtu_of_state(const problem& p, const structure_state& s);

/// A collection of `count` files, by their place in which they were kept; "time" counts them from 0.
/// `stem` is their common name without folder: see name_of_state.
[[nodiscard]] std::string pvd_of_states(const std::string& stem, std::size_t count);

/// "out.007.vtu" for 7, of a stem "out".
[[nodiscard]] std::string name_of_state(const std::string& stem, std::size_t number);

/// A field of a table in a file: quoted where it has to be.
[[nodiscard]] std::string csv_field(std::string_view raw);

/// Writes a run whose recorder keeps states, by RFC 4180, numbers with all their digits; the files appear.
/// `watched` is a node from 0, or -1 for the one that deflects most at the ends of steps. A row of kind "end"
/// is of a step that ended without an increment, "rescue" of a fallback's state. `pairs` may be null.
void write_csv(const run_result& r, int watched, output_file& increments, output_file* pairs);

/// Writes the states at the ends of steps, likewise. Beams: both ends of each element, and the places inside
/// where w, the moment or the shear is extreme; with section moduli, the stress. Plates: each node; with a
/// thickness, the largest von Mises stress of the elements there.
void write_states_csv(const run_result& r, output_file& out);

/// Writes the least and the largest w, moment and shear along a beam over the states of the envelope, with
/// their steps: x, w_min, w_min_step, w_max, w_max_step, .. Nothing but headings for others.
void write_envelope_csv(const run_result& r, output_file& out);

/// Complete and name them.
void write_outputs(const run& r);

/// The run as the terminal shows it, an increment a row.
struct run_table {
  std::string text;                 ///< lines
  std::vector<std::string> legend;  ///< what its columns and words mean, to stand below it
};
/// `detail`: every event, and all numbers of each step's end.
[[nodiscard]] run_table table_of(const run_result& r, const terminal& t, bool detail);

/// An exact path: events with their shares and loads, the ends of the steps, and the kernels. Numbers are
/// fractions up to `digits` digits, decimals with so many beyond.
[[nodiscard]] std::string exact_text(const exact_run& r, int digits, const terminal& t);

/// The same as JSON, format "contct-exact-1": every number is a string "p/q" or "p". The file appears.
void write_exact_json(const exact_run& r, output_file& out);

}  // namespace contct
