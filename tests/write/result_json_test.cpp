// Tests the JSON writer, and the result of a run in JSON.
#include "contct/write/result_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "catch.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/json_parts.hpp"
#include "support/structures.hpp"

using namespace contct;
using nlohmann::json;

namespace {

/// Returns a document with a title and an array "steps", to which `write` adds the rest.
template <class Write>
std::string written(Write write) {
  std::string text;
  output_file out(&text);
  json_document document(out, {{"title", "a \"b\"\n"}}, "steps");
  write(document);
  return text;
}

json json_of(const run_result& r, result_parts parts = result_parts::ends) {
  std::string text;
  output_file out(&text);
  write_result(r, out, parts);
  return json::parse(text);
}

/// Returns the JSON of a run of FORTRAN with C++ in lockstep.
json result_of(const std::string& text, result_parts parts = result_parts::ends) {
  return json_of(a_run(text).result, parts);
}

/// A beam on two supports at its ends, whose steps follow.
const std::string span = "[beam]\nlength = 2\nelements = 4\nEI = 1\n[[support]]\nx = [0, 2]\nfix = 'w'\n";

}  // namespace

TEST_CASE("the JSON writer puts each member and element on a line, indented by depth") {
  const std::string text = written([](json_document& d) {
    d.add({{"s", 0.25},
           {"nan", std::numeric_limits<double>::quiet_NaN()},
           {"none", nullptr},
           {"pairs", nullptr}},
          {{"none", 0, {}}, {"pairs", 2, [](std::size_t i) {
                               return nlohmann::ordered_json{i, 7};
                             }}});
    d.add({{"compact", {1, 2}}}, {});
    d.finish({{"free", nullptr}, {"end", nullptr}}, {{"free", 1, [](std::size_t) {
                                                        return nlohmann::ordered_json{{"a", 1}};
                                                      }}});
  });
  CHECK(text ==
        "{\n  \"title\": \"a \\\"b\\\"\\n\",\n  \"steps\": [\n    {\n      \"s\": 0.25,\n      \"nan\": "
        "null,\n      \"none\": [],\n"
        "      \"pairs\": [\n        [0,7],\n        [1,7]\n      ]\n    },\n    {\n      \"compact\": "
        "[1,2]\n    }\n  ],\n  \"free\": [\n    {\"a\":1}\n  ],\n  \"end\": null\n}\n");
  CHECK(written([](json_document& d) {
          d.finish({{"end", 1}});
        }) == "{\n  \"title\": \"a \\\"b\\\"\\n\",\n  \"steps\": [],\n  \"end\": 1\n}\n");
}

TEST_CASE("in JSON, a certificate has no displacement error without a proof, or if the state is not unique") {
  solved_step s;
  CHECK(certificate_json(s).is_null());
  certificate& c = s.judged.emplace();
  check_like(certificate_json(s), R"({"displacement_error": null, "equilibrium": null, "tension": null})");
  c.certified = c.proved = true;
  c.displacement_error = 1e-12;
  check_like(certificate_json(s), R"({"displacement_error": 1e-12, "problem": "absent"})");
  c.unique = false;
  c.problem = "tension";
  check_like(certificate_json(s),
             R"({"displacement_error": null, "shape_error": null, "problem": "tension"})");
}

TEST_CASE("the JSON result has the documented keys, with the numbers of a cantilever on a stop (PB1)") {
  const json r = result_of(good_problem);
  check_like(r, R"({"format": "contct-result-2", "kernels": ["fortran", "cpp"], "engine": "refactor",
      "status": "solved", "lockstep": {"calls": 2, "values_compared": 8, "mismatches": 0}, "warnings": [],
      "steps": [{ "fraction": 1, "w": [0, -0.00151162790697674, -0.00483720930232558], "displacement": "== 6",
      "pairs": [{"state": "contact", "gap": 0, "force": 41.8604651162791}], "certificate": {"certified": true,
      "displacement_error": "< 1e-13", "tolerance": "<= 1e-6", "penetration": 0, "tension": 0},
      "increments": {"0": {"increment": 1, "fraction": 0.25, "events": [{"pair": 1, "node": 3,
      "surface": "below", "change": "make"}], "load": {"point": [{"node": 3, "w": -15.0}], "force": -15.0,
      "moment": -30.0}}}, "reactions": [{"dof": "w", "value": 18.1395348837209},
      /* 60 - 41.86.., and about the root 2 times as much */ {"dof": "theta", "value": 36.2790697674419}],
      "elements": [{"moment": {"0": -36.2790697674419}}, {"shear": {"1": 18.1395348837209}}],
      "start": "absent", "terms": "absent"}]})",
             1e-12);
}

