// Tests the text and the JSON of explained runs and exact paths, and proof files. tests/app/commands_test.cpp
// tests whole texts of the program.
#include "contct/write/explain.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/proof/exact_means.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/result_json.hpp"
#include "support/a_run.hpp"
#include "support/json_parts.hpp"
#include "support/words.hpp"

using namespace contct;
using nlohmann::json;

namespace {

/// A cantilever whose tip reaches its stop at a quarter of the load, with another pair at the clamped node.
const std::string two_pairs =
    "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = ['w', 'theta']\n[[contact]]\nnode = 2\n"
    "surface = 'below'\nface = -0.25\nstiffness = 1\n[[contact]]\nnode = 1\nsurface = 'below'\nface = -1\n"
    "stiffness = 1\n[[step]]\npoint = [ { node = 2, w = -3 } ]\n";

/// What is written about a path of FORTRAN with C++ as the second kernel.
struct explained {
  std::string text;
  json document;
};

struct asked {
  int pair = 0, width = 80;
  bool all = true;
  std::optional<mismatch> apart = {};  ///< a difference that is put into each increment
  observer* first = nullptr;           ///< receives each call before the explanation
};

explained explain(const problem& p, const asked& a = {}) {
  const explained_kernels of{p, {"fortran", "cpp"}, 8, a.pair};
  std::string written;
  std::string told;
  output_file out(&written);
  explain_json to_json(of, out);
  explain_text to_text(of, {a.width, false}, a.all);
  const auto leader = make_kernel("fortran");
  const std::string second[] = {"cpp"};
  explained_path path(leader->facts(), second, {}, [&](explained_increment i) {
    if (a.apart) i.apart = a.apart;
    to_json.write(i);
    told += to_text.add(i);
  });
  std::vector<observer*> watching = {&path};
  if (a.first != nullptr) watching.insert(watching.begin(), a.first);
  (void)follow(p, structure_of(p), "refactor", *leader, watching);
  to_json.finish("solved", path);
  return {told + to_text.finish(), json::parse(written)};
}

/// Returns `two_pairs` with `steps` more steps, each with one increment and no event.
std::string two_pairs_and(int steps) {
  std::string toml = two_pairs;
  for (int i = 0; i < steps; ++i) toml += "[[step]]\npoint = [ { node = 2, w = -3 } ]\n";
  return toml;
}

/// Returns what is written about an exact path.
explained follow_exactly(const problem& p, const std::vector<kernel_digits>& kernels = {}, int digits = 20) {
  const exact_problem exactly = exact_problem_of(p);
  const exact_path path = follow_corrected_path(exactly);
  const exact_run result{p, exactly, path, kernels};
  std::string written;
  output_file out(&written);
  write_exact_json(result, out);
  return {exact_text(result, digits, {}), json::parse(written)};
}

problem reference(const std::string& name) {
  return read_problem(CONTCT_REFERENCE "/problems/" + name + ".toml");
}

/// Returns the proof file of a path under the corrected rule.
json proof_of(const std::string& text) {
  const problem p = parsed(text);
  const linear_structure s = structure_of(p);
  certifier proof(p, s, exact_means_of(p), true);
  run_result r(p, s);
  r.take(follow(p, s, "refactor", *make_kernel("corrected"), {}, &proof));
  return json::parse(proof_json(r));
}

}  // namespace

