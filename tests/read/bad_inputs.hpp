// Kinds of bad input: what a person may get wrong, and what the message must say.
#pragma once

#include <string>
#include <vector>

namespace contct {

struct bad_input {
  const char* what;     ///< the mistake
  std::string text;     ///< the problem file
  const char* place;    ///< "line:column" in it
  const char* key;      ///< the key that the message must name
  const char* found;    ///< what it must say was found
  const char* allowed;  ///< what it must say is allowed
};

/// A good problem, in which each mistake is made by replacing one piece. Lines are counted from 1.
inline const char* const good_problem =
    "[beam]\n"                                // 1
    "x = [0.0, 1.0, 2.0]\n"                   // 2
    "EI = 1.0e4\n"                            // 3
    "[[support]]\n"                           // 4
    "node = 1\n"                              // 5
    "fix = [\"w\", \"theta\"]\n"              // 6
    "[[contact]]\n"                           // 7
    "node = 3\n"                              // 8
    "surface = \"below\"\n"                   // 9
    "face = -0.004\n"                         // 10
    "stiffness = 5.0e4\n"                     // 11
    "[[step]]\n"                              // 12
    "point = [ { node = 3, w = -60.0 } ]\n";  // 13

/// `good_problem` with `piece` replaced by `mistake`.
inline std::string with(const std::string& piece, const std::string& mistake) {
  std::string text = good_problem;
  return text.replace(text.find(piece), piece.size(), mistake);
}

inline std::vector<bad_input> bad_inputs() {
  return {
      {"unknown top-level key", with("[beam]", "titel = \"x\"\n[beam]"), "1:1", "titel", "unknown",
       "title, beam"},
      {"unknown key in a table", with("stiffness", "stifness"), "11:1", "contact[1].stifness", "unknown",
       "stiffness"},
      {"no structure", "[[step]]\nuniform = 1.0\n", "1:1", "the file", "neither beam nor plate",
       "exactly one"},
      {"beam is a number", "beam = 3\n", "1:8", "beam", "3", "table"},
      {"beam is an array of tables", with("[beam]", "[[beam]]"), "1:1", "beam", "array", "table"},
      {"beam in double brackets", with("[beam]", "[[beam]]"), "1:1", "beam", "an array of 1",
       "[beam] in single brackets"},
      {"support in single brackets", with("[[support]]", "[support]"), "4:1", "support", "a table",
       "[[support]] in double brackets"},
      {"contact in single brackets", with("[[contact]]", "[contact]"), "7:1", "contact", "a table",
       "[[contact]] in double brackets"},
      {"step in single brackets", with("[[step]]", "[step]"), "12:1", "step", "a table",
       "[[step]] in double brackets"},
      {"a point load that is no list", with("[ { node = 3, w = -60.0 } ]", "{ node = 3, w = -60.0 }"), "13:9",
       "step[1].point", "a table", "array of at least one table"},
      {"no EI", with("EI = 1.0e4\n", ""), "1:1", "beam.EI", "missing", "greater than 0"},
      {"EI is text", with("1.0e4", "\"stiff\""), "3:6", "beam.EI", "\"stiff\"", "number"},
      {"EI is zero", with("1.0e4", "0.0"), "3:6", "beam.EI", "0", "greater than 0"},
      {"EI is negative", with("1.0e4", "-1"), "3:6", "beam.EI", "-1", "greater than 0"},
      {"EI is NaN", with("1.0e4", "nan"), "3:6", "beam.EI", "nan", "greater than 0"},
      {"EI is infinite", with("1.0e4", "inf"), "3:6", "beam.EI", "inf", "finite"},
      {"one EI too many", with("1.0e4", "[1.0, 1.0, 1.0]"), "3:6", "beam.EI", "array of 3",
       "2: one for each"},
      {"one of the EIs is negative", with("1.0e4", "[1.0, -2.0]"), "3:12", "beam.EI[2]", "-2",
       "greater than 0"},
      {"unordered coordinates", with("1.0, 2.0]", "2.0, 1.0]"), "2:16", "beam.x[3]", "1",
       "more than the node before"},
      {"an element of length zero", with("0.0, 1.0", "1.0, 1.0"), "2:11", "beam.x[2]", "1", "more than"},
      {"one node only", with("[0.0, 1.0, 2.0]", "[0.0]"), "2:5", "beam.x", "array of 1", "at least 2"},
      {"a coordinate is NaN", with("1.0, 2.0]", "nan, 2.0]"), "2:11", "beam.x[2]", "nan", "finite"},
      {"a coordinate is text", with("1.0, 2.0]", "\"1\", 2.0]"), "2:11", "beam.x[2]", "\"1\"", "finite"},
      {"x beside length", with("EI", "length = 2.0\nEI"), "3:10", "beam.length", "beside x", "either x"},
      {"a negative length", with("x = [0.0, 1.0, 2.0]", "length = -2.0\nelements = 2"), "2:10", "beam.length",
       "-2", "greater than 0"},
      {"length without elements", with("x = [0.0, 1.0, 2.0]", "length = 2.0"), "1:1", "beam.elements",
       "missing", "whole number"},
      {"no elements", with("x = [0.0, 1.0, 2.0]", "length = 2.0\nelements = 0"), "3:12", "beam.elements", "0",
       "from 1"},
      {"two and a half elements", with("x = [0.0, 1.0, 2.0]", "length = 2.0\nelements = 2.5"), "3:12",
       "beam.elements", "2.5", "whole number"},
      {"more elements than anyone has memory for",
       with("x = [0.0, 1.0, 2.0]", "length = 2.0\nelements = 4000000000"), "3:12", "beam.elements",
       "4000000000", "to 2000000"},
      {"a stiffness beyond double precision", with("[0.0, 1.0, 2.0]", "[0.0, 1e-200, 2.0]"), "1:1", "beam",
       "element 1", "range of double precision"},
      {"a support at a node that is not there", with("node = 1\n", "node = 4\n"), "5:8", "support[1].node",
       "4", "from 1 to 3"},
      {"node 0", with("node = 1\n", "node = 0\n"), "5:8", "support[1].node", "0", "from 1 to 3"},
      {"a support without a node", with("node = 1\n", ""), "4:1", "support[1].node", "missing",
       "from 1 to 3"},
      {"a support that does nothing", with("fix = [\"w\", \"theta\"]\n", ""), "4:1", "support[1]", "neither",
       "at least one"},
      {"fix of an unknown dof", with("\"theta\"", "\"u\""), "6:13", "support[1].fix[2]", "\"u\"", "theta"},
      {"fix is text", with("[\"w\", \"theta\"]", "\"w\""), "6:7", "support[1].fix", "\"w\"", "array"},
      {"fix twice", with("\"theta\"", "\"w\""), "6:13", "support[1].fix[2]", "\"w\"", "once"},
      {"a spring of no stiffness", with("fix = [\"w\", \"theta\"]", "spring = { w = 0.0 }"), "6:16",
       "support[1].spring.w", "0", "greater than 0"},
      {"an empty spring", with("fix = [\"w\", \"theta\"]", "spring = {}"), "6:10", "support[1].spring",
       "empty", "w, theta"},
      {"both node and nodes", with("node = 1\n", "node = 1\nnodes = \"all\"\n"), "5:8", "support[1].node",
       "beside nodes", "either"},
      {"a range that runs backwards", with("node = 1\n", "nodes = \"3..1\"\n"), "5:9", "support[1].nodes",
       "3..1", "a..b"},
      {"a node listed twice", with("node = 1\n", "nodes = [1, 2, 1]\n"), "5:16", "support[1].nodes[3]",
       "second time", "each once"},
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
      {"a state that is neither", with("face = -0.004", "face = -0.004\nstate = \"closed\""), "11:9",
       "contact[1].state", "\"closed\"", "separated"},
      {"a bed of negative modulus", with("[[step]]", "[[bed]]\nmodulus = -1\nface = 0\n[[step]]"), "13:11",
       "bed[1].modulus", "-1", "greater than 0"},
      {"a bed under fixed nodes only",
       with("[[step]]", "[[bed]]\nmodulus = 1\nface = 0\nnodes = [1]\n[[step]]"), "12:1", "bed[1]",
       "only nodes that are fixed", "at least one"},
      {"no steps", with("[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n", ""), "", "step", "missing",
       "table"},
      {"an empty step", with("point = [ { node = 3, w = -60.0 } ]\n", ""), "12:1", "step[1]", "without loads",
       "uniform"},
      {"a table that is none of ours",
       with("[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n", "") + "[other]\n", "12:2", "other", "unknown",
       "step"},
      {"a load at a node that is not there", with("{ node = 3, w", "{ node = 9, w"), "13:20",
       "step[1].point[1].node", "9", "from 1 to 3"},
      {"a load without a value", with(", w = -60.0", ""), "13:11", "step[1].point[1]", "without w", "theta"},
      {"a load that is infinite", with("-60.0", "-inf"), "13:27", "step[1].point[1].w", "-inf", "finite"},
      {"point is a table", with("[ { node = 3, w = -60.0 } ]", "{ node = 3, w = -60.0 }"), "13:9",
       "step[1].point", "table", "at least one table"},
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
      {"a key with a control character", with("[beam]", "\"\\u001b[31m\" = 1\n[beam]"), "1:1", "?[31m",
       "unknown", "title"},
      {"a key twice", with("EI = 1.0e4", "EI = 1.0e4\nEI = 2.0e4"), "4:", "", "not TOML", ""},
      {"a quote left open", with("\"below\"", "\"below"), "9:", "", "not TOML", ""},
      {"a date for a number", with("1.0e4", "1989-08-28"), "3:6", "beam.EI", "date", "number"},
  };
}

}  // namespace contct