TEST_CASE("the load of an increment in JSON omits distributed loads on more than 32 separate elements") {
  std::string odd = "1";  // 32 numbers
  for (int i = 3; i < 64; i += 2) odd += ", " + std::to_string(i);
  for (const auto& [elements, load] :
       {std::pair<std::string, std::string>("'all'", R"({"uniform": [{"elements": "all"}]})"),
        {"'2..80'", R"({"uniform": [{"elements": "2..80"}]})"},
        {"[" + odd + "]", R"({"uniform": [{"elements": [)" + odd + "]}]}"},
        {"[" + odd + ", 65]", R"({"uniform": "absent", "force": -33.0})"}})
    check_like(result_of("[beam]\nlength = 80\nelements = 80\nEI = 1\n[[support]]\nnode = 1\n"
                         "fix = ['w', 'theta']\n[[step]]\nuniform = [ { value = -1, elements = " +
                         elements + " } ]\n")["steps"][0]["increments"][0]["load"],
               load);
}

TEST_CASE("in JSON, a separated pair has no force, and a mechanism has the state that was reached") {
  check_like(
      result_of(
          "[beam]\nx = [0, 1, 2, 3, 4]\nEI = 100\n[[contact]]\nnodes = [2, 4]\nsurface = 'below'\nface = 0\n"
          "stiffness = 10\n[[step]]\npoint = [ { node = 3, w = -4 } ]\n"
          "[[step]]\npoint = [ { node = 3, w = -4 }, { node = 5, w = -6 } ]\n"),
      R"({"status": "mechanism", "end": {"step": 2, "pairs": [1]}, "steps": [{}, {"fraction": 0.66666666667, "certificate": null,
      "pairs": [{"state": "separated", "force": 0}, {"force": 8.0}]}]})");
}

TEST_CASE("the JSON result of a plate has slopes, moments and stresses at counter-clockwise corners") {
  const json r = result_of(good_plate);  // 3 by 2 nodes on a square of side 1, clamped at its left edge
  check_like(r, R"({"status": "solved", "nodes": {"4": {"node": 5, "x": 0.5, "y": 1}}, "steps": [{"w": "== 6",
      "displacement": "== 18", "elements": [{"mx": {"0": "< -0.3", "3": "< 0"}}, {"x": [0.5, 1.0, 1.0, 0.5],
      "y": [0, 0, 1.0, 1.0], "mx": "== 4", "my": "== 4", "mxy": "== 4"}],
      "increments": {"1": {"load": {"force": -3.0, "moment_wx": -2.0, "moment_wy": -1.5,
      "uniform": {"1": {"elements": "2..2"}}, "point": {"1": {"node": 3, "wx": 0.25}}}}},
      "pairs": {"0": {"force": "> 0.1"}}, "error": {"stress": "> 0"}}]})");
  const json& step = r["steps"][0];
  CHECK(step["w"][5] == step["displacement"][15]);
  const json& mx = step["elements"][0]["mx"];
  CHECK(std::abs(mx[1].get<double>()) < std::abs(mx[0].get<double>()));
  const json& corner = step["elements"][1];
  CHECK(corner["sx"][2].get<double>() == Approx(6 * corner["mx"][2].get<double>()));
  CHECK(corner["s1"][2].get<double>() >= corner["s2"][2].get<double>());
  CHECK(step["extremes"]["von_mises"]["max"]["value"].get<double>() >= corner["von_mises"][2].get<double>());
  // Without a thickness there are no stresses.
  check_like(result_of(plate_with("E = 10.92\nnu = 0.3\nthickness = 1.0", "D = 1.0\nnu = 0.3"))["steps"][0],
             R"({"elements": [{}, {"sx": "absent"}], "error": {"stress": "absent"}})");
}

