// Lists mistakes in [[case]], [[combination]] and [[train]], for the tests of refusals.
#pragma once

#include <string>
#include <vector>

#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "read/refusals.hpp"

namespace contct {

/// Returns `good_problem` with these tables from line 12 on instead of its [[step]].
inline std::string cases_with(const std::string& tables) {
  return with("[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n", tables);
}

inline const char* const case_g = "[[case]]\nname = \"G\"\nuniform = -1\n";  // lines 12 to 14

/// Returns `good_problem` with the case G and, from line 15 on, a train of two axles that ends with these
/// lines.
inline std::string train_with(const std::string& lines) {
  return cases_with(std::string(case_g) +
                    "[[train]]\nname = \"T\"\naxles = [ { at = 0, w = -1 }, { at = 1, w = -2 } ]\n" + lines);
}

inline std::vector<bad_input> bad_combinations() {
  const std::string g = case_g;
  const std::string combination = g + "[[combination]]\nname = \"C\"\n";
  const std::string places = "from = 0\nto = 2\nby = 1\n";
  return {
      {"cases that nothing uses", cases_with(g), "12:1", "case", "neither a [[combination]] nor a [[train]]",
       "terms = { NAME = 1.0 }"},
      {"a step beside a combination", std::string(good_problem) + combination + "terms = { G = 1 }\n", "12:1",
       "step", "this key together with combination", "from the unloaded structure"},
      {"a step beside a train", train_with(places) + "[[step]]\nuniform = 1\n", "21:1", "step",
       "this key together with train", "[[step]]s, each of which continues"},
      {"a case without a name", cases_with("[[case]]\nuniform = -1\n" + combination + "terms = { G = 1 }\n"),
       "12:1", "case[1].name", "missing", "text"},
      {"a case whose name is blank",
       cases_with("[[case]]\nname = \" \"\nuniform = -1\n" + combination + "terms = { G = 1 }\n"), "13:8",
       "case[1].name", "\" \"", "a name"},
      {"two cases of one name", cases_with(g + combination + "terms = { G = 1 }\n"), "16:8", "case[2].name",
       "\"G\", a second time", "each name once"},
      {"two combinations of one name",
       cases_with(combination + "terms = { G = 1 }\n[[combination]]\nname = \"C\"\nterms = { G = 2 }\n"),
       "19:8", "combination[2].name", "\"C\", a second time", "each name once"},
      {"a case without loads", cases_with("[[case]]\nname = \"G\"\n[[combination]]\nname = \"C\"\n"), "12:1",
       "case[1]", "without a load, settlement or move", "at least one of"},
      {"a combination without terms", cases_with(combination), "15:1", "combination[1].terms", "missing",
       "a table"},
      {"no terms in a combination", cases_with(combination + "terms = {}\n"), "17:9", "combination[1].terms",
       "an empty table", "{ G = 1.35 }"},
      {"a case that is not there", cases_with(combination + "terms = { H = 1 }\n"), "17:15",
       "combination[1].terms.H", "no [[case]] of this name", "the name of a [[case]]: G"},
      {"a train in a combination",
       train_with(places) + "[[combination]]\nname = \"C\"\nterms = { G = 1, T = 1 }\n", "23:22",
       "combination[1].terms.T", "a [[train]], which has terms of its own", "the name of a [[case]]: G"},
      {"a combination in a combination", cases_with(combination + "terms = { C = 1 }\n"), "17:15",
       "combination[1].terms.C", "a [[combination]], which has terms of its own",
       "the name of a [[case]]: G"},
      {"a case nearly of this name",
       cases_with("[[case]]\nname = \"crane left\"\nuniform = -1\n[[combination]]\nname = \"C\"\n"
                  "terms = { \"crane lift\" = 1 }\n"),
       "17:26", "combination[1].terms.crane lift", "did you mean \"crane left\"", "crane left"},
      {"a combination without any case", cases_with("[[combination]]\nname = \"C\"\nterms = { G = 1 }\n"),
       "14:15", "combination[1].terms.G", "no [[case]] of this name", "the file has no [[case]]"},
      {"a factor that is text", cases_with(combination + "terms = { G = \"1.5\" }\n"), "17:15",
       "combination[1].terms.G", "\"1.5\"", "a finite number"},
      {"a product beyond doubles",
       cases_with("[[case]]\nname = \"G\"\nuniform = -1e200\n[[combination]]\nname = \"C\"\n"
                  "terms = { G = 1e200 }\n"),
       "15:1", "combination[1]", "not finite", "within the range of double precision"},
      {"a settlement times a factor beyond doubles",
       cases_with("[[case]]\nname = \"G\"\nsettlement = [ { x = 0.0, w = 1e200 } ]\n[[combination]]\n"
                  "name = \"C\"\nterms = { G = 1e200 }\n"),
       "15:1", "combination[1]", "not finite", "within the range of double precision"},
      {"loads in a combination", cases_with(combination + "uniform = 1\n"), "17:1", "combination[1].uniform",
       "unknown", "name, terms"},
      {"a train without axles", cases_with("[[train]]\nname = \"T\"\n" + places), "12:1", "train[1].axles",
       "missing", "at least one"},
      {"an axle without a place", cases_with("[[train]]\nname = \"T\"\naxles = [ { w = 1 } ]\n" + places),
       "14:11", "train[1].axles[1].at", "missing", "a finite number"},
      {"an axle with a moment",
       cases_with("[[train]]\nname = \"T\"\naxles = [ { at = 0, theta = 1 } ]\n" + places), "14:21",
       "train[1].axles[1].theta", "unknown", "at, w"},
      {"a train that does not move", train_with("from = 0\nto = 2\nby = 0\n"), "20:6", "train[1].by", "0",
       "greater than 0"},
      {"a train that goes back", train_with("from = 2\nto = 0\nby = 1\n"), "19:6", "train[1].to", "0",
       "a number of at least 2"},
      {"a train of too many places", train_with("from = 0\nto = 2\nby = 1e-9\n"), "20:6", "train[1].by",
       "1e-09, which makes more than 10000 places", "at most 10000"},
      {"a train and a combination of one name",
       train_with(places) + "[[combination]]\nname = \"T\"\nterms = { G = 1 }\n", "16:8", "train[1].name",
       "\"T\", a second time", "each name once"},
      {"a train on a plate",
       plate_with("[[step]]\n", "[[train]]\nname = \"T\"\naxles = [ { at = 0, w = 1 } ]\n" + places +
                                    "[[case]]\nname = \"G\"\n"),
       "15:1", "train[1]", "a train on a plate", "a [[combination]] for each place"},
  };
}

}  // namespace contct
