// Tests the JSON writer, and the result of a run in JSON.
#include "contct/write/result_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_inputs.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/scratch_folder.hpp"
#include "support/structures.hpp"

using namespace contct;

namespace {

/// Returns a document with a title and an array "steps", to which `write` adds the rest.
template <class Write>
std::string written(Write write) {
  const scratch_folder folder;
  output_file out(folder.at("x.json"));
  json_document document(out, {{"title", "a \"b\"\n"}}, "steps");
  write(document);
  return folder.read("x.json");
}

nlohmann::json json_of(const run_result& r, result_parts parts = result_parts::ends) {
  std::string text;
  output_file out(&text);
  write_result(r, out, parts);
  return nlohmann::json::parse(text);
}

/// Returns the JSON of a run of FORTRAN with C++ in lockstep.
nlohmann::json result_of(const std::string& text) {
  return json_of(a_run(text).result);
}

}  // namespace

TEST_CASE("the JSON writer puts each member and element on a line, indented by depth") {
  const std::string text = written([](json_document& d) {
    d.add({{"s", 0.25}, {"none", nullptr}, {"pairs", nullptr}},
          {{"none", 0, {}}, {"pairs", 2, [](std::size_t i) {
                               return nlohmann::ordered_json{i, 7};
                             }}});
    d.add({{"compact", {1, 2}}}, {});
    d.finish({{"free", nullptr}, {"end", nullptr}}, {{"free", 1, [](std::size_t) {
                                                        return nlohmann::ordered_json{{"a", 1}};
                                                      }}});
  });
  CHECK(
      text ==
      "{\n  \"title\": \"a \\\"b\\\"\\n\",\n  \"steps\": [\n    {\n      \"s\": 0.25,\n      \"none\": [],\n"
      "      \"pairs\": [\n        [0,7],\n        [1,7]\n      ]\n    },\n    {\n      \"compact\": "
      "[1,2]\n    }\n  ],\n  \"free\": [\n    {\"a\":1}\n  ],\n  \"end\": null\n}\n");
}

TEST_CASE("a number written to JSON is read back with the same bits, and NaN is written as null") {
  const double third = 1.0 / 3;
  const auto read = nlohmann::json::parse(written([&](json_document& d) {
    d.add({{"x", third}, {"nan", std::numeric_limits<double>::quiet_NaN()}}, {});
    d.finish({{"end", 1}});
  }));
  CHECK(read["steps"][0]["x"].get<double>() == third);
  CHECK(read["steps"][0]["nan"].is_null());
}

TEST_CASE("an empty array is written to JSON as an opening and a closing bracket on one line") {
  CHECK(written([](json_document& d) {
          d.finish({{"end", 1}});
        }) == "{\n  \"title\": \"a \\\"b\\\"\\n\",\n  \"steps\": [],\n  \"end\": 1\n}\n");
}

TEST_CASE("in JSON, a certificate of a state that is not unique has no displacement error") {
  CHECK(certificate_json({}).is_null());
  certificate c;
  c.certified = true;
  c.displacement_error = 1e-12;
  const auto good = certificate_json(c);
  CHECK(good["displacement_error"] == 1e-12);
  CHECK_FALSE(good.contains("problem"));
  c.unique = false;
  c.problem = "tension";
  const auto other = certificate_json(c);
  CHECK(other["displacement_error"].is_null());
  CHECK(other["shape_error"].is_null());
  CHECK(other["problem"] == "tension");
}

TEST_CASE("the JSON result has the documented keys, with the numbers of a cantilever on a stop (PB1)") {
  const auto r = result_of(good_problem);
  CHECK(r["format"] == "contct-result-1");
  CHECK(r["kernels"] == nlohmann::json({"fortran", "cpp"}));
  CHECK(r["engine"] == "refactor");
  CHECK(r["status"] == "solved");
  CHECK(r["lockstep"]["calls"] == 2);
  CHECK(r["lockstep"]["values_compared"] == 8);
  CHECK(r["lockstep"]["mismatches"] == 0);
  const auto& step = r["steps"][0];
  CHECK(step["fraction"] == 1.0);
  CHECK(step["w"].size() == 3);
  CHECK(step["displacement"].size() == 6);
  CHECK(step["w"][2].get<double>() == Approx(-0.00483720930232558).epsilon(1e-12));
  const auto& pair = step["pairs"][0];
  CHECK(pair["state"] == "contact");
  CHECK(pair["gap"] == 0.0);
  CHECK(pair["force"].get<double>() == Approx(41.8604651162791).epsilon(1e-11));
  const auto& judged = step["certificate"];
  CHECK(judged["exact"] == true);
  CHECK(judged["displacement_error"].get<double>() < 1e-13);
  CHECK(judged["tolerance"].get<double>() <= 1e-6);
  CHECK(judged["penetration"] == 0.0);
  CHECK(judged["tension"] == 0.0);
}