TEST_CASE("the JSON result has bounds of contact forces only with pairs, of reactions only with supports") {
  for (const auto& [text, keys] :
       {std::pair<std::string, std::set<std::string>>(
            good_problem, {"w", "slope", "force", "gap", "reaction", "moment", "shear"}),
        {propped_cantilever, {"w", "slope", "reaction", "moment", "shear"}},
        {"[beam]\nlength = 2\nelements = 2\nEI = 1e4\n[[bed]]\nmodulus = 9\nface = 0\n[[step]]\nuniform = "
         "-1\n",
         {"w", "slope", "force", "gap", "moment", "shear", "pressure"}}}) {
    std::set<std::string> found;
    const json result = result_of(text);
    for (const auto& [key, value] : result["steps"][0]["error"].items()) found.insert(key);
    CHECK(found == keys);
  }
}

TEST_CASE("on request, the JSON result has an envelope, and the states within steps like those at ends") {
  a_run r(loaded_and_freed);
  r.result.envelope = true;
  check_like(json_of(r.result)["envelope"], R"({"pairs": [{"pair": 1}, {"pair": 2}]})");
  const json result = json_of(r.result, result_parts::states);
  std::size_t within = 0;
  for (const path_moment& m : moments_of(r.result)) {
    if (m.is_end) continue;
    const structure_state f = path_states(r.result).at(m);
    ++within;
    const json& i = result["steps"][f.step - 1]["increments"][f.number - 1];
    CHECK(i["displacement"] == f.displacement);
    CHECK(i["pairs"][0]["force"] == f.numbers.pair_forces[0]);
    CHECK((i["pairs"][0]["state"] == "contact") == f.closed(0));
    check_like(i, R"({"elements": [{}, {}], "reactions": [{}, {}], "extremes": {"moment": {}}})");
  }
  CHECK(within >= 2);
  check_like(result, R"({"steps": {"0": {"load": {"words": "w -60 at node 3"}}}, "calls": "absent"})");
}

TEST_CASE("the JSON result of a large problem has at most four states within steps, with the first") {
  std::string text =
      "[beam]\nlength = 50\nelements = 2000\nEI = 1e4\n[[support]]\nnode = 1\nfix = ['w', 'theta']\n";
  for (int i = 1; i <= 20; ++i)
    text += fmt::format("[[contact]]\nnode = 2001\nsurface = 'below'\nface = -{}e-6\nstiffness = 10\n", i);
  const json all = result_of(text + "[[step]]\npoint = [ { node = 2001, w = -10.0 } ]\n",
                             result_parts::states)["steps"][0]["increments"];
  REQUIRE(all.size() > 8);
  CHECK(all[0].contains("displacement"));
  CHECK(std::ranges::count_if(all, [](const auto& i) { return i.contains("displacement"); }) <= 4);
}

TEST_CASE("the data of the report page have every call with differences in ULPs, and unit 26") {
  const a_run r(good_problem);
  const json result = json_of(r.result, result_parts::report);
  const std::string followers =
      R"("followers": [{"values": 4, "mismatches": 0, "smin_ulps": 0, "s_ulps": 0, "failed": false}])";
  check_like(result,
             R"({"calls": [{"smin": 0.25, )" + followers + R"(}, {"increment": 2, )" + followers + R"(}],
    "calls_made": 2, "log": "~MAKING CONTACT", "words": {"comparison": "all equal"}})");
  CHECK(result["calls"][0]["s"] == std::vector<double>{r.result.record.calls[0].smin});
}

TEST_CASE("the JSON result of a beam with a section modulus has stresses with an error bound") {
  const json step = result_of(
      "[beam]\nx = [0, 2, 4]\nsection = { E = 1e6, I = 0.5, W = 0.25 }\n"
      "[[support]]\nx = [0, 4]\nfix = 'w'\n[[step]]\nuniform = -3\n")["steps"][0];
  check_like(step, R"({"elements": {"0": {"stress": {"1": 24.0 /* q L^2 / 8 W */}}},
      "error": {"stress": "< 1e-10"}, "extremes": {"stress": {"max": {"value": 24.0, "x": 2.0}}}})",
             1e-12);
  CHECK(step["error"]["stress"].get<double>() >= 4 * step["error"]["moment"].get<double>());
}

