// A run as pictures: a page in HTML, and grids for ParaView.
#pragma once

#include <cstddef>
#include <string>

#include "contct/write/run_result.hpp"

namespace contct::write {

/// One HTML page that needs nothing else: it draws itself from the result in it. The parallel edition of the
/// two kernels is in it, folded.
[[nodiscard]] std::string run_page(const run_result& r);

/// A frame as an unstructured grid, for everything that reads VTK's XML files: lines or quadrilaterals, and a
/// vertex for each pair, at the undeformed places; beams lie along x, plates in x and y, z is up. Points have
/// "displacement" (0, 0, w), each dof by its name, the "reaction" at each dof and, where there is a bed, its
/// "pressure"; cells have "pair" (0 for an element), "state" (0 open,
/// 1 closed, 2 at its face; -1 for an element), "surface", "direction" (1 to 3 along the axes, 4 to 6 about
/// them; 0), "face", "gap", "force", and what the element's ends or corners read, by name. The field data say
/// step, increment and share.
///
/// A structure from elsewhere is drawn where its nodes have places: its edges as lines, "displacement" and
/// "reaction" as they are, "rotation" where it has any; pairs at dofs without a place have no cell.
[[nodiscard]] std::string vtu_of_frame(const problem& p, const frame& f);

/// A collection of `count` files, by their place in which they were kept; "time" counts them from 0.
/// `stem` is their common name without folder: see name_of_frame.
[[nodiscard]] std::string pvd_of_frames(const std::string& stem, std::size_t count);

/// "out.007.vtu" for 7, of a stem "out".
[[nodiscard]] std::string name_of_frame(const std::string& stem, std::size_t number);

}  // namespace contct::write