TEST_CASE("an event in the JSON result has pair, node, side and change, and an increment has the load") {
  const auto r = result_of(good_problem);
  const auto& i = r["steps"][0]["increments"][0];
  CHECK(i["increment"] == 1);
  CHECK(i["events"][0] ==
        nlohmann::json({{"pair", 1}, {"node", 3}, {"surface", "below"}, {"change", "make"}}));
  CHECK(i["load"]["point"][0]["node"] == 3);
  CHECK(i["load"]["point"][0]["w"].get<double>() == Approx(-15.0).epsilon(1e-12));
  CHECK(i["load"]["force"].get<double>() == Approx(-15.0).epsilon(1e-12));
  CHECK(i["load"]["moment"].get<double>() == Approx(-30.0).epsilon(1e-12));
  CHECK(i["fraction"].get<double>() == Approx(0.25).epsilon(1e-12));
}

TEST_CASE(
    "in the JSON result, the load of an increment omits distributed loads on more than 32 separate "
    "elements") {
  const auto load_on = [](const std::string& elements) {
    const auto r = result_of(
        "[beam]\nlength = 80\nelements = 80\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", "
        "\"theta\"]\n[[step]]\nuniform = [ { value = -1, elements = " +
        elements + " } ]\n");
    return r["steps"][0]["increments"][0]["load"];
  };
  const auto every_second = [](int count) {
    std::string list = "[";
    for (int i = 0; i < count; ++i) list += std::to_string(2 * i + 1) + ", ";
    return list + "]";
  };
  CHECK(load_on("\"all\"")["uniform"][0]["elements"] == "all");
  CHECK(load_on("\"2..80\"")["uniform"][0]["elements"] == "2..80");
  CHECK(load_on(every_second(32))["uniform"][0]["elements"].size() == 32);
  const auto many = load_on(every_second(33));
  CHECK_FALSE(many.contains("uniform"));
  CHECK(many["force"].get<double>() == Approx(-33.0));
}

TEST_CASE("in the JSON result, loads, contact forces and reactions add up to 0") {
  const auto r = result_of(good_problem);
  const auto& step = r["steps"][0];
  const double pair = step["pairs"][0]["force"];
  CHECK(step["reactions"][0]["dof"] == "w");
  CHECK(step["reactions"][0]["value"].get<double>() + pair - 60.0 == Approx(0.0).margin(1e-10));
  // About the root, the load of 60 and the pair's force have the moment (60 - pair) * 2.
  CHECK(step["reactions"][1]["value"].get<double>() == Approx((60.0 - pair) * 2).epsilon(1e-11));
  CHECK(step["elements"][0]["moment"][0].get<double>() == Approx(-(60.0 - pair) * 2).epsilon(1e-11));
  CHECK(step["elements"][1]["shear"][1].get<double>() == Approx(60.0 - pair).epsilon(1e-11));
}

TEST_CASE(
    "in the JSON result, a separated pair has a gap and no force, and a mechanism has the state that was "
    "reached") {
  const auto r = result_of(
      "[beam]\nx = [0, 1, 2, 3, 4]\nEI = 100\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = "
      "0\nstiffness = 10\n"
      "[[contact]]\nnode = 4\nsurface = \"below\"\nface = 0\nstiffness = 10\n[[step]]\n"
      "point = [ { node = 3, w = -4 } ]\n[[step]]\npoint = [ { node = 3, w = -4 }, { node = 5, w = -6 } ]\n");
  CHECK(r["status"] == "mechanism");
  CHECK(r["end"]["step"] == 2);
  CHECK(r["end"]["pairs"] == nlohmann::json({1}));
  REQUIRE(r["steps"].size() == 2);
  CHECK(r["steps"][1]["fraction"].get<double>() == Approx(2.0 / 3).epsilon(1e-9));
  CHECK(r["steps"][1]["certificate"].is_null());
  CHECK(r["steps"][1]["pairs"][0]["state"] == "separated");
  CHECK(r["steps"][1]["pairs"][0]["force"] == 0.0);
  CHECK(r["steps"][1]["pairs"][1]["force"].get<double>() == Approx(8.0).epsilon(1e-9));
}