TEST_CASE("in the data of the report page, a structure has nodes, stiffnesses, supports, pairs and hinges") {
  check_like(structure_json(parsed(good_problem + std::string("[[hinge]]\nnode = 2\nstiffness = 7\n"))),
             R"({"kind": "beam", "hinges": [2], "hinge_stiffness": [7],
    "nodes": {"2": {"node": 3, "x": 2}}, "EI": [1e4, 1e4], "supports": {"1": {"node": 1, "dof": "theta", "spring": null}},
    "pairs": {"0": {"face": -0.004, "state": "separated", "bed": "absent"}}})");
  problem plate = parsed(good_plate);
  plate.beds = {{4.0, {0.5}, 0}};
  check_like(structure_json(plate), R"({"columns": 3, "nodes": {"4": {"node": 5, "x": 0.5, "y": 1}},
      "pairs": {"0": {"bed": 0.5}}})");
}

TEST_CASE("in JSON, also of the report page, a matrix has labels, and if possible coordinates and edges") {
  const json placed = structure_json(parsed(portal_frame()));
  // The entries are those of the third line of frame.mtx, and the checksum is of sha256sum.
  check_like(placed, R"({"nodes": {"7": {"node": "8", "x": 4, "y": 3, "z": 0}}, "dofs": {"16": {"dof": "6.y",
      "at": 6, "direction": 2}}, "edges": {"0": [1, 2, 1]}, "pairs": {"0": {"dof": "6.y"}},
      "notes": ["Rotations (11 of 33 dofs) are not drawn."], "labels_from": "~/frame.dof",
      "places_from": "~/frame.xyz", "matrix_entries": 96,
      "matrix_sha256": "d3a838f2743307120cf55b5fc06b8723f6620ed7020f79981e6fecb9c4aa3eb8"})");
  CHECK(placed["nodes"].size() == 11);
  const json bare = structure_json(parsed(frame_without_coordinates()));
  check_like(bare, R"({"nodes": [], "places_from": "absent"})");
  CHECK(bare["dofs"][16] == json({{"dof", "6.y"}}));
  const json result = json_of(a_run(portal_frame(), "cpp").result);
  const std::string pair = R"("pair": 1, "dof": "6.y", "surface": "below", "node": "absent")";
  check_like(result, R"({"nodes": {"0": {"z": 0}}, "steps": {"0": {"w": "== 33", "pairs": {"0": {)" + pair +
                         R"(}}, "reactions": {"5": {"dof": "9.r", "node": "absent"}},
      "increments": {"0": {"load": {"point": [{"dof": "6.y", "node": "absent"}]}, "events": [{)" +
                         pair + R"(}]}}}}})");
  CHECK(result["steps"][0]["w"] == result["steps"][0]["displacement"]);
  CHECK_FALSE(json_of(a_run(frame_without_coordinates(), "cpp").result).contains("nodes"));
}

TEST_CASE("the data of the report page have the loads of each case without the factors of combinations") {
  const a_run r(span +
                "[[case]]\nname = 'G'\nuniform = -2\n[[case]]\nname = 'Q'\npoint = [ { x = 1, w = -3 } ]\n"
                "[[combination]]\nname = 'ULS'\nterms = { G = 1.35, Q = 1.5 }\n");
  check_like(json_of(r.result, result_parts::report)["cases"], R"([{"name": "G",
      "load": {"force": -4 /* -2 over a length of 2 */}}, {"load": {"point": [{"node": 3, "w": -3}]}}])");
  CHECK_FALSE(json_of(r.result).contains("cases"));
}

TEST_CASE("the JSON result and the report page have the warnings about the problem and about the states") {
  for (const auto& [text, warning] :
       {std::pair(span + "[[step]]\nuniform = -261502222.2222222222\n", "~261502222"),
        {"[beam]\nlength = 4\nelements = 2\nEI = 1\n[[support]]\nnode = 3\nfix = 'w'\n[[bed]]\n"
         "nodes = [1, 2]\nmodulus = 4\nface = 0\n[[step]]\nuniform = -1\n",
         "~bed[1]: the bed acts to x = 3"},
        {"[plate]\nsize = [1, 1]\nelements = [2, 2]\nE = 100\nnu = 0.3\nthickness = 1\n[[support]]\n"
         "nodes = [1, 2, 3, 4, 6, 7, 8, 9]\nfix = 'w'\n[[step]]\npoint = [ { node = 5, w = -1 } ]\n",
         "~under a point load"}}) {
    const json warnings = result_of(text)["warnings"];
    check_like(warnings, {{"0", warning}});
    CHECK(result_of(text, result_parts::report)["warnings"] == warnings);
  }
}

