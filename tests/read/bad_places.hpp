// Kinds of bad input in what names coordinates, several pairs at once, faces along a bed, and settlements.
#pragma once

#include <string>
#include <vector>

#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "read/refusals.hpp"

namespace contct {

/// `good_problem` on a beam with element_size instead of coordinates and EI, given by these lines.
inline std::string sized_with(const std::string& lines) {
  return with("x = [0.0, 1.0, 2.0]\nEI = 1.0e4\n", lines);
}

/// `good_problem` with these lines for the last table's.
inline std::string step_with(const std::string& lines) {
  return with("point = [ { node = 3, w = -60.0 } ]\n", lines);
}

/// `good_problem` with a bed of these lines from line 14 on.
inline std::string bed_with(const std::string& lines) {
  return good_problem + ("[[bed]]\nmodulus = 1\n" + lines);
}

inline std::vector<bad_input> bad_coordinates() {
  return {
      {"an x between two nodes", with("node = 1\n", "x = 0.5\n"), "5:5", "support[1].x",
       "0.5, where there is", "the nearest are 0 (node 1) and 1 (node 2); element_size in [beam]"},
      {"an x beyond the beam", with("node = 1\n", "x = 2.5\n"), "5:5", "support[1].x",
       "2.5, which is outside", "from 0 to 2"},
      {"an x before the beam", with("node = 1\n", "x = [0, -1]\n"), "5:9", "support[1].x[2]", "-1", "from 0"},
      {"an x that is text", with("node = 1\n", "x = \"left\"\n"), "5:5", "support[1].x", "\"left\"",
       "number"},
      {"a point load between nodes", with("{ node = 3, w", "{ x = 1.25, w"), "13:17", "step[1].point[1].x",
       "1.25", "1 (node 2) and 2 (node 3)"},
      {"a point beside the grid", plate_with("node = 6\n", "at = [0.25, 1.0]\n"), "11:7", "contact[1].at[1]",
       "0.25, where there is no grid line along x", "the nearest are 0 and 0.5; grid lines are set by"},
      {"a point outside the plate", plate_with("node = 6\n", "at = [[1.0, 1.0], [1.0, 3]]\n"), "11:25",
       "contact[1].at[2][2]", "3, which is outside", "from 0 to 1"},
      {"a beam's x on a plate", plate_with("node = 6\n", "x = 1.0\n"), "11:1", "contact[1].x", "unknown",
       "node, nodes, at"},
  };
}

inline std::vector<bad_input> bad_meshes() {
  return {
      {"element_size beside elements", sized_with("length = 2\nelements = 4\nelement_size = 1\nEI = 1\n"),
       "3:12", "beam.elements", "beside element_size", "either"},
      {"element_size without length", sized_with("element_size = 1\nEI = 1\n"), "1:1", "beam.length",
       "missing", "greater than 0"},
      {"neither elements nor their size", sized_with("length = 2\nEI = 1\n"), "1:1", "beam.elements",
       "missing", "or element_size"},
      {"more small elements than anyone has memory for",
       sized_with("length = 2\nelement_size = 1e-9\nEI = 1\n"), "3:16", "beam.element_size",
       "1e-09, which makes 2000000000 elements", "at most 2000000"},
      {"one EI for each element of a size", sized_with("length = 2\nelement_size = 1\nEI = [1, 2]\n"), "4:6",
       "beam.EI", "array of 2", "pieces { to ="},
      {"an x outside a beam of sized elements",
       sized_with("length = 1\nelement_size = 1\nEI = 1\n") + "[[support]]\nx = 1.5\nfix = \"w\"\n", "16:5",
       "support[2].x", "1.5, which is outside", "from 0 to 1"},
      {"a support that is no table beside element_size",
       "support = 3\n[beam]\nlength = 1\nelement_size = 1\nEI = 1\n", "1:11", "support", "3", "table"},
      {"a border of EI that is no node", with("1.0e4", "[ { to = 0.5, value = 1 }, { to = 2, value = 2 } ]"),
       "3:15", "beam.EI[1].to", "0.5, where there is no node", "element_size"},
      {"pieces of EI that do not reach the end", with("1.0e4", "[ { to = 1.0, value = 1 } ]"), "3:6",
       "beam.EI", "pieces that end at 1", "to 2, where the beam ends"},
      {"pieces of EI out of order", with("1.0e4", "[ { to = 2.0, value = 1 }, { to = 1.0, value = 1 } ]"),
       "3:40", "beam.EI[2].to", "1", "more than 2"},
      {"a piece of EI without a value", with("1.0e4", "[ { to = 2.0 } ]"), "3:8", "beam.EI[1].value",
       "missing", "greater than 0"},
      {"a piece of EI without an end", with("1.0e4", "[ { value = 2.0 } ]"), "3:8", "beam.EI[1].to",
       "missing", "at which this piece ends"},
      {"pieces and numbers mixed", with("1.0e4", "[ { to = 1, value = 2 }, 3 ]"), "3:31", "beam.EI[2]", "3",
       "a table"},
  };
}

inline std::vector<bad_input> bad_pairs() {
  const std::string pair = "node = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n";
  const std::string three = "nodes = [1, 2, 3]\nsurface = \"below\"\n";
  return {
      {"a face too few", with(pair, three + "stiffness = 1\nface = [0, -1.5]\n"), "11:8", "contact[1].face",
       "array of 2", "one number, or 3: one for each pair"},
      {"a stiffness too many", with(pair, three + "face = 0\nstiffness = [1, 2, 3, 4]\n"), "11:13",
       "contact[1].stiffness", "array of 4", "one number, or 3"},
      {"one of several faces inside the structure", with(pair, three + "stiffness = 1\nface = [0, -1, 1]\n"),
       "11:16", "contact[1].face[3]", "1 at node 3: the face is inside", "at most 0"},
      {"contact where one of several faces is not at 0",
       with(pair, three + "stiffness = 1\nface = [0, 0, -2]\nstate = \"contact\"\n"), "12:9",
       "contact[1].state", "face -2 at node 3", "only where face = 0"},
      {"a state for each pair", with(pair, three + "stiffness = 1\nface = 0\nstate = [\"contact\"]\n"),
       "12:9", "contact[1].state", "an array of 1", "\"separated\" or \"contact\""},
      {"a face too few under a bed", bed_with("face = [0, 0]\n"), "16:8", "bed[1].face", "an array of 2",
       "3: one for each node of the bed, fixed or not"},
      {"a bed's polynomial inside the structure", bed_with("face = { polynomial = [0, 0.5] }\n"), "16:8",
       "bed[1].face", "0.5 at node 2: the face is inside", "at most 0"},
      {"a bed's polynomial beyond double precision", bed_with("face = { polynomial = [0, -1e308] }\n"),
       "16:23", "bed[1].face.polynomial", "array of 2", "finite at every node"},
      {"a face that is a table of something else", bed_with("face = { poly = [0] }\n"), "16:10",
       "bed[1].face.poly", "unknown", "polynomial"},
      {"a face along a plate",
       plate_with("[[step]]", "[[bed]]\nmodulus = 1\nface = { polynomial = [0] }\n[[step]]"), "17:23",
       "bed[1].face.polynomial", "array of 1", "only along a beam"},
      {"a bed limited to no node of the beam", bed_with("face = 0\nx = [1, 1.5]\n"), "17:9", "bed[1].x[2]",
       "1.5, where there is no node", "the nearest are"},
  };
}

inline std::vector<bad_input> bad_units_and_steps() {
  const std::string line = "settlement = [ { node = 1, w = -0.1 }";  // good, from column 1 to 38
  return {
      {"a unit alone", with("[beam]", "[units]\nlength = \"m\"\n[beam]"), "1:1", "units.force", "missing",
       "text"},
      {"a unit without a name", with("[beam]", "[units]\nlength = \"m\"\nforce = \" \"\n[beam]"), "3:9",
       "units.force", "\" \"", "the name of a unit"},
      {"a unit that is a number", with("[beam]", "[units]\nlength = 1\nforce = \"N\"\n[beam]"), "2:10",
       "units.length", "1", "text"},
      {"a unit of another kind", with("[beam]", "[units]\ntime = \"s\"\n[beam]"), "2:1", "units.time",
       "unknown", "length, force"},
      {"a step's name that is a number", step_with("name = 3\nuniform = 1\n"), "13:8", "step[1].name", "3",
       "text"},
      {"a settlement of a free dof", step_with("settlement = [ { node = 2, w = 1 } ]\n"), "13:32",
       "step[1].settlement[1].w", "a settlement of node 2, whose w no support holds", "[[support]] fixes"},
      {"a settlement on a spring",
       with("fix = [\"w\", \"theta\"]\n", "fix = \"w\"\nspring = { theta = 1 }\n") +
           "settlement = [ { x = 0, theta = 1 } ]\n",
       "15:33", "step[1].settlement[1].theta", "of node 1, whose theta is on a spring", "[[support]] fixes"},
      {"a dof that settles twice", step_with(line + ", { x = 0.0, w = 1 } ]\n"), "13:55",
       "step[1].settlement[2].w", "node 1, a second time in this step", "each dof once"},
      {"a settlement without a value", step_with("settlement = [ { node = 1 } ]\n"), "13:16",
       "step[1].settlement[1]", "a settlement without w or theta", "at least one"},
      {"a decimal comma", with("-0.004", "-0,004"), "10:", "", "not TOML", "a decimal point, 4.0 for 4,0"},
  };
}

/// All kinds in this file.
inline std::vector<bad_input> bad_places() {
  std::vector<bad_input> all = bad_coordinates();
  for (const auto& more : {bad_meshes(), bad_pairs(), bad_units_and_steps()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace contct