TEST_CASE("the JSON explanation has s, load, winner, and each pair with branches, lines and equations") {
  const json j = explain(parsed(two_pairs)).document;
  check_like(j, R"({"format": "contct-explain-1", "real_bytes": 8, "kernels": ["fortran", "cpp"],
      "status": "solved", "lockstep": {"mismatches": 0, "calls": 2}, "increments": [ {"s": 0.25,
      /* d* = -1, and the gap is 0.25 */ "load": {"force": -0.75}, "winner": {"pair": 1}, "apart": "absent",
      "narrowest": {"if": "> 0", "outcome": true, "ulps": 0}, "pairs": [ {"before": "separated",
      "after": "contact", "why": "winner", "bits": {"ulps": 0}, "story": {"3": {"equation": "~(4"}},
      "branches": {"0": {"if": "DTEST(NDOF).EQ.0.", "outcome": false}}}, {"node": 1, "kind": "no response",
      "toggled": false, "why": "not toggled", "distance_from_face": "absent"}]}, {"winner": null,
      "pairs": {"0": {"kind": "stationary"}}}]})");
  const json& pairs = j["increments"][0]["pairs"];
  CHECK(pairs[0]["bits"]["fortran"] == pairs[0]["bits"]["cpp"]);
  const auto lines_of = [](const json& story) {  // 0 for a sentence without a line of the listing
    std::vector<int> lines;
    for (const json& sentence : story) lines.push_back(sentence.value("line", 0));
    return lines;
  };
  CHECK(lines_of(pairs[0]["story"]) == std::vector<int>{30, 31, 33, 38, 40, 51, 52, 54, 55});
  CHECK(lines_of(pairs[1]["story"]) == std::vector<int>{30, 31, 32, 40, 51, 52});
  CHECK(lines_of(j["increments"][0]["story"]) == std::vector<int>{42, 0});
  CHECK(lines_of(j["increments"][1]["story"]) == std::vector<int>{42, 43, 45});
  const json only = explain(parsed(two_pairs), {.pair = 2}).document;
  check_like(only["increments"], R"([{"pairs": [{"pair": 2}]}, {"pairs": [{"pair": 2}]}])");
}

TEST_CASE("numbers of two kernels are equal to the bit, some ULPs apart, or different if one is NaN") {
  const double next = std::nextafter(0.25, 1.0);
  const problem p = parsed(two_pairs);
  const explained_kernels of{p, {"a", "b"}, 8, 0};
  CHECK(side_by_side_words(of, 0.25, 0.25) == "a and b are equal to the bit");
  CHECK(side_by_side_words(of, 0.25, next) == "a and b are 1 ULP apart");
  CHECK(side_by_side_words(of, 0.25, std::numeric_limits<double>::quiet_NaN()) ==
        "a and b are different: one is NaN");
  CHECK(ulps_apart(0.25, next, 8) == 1);
  CHECK(ulps_apart(0.25, std::nextafter(0.25F, 1.0F), 4) == 1);
}

TEST_CASE("contct explain prints one line for each of more than 20 increments, unless --all is given") {
  const auto few = parsed(two_pairs_and(18));
  CHECK(explain(few, {.all = false}).text == explain(few).text);
  check_words(explain(few).text, {"Step 19, increment 1\n"});
  const auto many = parsed(two_pairs_and(19));
  check_words(explain(many, {.all = false}).text,
              {"^  incr  share      events\n   1.1  0.25       make 1\n   1.2  1          no event\n",
               "\n  20.1  1          no event\n\n21 increments", "--all", "!Step"});
  check_words(explain(many).text, {"Step 20, increment 1\n", "!--all"});
}

TEST_CASE("the short explanation names early toggles, and shortens a list of more than twelve events") {
  std::string toml = "title = 'Stops'\n" + two_pairs_and(20);
  for (int i = 0; i < 14; ++i)
    toml += std::string("[[contact]]\nnode = 2\nsurface = 'below'\nstiffness = 1\nface = ") +
            (i < 13 ? "-0.25\n" : "-0.2501\n");
  check_words(explain(parsed(toml), {.width = 60, .all = false}).text,
              {"^Stops\n  incr  share      events\n   1.1  0.25       make 1, make 3",
               "\n                   make 7", "make 13, 3 more; too early: 16\n"});
}

TEST_CASE("the explanation says if a pair reaches its face exactly at full load, without an event") {
  problem p = parsed(two_pairs);
  p.pairs[0].face = -10.0;
  struct last_end final : observer {
    std::vector<double> u;
    void called(const answered_call& c) override { u.assign(c.c.dtest.begin(), c.c.dtest.end()); }
  } keeps;
  (void)explain(p, {.first = &keeps});
  p.pairs[0].face = keeps.u.at(2);  // exactly where the tip is at full load
  check_words(explain(p, {.width = 100}).text,
              {"Exactly at the full load: the listing treats this as no event."});
  check_words(explain(parsed(two_pairs), {.width = 100}).text, {"!Exactly at the full load"});
}