TEST_CASE("a result says which distributed load is self-weight, and the resultant force of each bed") {
  check_like(
      result_of("[beam]\nlength = 2\nelements = 4\nsection = { E = 1e6, I = 1, A = 0.5, weight = 6 }\n"
                "[[bed]]\nmodulus = 100\nface = 0\n[[case]]\nname = 'G'\nself_weight = true\nuniform = -2\n"
                "[[combination]]\nname = 'G'\nterms = { G = 2 }\n")["steps"][0],
      R"({"beds": [{"force": 20.0 /* all of the load */}],
      "increments": {"0": {"load": {"uniform": [{"value": -4, "self_weight": "absent"}, {"value": -6, "self_weight": true}]}}}})",
      1e-12);
}

TEST_CASE("in JSON, a combination starts from zero, with the factors of cases and the place of a train") {
  const std::string beam =
      "[beam]\nlength = 2\nelements = 2\nEI = 100\n[[contact]]\nx = [0, 2]\nsurface = 'below'\nface = 0\n"
      "stiffness = 10\n[[case]]\nname = 'down'\nuniform = -1\n";
  const auto combined = [](const std::string& name, const std::string& factor) {
    return "[[combination]]\nname = '" + name + "'\nterms = { down = " + factor + " }\n";
  };
  check_like(
      result_of(beam + combined("up", "-1") + combined("rests", "2") + combined("off", "-3")),
      R"({"status": "mechanism", "end": {"step": 1, "others": [{"step": 3}]}, "steps": [{"certificate": null, "train": "absent"},
       {"start": "zero", "name": "rests", "certificate": {"certified": true}, "terms": {"down": 2}}, {}]})");
  check_like(
      result_of(span +
                "[[case]]\nname = 'G'\nuniform = -1\n[[train]]\nname = 'T'\naxles = [ { at = 0, w = -1 } ]\n"
                "from = 0.5\nto = 0.5\nby = 1\nterms = { G = 0.9 }\nfactor = 1.5\n")["steps"],
      R"([{"terms": {"G": 0.9}, "train": {"name": "T", "at": 0.5, "factor": 1.5}}])");
}

TEST_CASE("of many combinations, the report page has some states, and all extreme values") {
  const json steps = result_of(
      "[beam]\nlength = 200\nelements = 200\nEI = 1e4\n[[support]]\nx = [0, 100, 200]\nfix = 'w'\n"
      "[[contact]]\nx = 50\nsurface = 'below'\nface = -1e9\nstiffness = 1\n[[train]]\nname = 'T'\n"
      "axles = [ { at = 0, w = -1 } ]\nfrom = 1\nto = 99\nby = 0.5\n",
      result_parts::report)["steps"];
  std::size_t drawn = 0;
  double most = 0.0;
  for (const json& s : steps) {
    const double a = s["train"]["at"].get<double>() / 100;
    // Two equal spans under a force of 1 at the share a of the first span.
    const double largest = std::max(1 - 1.25 * a + a * a * a / 4, 1.5 * a - a * a * a / 2);
    check_like(s["largest"], {{"reactions", {{{"value", largest}}}}, {"pair", {{"force", 0}}}}, 1e-6);
    CHECK(s.contains("displacement") == s.contains("elements"));
    if (!s.contains("displacement")) continue;
    ++drawn;
    most = std::max(most, s["extremes"]["moment"]["max"]["value"].get<double>());
  }
  CHECK(steps.size() == 197);
  CHECK((drawn > 4 && drawn <= 126));
  CHECK(most == Approx(100 * 0.207414).epsilon(2e-4));  // largest moment of two spans under a moving load
}

TEST_CASE("in the JSON result, nodes and ends of elements have the coordinates of the problem file") {
  check_like(result_of("[beam]\nlength = 0.7\nelement_size = 0.1\nEI = 1\n[[support]]\nx = [0, 0.7]\n"
                       "fix = 'w'\n[[step]]\nuniform = -1\n"),
             R"({"nodes": {"3": {"x": 0.3}, "6": {"x": 0.6}, "7": {"node": 8, "x": 0.7}},
      "steps": [{"elements": {"3": {"x": [0.3, 0.4]}}}]})",
             0.0);
}