TEST_CASE("the JSON result of a plate has slopes and moments, and lists corners counter-clockwise") {
  const auto r = result_of(good_plate);
  CHECK(r["status"] == "solved");
  const auto& step = r["steps"][0];
  CHECK(step["w"].size() == 6);
  CHECK(step["displacement"].size() == 18);
  CHECK(step["w"][5] == step["displacement"][15]);
  REQUIRE(step["elements"].size() == 2);
  for (const char* name : {"mx", "my", "mxy"}) CHECK(step["elements"][1][name].size() == 4);
  // The plate is clamped at its left edge and hogs there, at corners 1 and 4 of element 1.
  const auto& mx = step["elements"][0]["mx"];
  CHECK(mx[0].get<double>() < -0.3);
  CHECK(mx[3].get<double>() < 0.0);
  CHECK(std::abs(mx[1].get<double>()) < std::abs(mx[0].get<double>()));
  const auto& load = r["steps"][0]["increments"].back()["load"];
  CHECK(load["force"].get<double>() == Approx(-1.0 - 2.0 / 2 - 1.0));
  CHECK(load["moment_wx"].get<double>() == Approx(-1.0 * 0.5 - 2.0 / 2 * 0.75 - 1.0 * 1 + 0.25));
  CHECK(load["moment_wy"].get<double>() == Approx(-1.0 * 0.5 - 2.0 / 2 * 0.5 - 0.5));
  CHECK(load["uniform"][1]["elements"] == "2..2");
  CHECK(load["point"][1] == nlohmann::json({{"node", 3}, {"wx", 0.25}}));
  CHECK(step["pairs"][0]["force"].get<double>() > 0.1);
}

TEST_CASE(
    "the JSON result has bounds of contact forces only if there are pairs, and of reactions only with "
    "supports") {
  const auto keys_of = [](const nlohmann::json& result) {
    std::set<std::string> keys;
    for (const auto& [key, value] : result["steps"][0]["error"].items()) keys.insert(key);
    return keys;
  };
  CHECK(keys_of(result_of(good_problem)) ==
        std::set<std::string>{"w", "slope", "force", "gap", "reaction", "moment", "shear"});
  CHECK(keys_of(result_of(propped_cantilever)) ==
        std::set<std::string>{"w", "slope", "reaction", "moment", "shear"});
  CHECK(keys_of(result_of("[beam]\nlength = 2\nelements = 2\nEI = 1e4\n[[bed]]\nmodulus = 10\nface = 0\n"
                          "[[step]]\nuniform = -1\n")) ==
        std::set<std::string>{"w", "slope", "force", "gap", "moment", "shear", "pressure"});
}

TEST_CASE("in the JSON result, an envelope numbers the pairs from 1") {
  a_run r(loaded_and_freed);
  r.result.envelope = true;
  const nlohmann::json envelope_of = json_of(r.result)["envelope"];
  REQUIRE(envelope_of["pairs"].size() == 2);
  CHECK(envelope_of["pairs"][0]["pair"] == 1);
  CHECK(envelope_of["pairs"][1]["pair"] == 2);
}

TEST_CASE(
    "on request, the JSON result has the states within steps, with the keys of the states at the ends of "
    "steps") {
  const a_run r(loaded_and_freed);
  const nlohmann::json result = json_of(r.result, result_parts::states);
  std::size_t within = 0;
  for (const path_moment& m : moments_of(r.result)) {
    if (m.is_end) continue;
    const structure_state f = path_states(r.result).at(m);
    ++within;
    const auto& i = result["steps"][f.step - 1]["increments"][f.number - 1];
    CHECK(i["displacement"] == f.displacement);
    CHECK((i["pairs"][0]["state"] == "contact") == f.closed(0));
    CHECK(i["pairs"][0]["force"] == f.pair_forces[0]);
    CHECK(i["elements"].size() == 2);
    CHECK(i["reactions"].size() == 2);
    CHECK(i["extremes"].contains("moment"));
  }
  CHECK(within >= 2);
  CHECK(result["steps"][0]["load"]["words"] == "w -60 at node 3");
  CHECK_FALSE(result.contains("calls"));
}

