// Lists kinds of bad input, and the required parts of their messages.
#pragma once

#include <string>
#include <vector>

#include "read/bad_combinations.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "read/refusals.hpp"

namespace contct {

/// Returns `good_problem` with these lines of [beam] instead of x and EI, for meshes by element_size.
inline std::string sized_with(const std::string& lines) {
  return with("x = [0.0, 1.0, 2.0]\nEI = 1.0e4\n", lines);
}

/// Returns `good_problem` with these lines in its [[step]].
inline std::string step_with(const std::string& lines) {
  return with("point = [ { node = 3, w = -60.0 } ]\n", lines);
}

/// Returns `good_problem` with a bed that has these lines from line 14 on.
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
      {"a point load beyond the beam", with("{ node = 3, w", "{ x = [1.25, 2.25], w"), "13:24",
       "step[1].point[1].x[2]", "2.25, which is outside", "from 0 to 2"},
      {"a point load twice between two nodes", with("{ node = 3, w", "{ x = [1.25, 1.25], w"), "13:24",
       "step[1].point[1].x[2]", "1.25 a second time", "each place once"},
      {"a point load between nodes of no dof", with("{ node = 3, w = -60.0", "{ x = 1.25"), "13:11",
       "step[1].point[1]", "a point load without w or theta", "at least one of w, theta"},
      {"a point load at a node and an x", with("{ node = 3, w", "{ x = 1.25, node = 3, w"), "13:30",
       "step[1].point[1].node", "this key together with x", "either x, or node or nodes"},
      {"a settlement between nodes", step_with("settlement = [ { x = 1.25, w = -1 } ]\n"), "13:22",
       "step[1].settlement[1].x", "1.25", "1 (node 2) and 2 (node 3)"},
      {"a point beside the grid", plate_with("node = 6\n", "at = [0.25, 1.0]\n"), "11:7", "contact[1].at[1]",
       "0.25, where there is no grid line along x", "the nearest are 0 and 0.5; grid lines are set by"},
      {"a point outside the plate", plate_with("node = 6\n", "at = [[1.0, 1.0], [1.0, 3]]\n"), "11:25",
       "contact[1].at[2][2]", "3, which is outside", "from 0 to 1"},
      {"a beam's x on a plate", plate_with("node = 6\n", "x = 1.0\n"), "11:1", "contact[1].x", "unknown",
       "node, nodes, at"},
  };
}

/// Returns mistakes in loads from one coordinate to another.
inline std::vector<bad_input> bad_parts() {
  const auto uniform = [](const std::string& keys) {
    return step_with("uniform = [ { value = -1, " + keys + " } ]\n");
  };
  const auto curvature = [](const std::string& keys) {
    return step_with("curvature = [ { " + keys + " } ]\n");
  };
  const auto on_plate = [](const std::string& keys) {
    return plate_with("value = -1.0", "value = -1.0, " + keys);
  };
  return {
      {"a load that ends before it begins", uniform("from = 1.5, to = 0.5"), "13:44", "step[1].uniform[1].to",
       "0.5", "more than 1.5, where this part begins"},
      {"a load of no length", uniform("from = 0.5, to = 0.5"), "13:44", "step[1].uniform[1].to", "0.5",
       "more than 0.5"},
      {"a load that begins where the beam ends", uniform("from = 2"), "13:34", "step[1].uniform[1].from", "2",
       "more than 2, where this part begins"},
      {"a load from outside the beam", uniform("from = -0.5"), "13:34", "step[1].uniform[1].from",
       "-0.5, which is outside the structure", "from 0 to 2"},
      {"a load to no number", uniform("to = nan"), "13:32", "step[1].uniform[1].to", "nan", "finite number"},
      {"a load on elements and from a place", uniform("from = 0.5, elements = [1]"), "13:50",
       "step[1].uniform[1].elements", "this key together with from or to", "either elements, or from and to"},
      {"a load from a corner along a beam", uniform("from = [0, 0]"), "13:34", "step[1].uniform[1].from",
       "an array of 2", "finite number"},
      {"a pressure from a number", on_plate("from = 0.25"), "16:36", "step[1].uniform[1].from", "0.25",
       "a corner of the rectangle, [x, y]"},
      {"a pressure beyond the plate", on_plate("to = [0.5, 1.5]"), "16:40", "step[1].uniform[1].to[2]",
       "1.5, which is outside", "from 0 to 1"},
      {"a rectangle upside down", on_plate("from = [0.0, 0.5], to = [0.5, 0.25]"), "16:59",
       "step[1].uniform[1].to[2]", "0.25", "more than 0.5, where this part begins"},
      {"a curvature without a value", curvature("from = 1"), "13:15", "step[1].curvature[1].value", "missing",
       "finite number"},
      {"a curvature that ends before it begins", curvature("value = 1, to = 0"), "13:33",
       "step[1].curvature[1].to", "0", "more than 0"},
      {"a curvature on elements", curvature("value = 1, elements = [1]"), "13:28",
       "step[1].curvature[1].elements", "unknown", "value, from, to"},
      {"a curvature of a plate", plate_with("[[step]]", "[[step]]\ncurvature = [ { value = 1 } ]"), "16:13",
       "step[1].curvature", "curvature with a plate", "D (1 + nu) c, a moment per length"},
  };
}