TEST_CASE("if two kernels differ, the explanation gives the second value, or the whole line of text") {
  const explained by_text =
      explain(parsed(two_pairs), {.width = 100, .apart = mismatch{"text", 3, "one", "two", 0}});
  check_words(by_text.text, {R"(Unit 26, line 3: fortran wrote "one", cpp wrote "two")"});
  CHECK(by_text.document["increments"][0]["apart"] ==
        json({{"field", "text"}, {"index", 3}, {"fortran", "one"}, {"cpp", "two"}}));
  const explained by_smin =
      explain(parsed(two_pairs), {.width = 100, .apart = mismatch{"SMIN", 0, "0x1p-2", "0x1p-1", 5}});
  check_words(by_smin.text, {"!Unit 26, line"});
  CHECK(by_smin.document["increments"][0]["apart"] ==
        json({{"field", "SMIN"}, {"index", 0}, {"fortran", "0x1p-2"}, {"cpp", "0x1p-1"}}));
}

TEST_CASE("the printed exact path has every event with its exact share and load, and exact states") {
  check_words(
      follow_exactly(reference("pb07-three-gap-supports")).text,
      {"\nstep 2\n  share 3/38, load -2400/19: pair 1 (node 5, below) makes contact, "
       "pair 3 (node 13, below) makes contact\n  share 1, load -200\n",
       "  largest w -1664/160625 at node 9\n", "  pair 1 (node 5, below): w -927/128500, force 31200/257\n",
       "  pair 2 (node 9, below): w -2/375, gap 7/1500\n"});
  // Long fractions are decimals, and many pairs are only counted.
  check_words(follow_exactly(reference("pb03a-point-load-on-bed-l4"), {}, 6).text,
              {" of 41 pairs in contact\n", "!/"});
}

TEST_CASE("the printed exact path has the correct digits and the first different event of each kernel") {
  const explained run = follow_exactly(reference("pb01-cantilever-tip-stop"),
                                       {{"fortran", true, "", 15.4, 15.1, 14.0, 2},
                                        {"mine", false, "exactly, so; here otherwise", 3, 2, 1, 1},
                                        {"early", false, "the path ends early", 16, 16, 16, 0}});
  check_words(run.text,
              {"\nfortran: 15.4 digits of displacements, 14.0 of forces, 15.1 of the events' shares; "
               "the same events\n",
               "other events: exactly, so; here otherwise\n",
               "\nearly: no end of a step to compare; other events: the path ends early\n"});
  check_like(run.document["kernels"], R"([{"name": "fortran", "same_events": true, "first_difference": null,
      "digits": 15.4, "event_digits": 15.1, "force_digits": 14},
      {"first_difference": "exactly, so; here otherwise", "digits": 3}, {"digits": null,
      "force_digits": null}])");
}

TEST_CASE("the JSON output of an exact path has every number as a fraction") {
  check_like(follow_exactly(reference("pb01-cantilever-tip-stop")).document, R"({"format": "contct-exact-1",
      "status": "solved", "kernels": [], "mechanism": "absent", "steps": {"1": {"step": 2,
      "increments": [ {"increment": 1, "fraction": "1/10", "events": [{"pair": 1, "node": 3,
      "surface": "below", "change": "make"}]}, {"increment": 2, "fraction": "1", "events": []}],
      "displacement": ["0", "0", "-13/8600", "-117/43000", "-26/5375", "-39/10750"], "w": ["0", "-13/8600",
      "-26/5375"], "pairs": [{"pair": 1, "node": 3, "surface": "below", "state": "contact", "gap": "0",
      "force": "1800/43"}], "reactions": {"1": {"node": 1, "dof": "theta", "value": "1560/43"}}}}})");
}