TEST_CASE(
    "the JSON result of a large problem has at most four states within steps, and the first is one of them") {
  std::string text =
      "[beam]\nlength = 50\nelements = 5000\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
  for (int i = 1; i <= 20; ++i)
    text += "[[contact]]\nnode = 5001\nsurface = \"below\"\nface = -" + std::to_string(i) +
            "e-6\nstiffness = 10\n";
  const a_run r(text + "[[step]]\npoint = [ { node = 5001, w = -10.0 } ]\n");
  const nlohmann::json all = json_of(r.result, result_parts::states)["steps"][0]["increments"];
  REQUIRE(all.size() > 8);
  CHECK(all[0].contains("displacement"));
  CHECK(std::ranges::count_if(all, [](const auto& i) { return i.contains("displacement"); }) <= 4);
}

TEST_CASE(
    "the data of the report page have every call with the differences in ULPs, and the text of unit 26") {
  const a_run r(good_problem);
  const nlohmann::json result = json_of(r.result, result_parts::report);
  REQUIRE(result["calls"].size() == 2);
  for (const auto& call : result["calls"])
    CHECK(call["followers"] ==
          nlohmann::json::array(
              {{{"values", 4}, {"mismatches", 0}, {"smin_ulps", 0}, {"s_ulps", 0}, {"failed", false}}}));
  CHECK(result["calls"][0]["smin"] == Approx(0.25));
  CHECK(result["calls"][0]["s"] == std::vector<double>{r.result.record.calls[0].smin});
  CHECK(result["calls"][1]["increment"] == 2);
  CHECK(result["calls_made"] == 2);
  CHECK_THAT(result["log"].get<std::string>(), Catch::Matchers::Contains("MAKING CONTACT"));
  CHECK(result["words"]["comparison"] == "all equal");
}

TEST_CASE(
    "The JSON result of a beam with a section modulus has stresses, extreme stresses and an error bound") {
  const nlohmann::json step = result_of(
      "[beam]\nx = [0, 2, 4]\nsection = { E = 1e6, I = 0.5, W = 0.25 }\n"
      "[[support]]\nx = [0, 4]\nfix = \"w\"\n[[step]]\nuniform = -3\n")["steps"][0];
  CHECK(step["elements"][0]["stress"][1].get<double>() == Approx(3.0 * 16 / 8 / 0.25).epsilon(1e-12));
  CHECK(step["extremes"]["stress"]["max"]["value"].get<double>() == Approx(24).epsilon(1e-12));
  CHECK(step["extremes"]["stress"]["max"]["x"].get<double>() == Approx(2));
  CHECK(step["error"]["stress"].get<double>() >= 4 * step["error"]["moment"].get<double>());
  CHECK(step["error"]["stress"].get<double>() < 1e-10);
}

TEST_CASE(
    "The JSON result of a plate with a thickness has stresses at corners, but with D in place of a thickness "
    "none") {
  const nlohmann::json thick = result_of(good_plate)["steps"][0];
  const nlohmann::json& corner = thick["elements"][1];
  CHECK(corner["sx"][2].get<double>() == Approx(6 * corner["mx"][2].get<double>()));
  CHECK(corner["s1"][2].get<double>() >= corner["s2"][2].get<double>());
  CHECK(thick["extremes"]["von_mises"]["max"]["value"].get<double>() >= corner["von_mises"][2].get<double>());
  CHECK(thick["error"]["stress"].is_number());
  const nlohmann::json by_D =
      result_of(plate_with("E = 10.92\nnu = 0.3\nthickness = 1.0", "D = 1.0\nnu = 0.3"))["steps"][0];
  CHECK_FALSE(by_D["elements"][1].contains("sx"));
  CHECK_FALSE(by_D["error"].contains("stress"));
}

TEST_CASE("In the data of the report page, a beam with hinges has the nodes of the hinges") {
  const nlohmann::json s =
      structure_json(parse_problem(good_problem + std::string("[[hinge]]\nnode = 2\n"), "pb.toml"));
  CHECK(s["hinges"] == std::vector<int>{2});
}