inline std::vector<bad_input> bad_meshes() {
  return {
      {"element_size beside elements", sized_with("length = 2\nelements = 4\nelement_size = 1\nEI = 1\n"),
       "3:12", "beam.elements", "this key together with element_size", "either"},
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
      {"a support that is not a table beside element_size",
       "support = 3\n[beam]\nlength = 1\nelement_size = 1\nEI = 1\n", "1:11", "support", "3", "table"},
      {"a border of EI that is not a node",
       with("1.0e4", "[ { to = 0.5, value = 1 }, { to = 2, value = 2 } ]"), "3:15", "beam.EI[1].to",
       "0.5, where there is no node", "element_size"},
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

inline std::vector<bad_input> bad_sections() {
  const std::string self_weight = step_with("self_weight = true\n");
  return {
      {"a section beside EI", with("EI = 1.0e4", "EI = 1.0e4\nsection = { E = 1, I = 1 }"), "3:6", "beam.EI",
       "this key together with section", "either EI, or section"},
      {"a section without I", with("EI = 1.0e4", "section = { E = 1 }"), "3:11", "beam.section.I", "missing",
       "greater than 0"},
      {"a section of no area", with("EI = 1.0e4", "section = { E = 1, I = 1, A = 0 }"), "3:31",
       "beam.section.A", "0", "greater than 0"},
      {"a section with EI", with("EI = 1.0e4", "section = { E = 1, I = 1, EI = 1 }"), "3:27",
       "beam.section.EI", "unknown", "E, I, W, A, weight"},
      {"a section that is a number", with("EI = 1.0e4", "section = 3"), "3:11", "beam.section", "3",
       "a table"},
      {"an end of the only section", with("EI = 1.0e4", "section = { to = 2, E = 1, I = 1 }"), "3:13",
       "beam.section.to", "unknown", "E, I, W"},
      {"a piece of section without an end", with("EI = 1.0e4", "section = [ { E = 1, I = 1 } ]"), "3:13",
       "beam.section[1].to", "missing", "at which this piece ends"},
      {"W of one piece only",
       with("EI = 1.0e4", "section = [ { to = 1, E = 1, I = 1 }, { to = 2, E = 1, I = 1, W = 1 } ]"), "3:39",
       "beam.section[2]", "W in some pieces and not in others", "in every piece, or in no piece"},
      {"a stiffness E I beyond double precision", with("EI = 1.0e4", "section = { E = 1e200, I = 1e200 }"),
       "1:1", "beam", "element 1", "range of double precision"},
      {"self-weight of a beam without section", self_weight, "13:15", "step[1].self_weight",
       "a beam without weight or area", "A and weight in section"},
      {"self-weight that is a number", step_with("self_weight = 1.35\n"), "13:15", "step[1].self_weight",
       "1.35", "true or false"},
      {"self-weight of a plate without weight", plate_with("[[step]]\n", "[[step]]\nself_weight = true\n"),
       "16:15", "step[1].self_weight", "a plate without weight", "thickness and weight in [plate]"},
      {"weight beside D", plate_with("E = 10.92\nnu = 0.3\nthickness = 1.0", "D = 1\nnu = 0.3\nweight = 1"),
       "6:10", "plate.weight", "this key together with D", "together with E and thickness"},
  };
}

inline std::vector<bad_input> bad_hinges() {
  const auto hinge = [](const std::string& lines) { return good_problem + ("[[hinge]]\n" + lines); };
  return {
      {"a hinge at the beam's end", hinge("node = 3\n"), "14:1", "hinge[1]",
       "a hinge at node 3, where the beam", "a node between the ends"},
      {"two hinges at a node", hinge("x = 1\n[[hinge]]\nnode = 2\n"), "16:1", "hinge[2]",
       "a second hinge at node 2", "one hinge at each node"},
      {"a hinge without a place", hinge(""), "14:1", "hinge[1].node", "missing", "from 1 to 3"},
      {"a hinge with a spring", hinge("node = 2\nspring = 3\n"), "16:1", "hinge[1].spring", "unknown",
       "node, nodes, x"},
      {"a hinge of a plate", good_plate + std::string("[[hinge]]\nnode = 3\n"), "18:1", "hinge[1]",
       "a hinge without a beam", "of a [beam]"},
      {"a moment at a hinge",
       with("{ node = 3, w = -60.0 }", "{ node = 2, theta = 1 }") + "[[hinge]]\nnode = 2\n", "13:31",
       "step[1].point[1].theta", "theta at node 2, where a hinge", "at a neighbouring node"},
      {"a clamp at a hinge", hinge("node = 2\n[[support]]\nnodes = [1, 2]\nfix = \"theta\"\n"), "18:7",
       "support[2].fix", "theta at node 2, where a hinge", "w at this node, and theta at a neighbouring"},
      {"a spring about a hinge", hinge("node = 2\n[[support]]\nnode = 2\nspring = { theta = 1 }\n"), "18:20",
       "support[2].spring.theta", "theta at node 2", "at a neighbouring node"},
  };
}

inline std::vector<bad_input> bad_pairs() {
  const std::string pair = "node = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n";
  const std::string three = "nodes = [1, 2, 3]\nsurface = \"below\"\n";
  return {
      {"a face too few", with(pair, three + "stiffness = 1\nface = [0, -1.5]\n"), "11:8", "contact[1].face",
       "array of 2", "one number, or 3 numbers, one for each pair"},
      {"a stiffness too many", with(pair, three + "face = 0\nstiffness = [1, 2, 3, 4]\n"), "11:13",
       "contact[1].stiffness", "array of 4", "one number, or 3"},
      {"one of several faces inside the structure", with(pair, three + "stiffness = 1\nface = [0, -1, 1]\n"),
       "11:16", "contact[1].face[3]", "1 at node 3: the face is inside", "at most 0"},
      {"contact where one of several faces is not at 0",
       with(pair, three + "stiffness = 1\nface = [0, 0, -2]\nstate = \"contact\"\n"), "12:9",
       "contact[1].state", "face -2 at node 3", "only if face = 0"},
      {"a state for each pair", with(pair, three + "stiffness = 1\nface = 0\nstate = [\"contact\"]\n"),
       "12:9", "contact[1].state", "an array of 1", "\"separated\" or \"contact\""},
      {"a face too few under a bed", bed_with("face = [0, 0]\n"), "16:8", "bed[1].face", "an array of 2",
       "3 numbers, one for each node of the bed, fixed or not"},
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
  const std::string line = "settlement = [ { node = 1, w = -0.1 }";  // a correct line of columns 1 to 38
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
       "step[1].settlement[1].w", "a settlement of node 2, whose w is free",
       "a dof that a [[support]] fixes"},
      {"a settlement on a spring",
       with("fix = [\"w\", \"theta\"]\n", "fix = \"w\"\nspring = { theta = 1 }\n") +
           "settlement = [ { x = 0, theta = 1 } ]\n",
       "15:33", "step[1].settlement[1].theta", "of node 1, whose theta has a spring",
       "a dof that a [[support]] fixes; if the base of a spring k moves by d, apply the load k d"},
      {"a dof that settles twice", step_with(line + ", { x = 0.0, w = 1 } ]\n"), "13:55",
       "step[1].settlement[2].w", "node 1, a second time in this step", "each dof once"},
      {"a settlement without a value", step_with("settlement = [ { node = 1 } ]\n"), "13:16",
       "step[1].settlement[1]", "a settlement without w or theta", "at least one"},
      {"a point load without brackets", step_with("point = { node = 3, w = 1 }\n"), "13:9", "step[1].point",
       "a table", "[ { .. } ], with brackets around the braces"},
      {"a decimal comma behind thousands", with("1.0e4", "10.000,5"), "3:", "", "not TOML",
       "a decimal point, 4.0 instead of 4,0"},
      {"a move where no pair is", step_with("move = [ { node = 2, w = 1 } ]\n"), "13:10", "step[1].move[1]",
       "no pair at node 2", "at which a [[contact]] or a [[bed]] has a pair"},
      {"a face that moves twice", step_with("move = [ { node = 3, w = 1 }, { x = 2, w = 2 } ]\n"), "13:44",
       "step[1].move[2].w", "node 3, a second time in this step", "each place once"},
      {"a move of a slope", step_with("move = [ { node = 3, theta = 1 } ]\n"), "13:22",
       "step[1].move[1].theta", "unknown", "node, nodes, x, w"},
      {"a move without a distance", step_with("move = [ { node = 3 } ]\n"), "13:10", "step[1].move[1].w",
       "missing", "number"},
      {"a pair between two nodes of a beam", with("face = -0.004\n", "face = -0.004\nother = 2\n"), "11:9",
       "contact[1].other", R"(the key "other" with a beam or a plate)",
       "for a gap between two structures, one"},
      {"a settlement of a pair", step_with("settlement = [ { node = 3, w = 1 } ]\n"), "13:32",
       "step[1].settlement[1].w", "node 3, whose w is free", "move, written like settlement"},
      {"a decimal comma", with("-0.004", "-0,004"), "10:", "", "not TOML",
       "a decimal point, 4.0 instead of 4,0"},
  };
}

inline std::vector<bad_input> bad_tables() {
  return {
      {"unknown top-level key", with("[beam]", "titel = \"x\"\n[beam]"), "1:1", "titel", "unknown",
       "title, units, beam"},
      {"unknown key in a table", with("stiffness", "stifness"), "11:1", "contact[1].stifness", "unknown",
       "stiffness"},
      {"no structure", "[[step]]\nuniform = 1.0\n", "1:1", "the file", "none of [beam]", "exactly one"},
      {"beam is a number", "beam = 3\n", "1:8", "beam", "3", "table"},
      {"beam in double brackets", with("[beam]", "[[beam]]"), "1:1", "beam", "an array of 1",
       "[beam] in single brackets"},
      {"support in single brackets", with("[[support]]", "[support]"), "4:1", "support", "a table",
       "[[support]] in double brackets"},
      {"no EI", with("EI = 1.0e4\n", ""), "1:1", "beam.EI", "missing", "greater than 0"},
      {"EI is text", with("1.0e4", "\"stiff\""), "3:6", "beam.EI", "\"stiff\"", "number"},
      {"EI is negative", with("1.0e4", "-1"), "3:6", "beam.EI", "-1", "greater than 0"},
      {"EI is infinite", with("1.0e4", "inf"), "3:6", "beam.EI", "inf", "finite"},
      {"one EI too many", with("1.0e4", "[1.0, 1.0, 1.0]"), "3:6", "beam.EI", "array of 3",
       "2 numbers, one for each"},
      {"unordered coordinates", with("1.0, 2.0]", "2.0, 1.0]"), "2:16", "beam.x[3]", "1",
       "more than the node before"},
      {"one node only", with("[0.0, 1.0, 2.0]", "[0.0]"), "2:5", "beam.x", "array of 1", "at least 2"},
      {"x beside length", with("EI", "length = 2.0\nEI"), "3:10", "beam.length", "this key together with x",
       "either x"},
      {"a negative length", with("x = [0.0, 1.0, 2.0]", "length = -2.0\nelements = 2"), "2:10", "beam.length",
       "-2", "greater than 0"},
      {"length without elements", with("x = [0.0, 1.0, 2.0]", "length = 2.0"), "1:1", "beam.elements",
       "missing", "whole number"},
      {"a whole number with a point", with("x = [0.0, 1.0, 2.0]", "length = 2.0\nelements = 4.0"), "3:12",
       "beam.elements", "found 4.0;", "a whole number from 1 to 2000000"},
      {"a whole number with an exponent", with("node = 1\n", "node = 1e0\n"), "5:8", "support[1].node",
       "found 1.0;", "a whole number from 1 to 3"},
      {"more elements than anyone has memory for",
       with("x = [0.0, 1.0, 2.0]", "length = 2.0\nelements = 4000000000"), "3:12", "beam.elements",
       "4000000000", "to 2000000"},
      {"a stiffness beyond double precision", with("[0.0, 1.0, 2.0]", "[0.0, 1e-200, 2.0]"), "1:1", "beam",
       "element 1", "range of double precision"},
      {"a support at a node that is not there", with("node = 1\n", "node = 4\n"), "5:8", "support[1].node",
       "4", "from 1 to 3"},
      {"a support without a node", with("node = 1\n", ""), "4:1", "support[1].node", "missing",
       "from 1 to 3"},
      {"a support that does nothing", with("fix = [\"w\", \"theta\"]\n", ""), "4:1", "support[1]", "neither",
       "at least one"},
      {"fix of an unknown dof", with("\"theta\"", "\"u\""), "6:13", "support[1].fix[2]", "\"u\"", "theta"},
      {"fix is a number", with("[\"w\", \"theta\"]", "1"), "6:7", "support[1].fix", "1", "one of \"w\""},
      {"fix twice", with("\"theta\"", "\"w\""), "6:13", "support[1].fix[2]", "\"w\"", "once"},
      {"a spring of no stiffness", with("fix = [\"w\", \"theta\"]", "spring = { w = 0.0 }"), "6:16",
       "support[1].spring.w", "0", "greater than 0"},
      {"an empty spring", with("fix = [\"w\", \"theta\"]", "spring = {}"), "6:10", "support[1].spring",
       "empty", "w, theta"},
      {"no face", with("face = -0.004\n", ""), "7:1", "contact[1].face", "missing", "finite number"},
      {"no stiffness", with("stiffness = 5.0e4\n", ""), "7:1", "contact[1].stiffness", "missing",
       "greater than 0"},
      {"a negative stiffness", with("5.0e4", "-5.0e4"), "11:13", "contact[1].stiffness", "-50000",
       "greater than 0"},
      {"no surface", with("surface = \"below\"\n", ""), "7:1", "contact[1].surface", "missing", "below"},
      {"a surface that is neither", with("\"below\"", "\"left\""), "9:11", "contact[1].surface", "\"left\"",
       "\"above\""},
      {"a face inside the structure, below", with("-0.004", "0.004"), "10:8", "contact[1].face", "inside",
       "at most 0"},
      {"a face inside the structure, above", with("\"below\"", "\"above\""), "10:8", "contact[1].face",
       "inside", "at least 0"},
      {"contact before anything touches", with("face = -0.004", "face = -0.004\nstate = \"contact\""), "11:9",
       "contact[1].state", "contact", "face = 0"},
      {"a bed of negative modulus", with("[[step]]", "[[bed]]\nmodulus = -1\nface = 0\n[[step]]"), "13:11",
       "bed[1].modulus", "-1", "greater than 0"},
      {"a bed under fixed nodes only",
       with("[[step]]", "[[bed]]\nmodulus = 1\nface = 0\nnodes = [1]\n[[step]]"), "12:1", "bed[1]",
       "only nodes that are fixed", "at least one"},
      {"no steps", with("[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n", ""), "", "step", "missing",
       "table"},
      {"an empty step", with("point = [ { node = 3, w = -60.0 } ]\n", ""), "12:1", "step[1]",
       "without a load, settlement or move", "uniform"},
      {"a table that is none of ours",
       with("[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n", "") + "[other]\n", "12:2", "other", "unknown",
       "step"},
      {"a load at a node that is not there", with("{ node = 3, w", "{ node = 9, w"), "13:20",
       "step[1].point[1].node", "9", "from 1 to 3"},
      {"a load without a value", with(", w = -60.0", ""), "13:11", "step[1].point[1]", "without w", "theta"},
      {"uniform is text", with("point = [ { node = 3, w = -60.0 } ]", "uniform = \"heavy\""), "13:11",
       "step[1].uniform", "\"heavy\"", "number"},
      {"uniform with value and polynomial",
       with("point = [ { node = 3, w = -60.0 } ]", "uniform = [ { value = 1, polynomial = [1] } ]"), "13:13",
       "step[1].uniform[1]", "both or neither", "one of them"},
      {"uniform on elements that are not there",
       with("point = [ { node = 3, w = -60.0 } ]", "uniform = [ { value = 1, elements = \"1..9\" } ]"),
       "13:37", "step[1].uniform[1].elements", "1..9", "from 1 to 2"},
      {"loads whose sum overflows", with("point = [ { node = 3, w = -60.0 } ]", "uniform = 1e308"), "12:1",
       "step[1]", "not finite", "range of double precision"},
      {"a key with a control character", with("[beam]", "\"\\u001b[31m\" = 1\n[beam]"), "1:1", "\\x1b[31m",
       "unknown", "title"},
      {"a key twice", with("EI = 1.0e4", "EI = 1.0e4\nEI = 2.0e4"), "4:", "not TOML",
       "found floating-point 'EI' a second time", "each key and table once"},
      {"a quote left open", with("\"below\"", "\"below"), "9:", "not TOML",
       "text without a quotation mark at its end", "text in quotes on one line"},
      {"an inline table on two lines", with("node = 3, ", "node = 3,\n"), "13:22", "not TOML",
       "a line end or a comment in { .. }", "all of { .. } on one line, or a table with a header"},
      {"a comment in an inline table", with("node = 3, w", "node = 3, # tip\n w"), "13:23", "not TOML",
       "a line end or a comment in { .. }", "on one line"},
      {"a comma behind the last key", with("w = -60.0 }", "w = -60.0, }"), "13:34", "not TOML",
       "found a comma before }", "no comma after the last key of { .. }"},
      {"a typographic minus", with("-0.004", "\u22120.004"), "10:8", "not TOML", "found \"\u2212\" (U+2212)",
       "allowed: -"},
      {"a dash in an exponent", with("1.0e4", "1.0e\u20134"), "3:10", "not TOML", "(U+2013)", "allowed: -"},
      {"typographic quotation marks", with("\"below\"", "\u201cbelow\u201d"), "9:11", "not TOML", "(U+201C)",
       "allowed: \""},
      {"a no-break space", with("EI = ", "EI =\u00a0"), "3:5", "not TOML", "(U+00A0)", "allowed: a blank"},
      {"a decimal point without a digit", with("1.0e4", ".5"), "3:6", "not TOML",
       "found '.' in floating-point", "allowed: decimal digit"},
      {"a bracket left open", "[beam", "1:6", "not TOML", "the end of the file",
       "the rest of this table header"},
  };
}

/// Returns the mistakes of all tables.
inline std::vector<bad_input> bad_inputs() {
  std::vector<bad_input> all = bad_tables();
  for (const auto& more : {bad_plates(), bad_coordinates(), bad_parts(), bad_meshes(), bad_sections(),
                           bad_hinges(), bad_pairs(), bad_units_and_steps(), bad_combinations()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace contct