TEST_CASE("if an exact path ends in a mechanism, the output has the rigid-body motion and the work on it") {
  const explained run = follow_exactly(
      parsed("[beam]\nx = [0, 1, 2]\nEI = 1\n[[contact]]\nnode = 1\nsurface = 'below'\nface = -1\n"
             "stiffness = 1\n[[step]]\npoint = [ { node = 2, w = -2 } ]\n"));
  check_words(run.text, {"share 0, load 0: a rigid-body motion at constant load\n",
                         "\nno equilibrium: ", "the step's full load does work 1 on it.\n  w 0, -1/2, -1\n"});
  check_like(run.document, R"({"status": "mechanism", "steps": {"0": {"fraction": "0",
      "increments": {"0": {"snap": true}}}}, "mechanism": {"motion": ["0", "-1/2", "-1/2", "-1/2", "-1",
      "-1/2"], "work": "1"}})");
}

TEST_CASE("a proof file has state, pairs in contact, factor and error bounds of each step") {
  const json proof = proof_of(
      "[beam]\nlength = 4\nelements = 4\nEI = 1e4\n[[support]]\nnodes = [1, 5]\nfix = 'w'\n"
      "[[contact]]\nnode = 3\nsurface = 'below'\nface = -1e-4\nstiffness = 1e5\n[[step]]\nuniform = "
      "-10\n[[step]]\nuniform = 0\n");
  check_like(proof, R"({"format": "contct-proof-2", "steps": [ {"step": 1, "certified": true, "closed": [1],
      "error": {"w": "< 1e-15"}, "state": ["contact"], "shift": "> 0"}, {"step": 2, "closed": [], "z": [],
      "state": ["separated"]}]})");
  const auto sizes = [](const json& step, const std::vector<std::string>& keys) {
    std::vector<std::size_t> all;
    for (const std::string& key : keys) all.push_back(step[key].size());
    return all;
  };
  const json& loaded = proof["steps"][0];
  CHECK(sizes(loaded, {"displacement", "u", "z", "scale", "row_of", "L", "force", "reactions", "elements"}) ==
        std::vector<std::size_t>{10, 10, 10, 10, 10, 10, 1, 2, 16});
  CHECK((loaded["L"][0].size() == 1 && loaded["L"][9].size() == 4));
  CHECK(proof["steps"][1]["L"].size() == 10);
}

TEST_CASE("if doubles cannot factor a matrix, the proof file has the factor L as a sum of two matrices") {
  const json step = proof_of(
      "[beam]\nx = [0, 0.008, 7.008, 7.00802, 7.02802, 12.02802]\nEI = 92\n[[support]]\nnode = 1\n"
      "fix = ['w', 'theta']\n[[contact]]\nnode = 2\nsurface = 'below'\nface = 0\nstiffness = 1e5\n"
      "[[step]]\npoint = [ { node = 2, w = -94 } ]\n")["steps"][0];
  REQUIRE(step.contains("L_low"));
  CHECK(step["L_low"].size() == step["L"].size());
  CHECK(step["L_low"][11].size() == step["L"][11].size());
}

TEST_CASE("a proof file has the reason for missing bounds, and of a free beam without load only forces") {
  const auto free_beam = [](const std::string& nodes, const std::string& steps) {
    return "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[contact]]\nnodes = " + nodes +
           "\nsurface = 'below'\nface = 0\nstiffness = 1e6\n" + steps;
  };
  check_like(
      proof_of(free_beam("[1, 2]",
                         "[[step]]\npoint = [ { node = 2, w = -1 } ]\n"))["steps"][0],  // node 1 is not held
      R"({"error": null, "because": "> 0", "L": "absent"})");
  check_like(
      proof_of(free_beam("[1, 3]", "[[step]]\nuniform = -1\n[[step]]\nuniform = 0\n"))["steps"][1],
      R"({"error": {"w": null}, "force": "== 2", "displacement": "absent", "state": "absent", "u": "absent", "L": "absent"})");
}