TEST_CASE("in the data of the report page, a beam has coordinates, stiffnesses, supports and pairs") {
  const nlohmann::json s = structure_json(parse_problem(good_problem, "pb.toml"));
  CHECK(s["kind"] == "beam");
  CHECK(s["nodes"][2] == nlohmann::json({{"node", 3}, {"x", 2.0}}));
  CHECK(s["EI"] == std::vector<double>{1e4, 1e4});
  CHECK(s["supports"][1] == nlohmann::json({{"node", 1}, {"dof", "theta"}, {"spring", nullptr}}));
  CHECK(s["pairs"][0]["face"] == -0.004);
  CHECK(s["pairs"][0]["state"] == "separated");
  CHECK_FALSE(s["pairs"][0].contains("bed"));
}

TEST_CASE(
    "in the data of the report page, a plate has nodes row by row, and pairs of a bed have tributary areas") {
  problem p = parse_problem(good_plate, "pb.toml");
  p.beds = {{4.0, {0.5}, 0}};
  const nlohmann::json s = structure_json(p);
  CHECK(s["columns"] == 3);
  CHECK(s["nodes"][4] == nlohmann::json({{"node", 5}, {"x", 0.5}, {"y", 1.0}}));
  CHECK(s["pairs"][0]["bed"] == 0.5);
}

TEST_CASE("in the data of the report page, a matrix has labels, and if possible coordinates and edges") {
  const nlohmann::json placed = structure_json(parse_problem(portal_frame(), "p.toml", reach::anywhere));
  CHECK(placed["nodes"].size() == 11);
  CHECK(placed["nodes"][7] == nlohmann::json({{"node", "8"}, {"x", 4.0}, {"y", 3.0}, {"z", 0.0}}));
  CHECK(placed["dofs"][16] == nlohmann::json({{"dof", "6.y"}, {"at", 6}, {"direction", 2}}));
  CHECK(placed["edges"][0] == nlohmann::json({1, 2, 1}));
  CHECK(placed["pairs"][0]["dof"] == "6.y");
  CHECK(placed["notes"] == nlohmann::json({"Rotations (11 of 33 dofs) are not drawn."}));
  CHECK(placed["labels_from"].get<std::string>().ends_with("frame.dof"));
  CHECK(placed["places_from"].get<std::string>().ends_with("frame.xyz"));
  CHECK(placed["matrix_entries"] == 96);  // as the third line of frame.mtx says
  // Of sha256sum.
  CHECK(placed["matrix_sha256"] == "d3a838f2743307120cf55b5fc06b8723f6620ed7020f79981e6fecb9c4aa3eb8");
  const nlohmann::json bare =
      structure_json(parse_problem(frame_without_coordinates(), "p.toml", reach::anywhere));
  CHECK(bare["nodes"].empty());
  CHECK(bare["dofs"][16] == nlohmann::json({{"dof", "6.y"}}));
  CHECK_FALSE(bare.contains("places_from"));
}

TEST_CASE("the data of the report page have the loads of each case without the factors of combinations") {
  const a_run r(
      "[beam]\nlength = 2\nelements = 4\nEI = 1\n[[support]]\nx = [0, 2]\nfix = \"w\"\n"
      "[[case]]\nname = \"G\"\nuniform = -2\n[[case]]\nname = \"Q\"\npoint = [ { x = 1, w = -3 } ]\n"
      "[[combination]]\nname = \"ULS\"\nterms = { G = 1.35, Q = 1.5 }\n");
  const nlohmann::json cases = json_of(r.result, result_parts::report)["cases"];
  REQUIRE(cases.size() == 2);
  CHECK(cases[0]["name"] == "G");
  CHECK(cases[0]["load"]["force"] == -4.0);  // -2 over a length of 2
  CHECK(cases[1]["load"]["point"] == nlohmann::json({{{"node", 3}, {"w", -3.0}}}));
  CHECK_FALSE(json_of(r.result).contains("cases"));
}

TEST_CASE("the report page and JSON warn of a decimal that is replaced") {
  const a_run r(
      "[beam]\nlength = 2\nelements = 4\nEI = 1\n[[support]]\nx = [0, 2]\nfix = \"w\"\n"
      "[[step]]\nuniform = -261502222.2222222222\n");
  CHECK(json_of(r.result)["warnings"].size() == 1);
  CHECK(json_of(r.result, result_parts::report)["warnings"] == json_of(r.result)["warnings"]);
}

TEST_CASE("a result says which distributed load is self-weight, and the resultant force of each bed") {
  const nlohmann::json s = result_of(
      "[beam]\nlength = 2\nelements = 4\nsection = { E = 1e6, I = 1, A = 0.5, weight = 6 }\n"
      "[[bed]]\nmodulus = 100\nface = 0\n[[case]]\nname = \"G\"\nself_weight = true\nuniform = -2\n"
      "[[combination]]\nname = \"G\"\nterms = { G = 2 }\n")["steps"][0];
  const nlohmann::json& loads = s["increments"][0]["load"]["uniform"];
  REQUIRE(loads.size() == 2);
  for (const nlohmann::json& part : loads) {
    CHECK(part["value"] == (part.contains("self_weight") ? -6.0 : -4.0));  // 2 * 6 * 0.5; 2 * 2
  }
  CHECK(loads[0].contains("self_weight") != loads[1].contains("self_weight"));
  CHECK(s["beds"][0]["force"].get<double>() == Approx(20.0).epsilon(1e-12));  // all of the load
}

TEST_CASE(
    "in the JSON result, a combination starts from zero, and all combinations without equilibrium are "
    "listed") {
  const std::string beam =
      "[beam]\nlength = 2\nelements = 2\nEI = 100\n[[contact]]\nx = [0, 2]\nsurface = \"below\"\nface = 0\n"
      "stiffness = 10\n[[case]]\nname = \"down\"\nuniform = -1\n";
  const auto combined = [](const std::string& name, const std::string& factor) {
    return "[[combination]]\nname = \"" + name + "\"\nterms = { down = " + factor + " }\n";
  };
  const nlohmann::json r =
      result_of(beam + combined("up", "-1") + combined("rests", "2") + combined("off", "-3"));
  REQUIRE(r["steps"].size() == 3);
  CHECK(r["steps"][1]["start"] == "zero");
  CHECK(r["steps"][1]["name"] == "rests");
  CHECK(r["steps"][1]["certificate"]["exact"] == true);
  CHECK(r["steps"][0]["certificate"].is_null());
  CHECK(r["status"] == "mechanism");
  CHECK(r["end"]["step"] == 1);
  REQUIRE(r["end"]["others"].size() == 1);
  CHECK(r["end"]["others"][0]["step"] == 3);
  CHECK_FALSE(result_of(good_problem)["steps"][0].contains("start"));
}

TEST_CASE(
    "of many combinations, the report page has only some states, and the largest moment is among them") {
  const a_run r(
      "[beam]\nlength = 200\nelements = 200\nEI = 1e4\n[[support]]\nx = [0, 100, 200]\nfix = \"w\"\n"
      "[[train]]\nname = \"T\"\naxles = [ { at = 0, w = -1 } ]\nfrom = 1\nto = 199\nby = 1\n");
  const nlohmann::json page = json_of(r.result, result_parts::report);
  std::size_t drawn = 0;
  double most = 0.0;
  for (const auto& s : page["steps"]) {
    CHECK(s.contains("displacement") == s.contains("elements"));
    if (!s.contains("displacement")) continue;
    ++drawn;
    most = std::max(most, s["extremes"]["moment"]["max"]["value"].get<double>());
  }
  CHECK(page["steps"].size() == 199);
  CHECK(drawn > 4);
  CHECK(drawn <= 126);
  CHECK(most == Approx(100 * 0.207414).epsilon(2e-4));  // largest moment of two spans under a moving load
}

TEST_CASE("of many combinations, the report page has the largest contact force and reaction of every one") {
  const a_run r(
      "[beam]\nlength = 200\nelements = 200\nEI = 1e4\n[[support]]\nx = [0, 100, 200]\nfix = \"w\"\n"
      "[[contact]]\nx = 50\nsurface = \"below\"\nface = -1e9\nstiffness = 1\n"
      "[[train]]\nname = \"T\"\naxles = [ { at = 0, w = -1 } ]\nfrom = 1\nto = 99\nby = 0.5\n");
  std::size_t left_out = 0;
  const nlohmann::json page = json_of(r.result, result_parts::report);
  for (const auto& s : page["steps"]) {
    left_out += s.contains("displacement") ? 0 : 1;
    const double a = s["train"]["at"].get<double>() / 100;
    // Two equal spans under a force of 1 at the share a of the first span.
    const double largest = std::max(1 - 1.25 * a + a * a * a / 4, 1.5 * a - a * a * a / 2);
    REQUIRE(s["largest"]["reactions"].size() == 1);
    CHECK(s["largest"]["reactions"][0]["value"].get<double>() == Approx(largest));
    CHECK(s["largest"]["pair"]["force"] == 0.0);
  }
  CHECK(left_out > 50);
}

TEST_CASE("in the JSON result, nodes and ends of elements have the coordinates of the problem file") {
  const auto result =
      json_of(a_run("[beam]\nlength = 0.7\nelement_size = 0.1\nEI = 1\n[[support]]\nx = [0, 0.7]\nfix = "
                    "\"w\"\n[[step]]\nuniform = -1\n")
                  .result);
  const std::vector<double> x = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
  REQUIRE(result["nodes"].size() == x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(result["nodes"][i]["node"] == i + 1);
    CHECK(result["nodes"][i]["x"].get<double>() == x[i]);
  }
  CHECK(result["steps"][0]["elements"][3]["x"] == nlohmann::json({0.3, 0.4}));
}

TEST_CASE(
    "in the JSON result, nodes of a plate have x and y, and nodes of a matrix have coordinates if known") {
  const auto result = json_of(a_run(std::string(good_plate)).result);  // 3 by 2 nodes on a square of side 1
  CHECK(result["nodes"][4] == nlohmann::json({{"node", 5}, {"x", 0.5}, {"y", 1.0}}));
  const auto& second = result["steps"][0]["elements"][1];
  CHECK(second["x"] == nlohmann::json({0.5, 1.0, 1.0, 0.5}));
  CHECK(second["y"] == nlohmann::json({0.0, 0.0, 1.0, 1.0}));
  CHECK(json_of(a_run(portal_frame(), "cpp").result)["nodes"][0].contains("z"));
  CHECK_FALSE(json_of(a_run(frame_without_coordinates(), "cpp").result).contains("nodes"));
}

TEST_CASE("the JSON result has the warnings about the problem and about the states") {
  CHECK(result_of(good_problem)["warnings"].empty());
  const auto coarse = result_of(
      "[beam]\nlength = 4\nelements = 2\nEI = 1\n[[bed]]\nmodulus = 4\nface = 0\n[[step]]\nuniform = -1\n");
  REQUIRE_FALSE(coarse["warnings"].empty());  // (4 EI / modulus)^(1/4) is 1
  CHECK_THAT(coarse["warnings"][0].get<std::string>(),
             Catch::Matchers::StartsWith("bed[1]: the mesh is coarse for this bed") &&
                 Catch::Matchers::Contains("0.5"));
  const auto plate = result_of(
      "[plate]\nsize = [1, 1]\nelements = [2, 2]\nE = 1\nnu = 0.3\nthickness = 1\n[[support]]\nnodes = [1, "
      "2, 3, 4, 6, 7, 8, 9]\nfix = \"w\"\n[[step]]\npoint = [ { node = 5, w = -1 } ]\n");
  REQUIRE(plate["warnings"].size() == 1);
  CHECK_THAT(plate["warnings"][0].get<std::string>(), Catch::Matchers::Contains("under a point load"));
}

TEST_CASE(
    "the JSON result of a combination has the factors of the cases, and that of a train also the place") {
  const auto steps = result_of(
      "[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nx = [0, 2]\nfix = \"w\"\n[[case]]\nname = "
      "\"G\"\n"
      "uniform = -1\n[[combination]]\nname = \"a\"\nterms = { G = 1.35 }\n[[train]]\nname = \"T\"\n"
      "axles = [ { at = 0, w = -1 } ]\nfrom = 0.5\nto = 0.5\nby = 1\nterms = { G = 0.9 }\nfactor = 1.5\n")
      ["steps"];
  CHECK(steps[0]["terms"] == nlohmann::json({{"G", 1.35}}));
  CHECK_FALSE(steps[0].contains("train"));
  CHECK(steps[1]["terms"] == nlohmann::json({{"G", 0.9}}));
  CHECK(steps[1]["train"] == nlohmann::json({{"name", "T"}, {"at", 0.5}, {"factor", 1.5}}));
  CHECK_FALSE(result_of(good_problem)["steps"][0].contains("terms"));
}
