// Tests that a proof file has all data that its checker needs, or the reason for missing bounds.
#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/kernel/call.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/write/result_json.hpp"

using namespace contct;

namespace {

/// Returns the proof file of a path under the corrected rule.
nlohmann::json proof_of(const std::string& text) {
  const problem p = parse_problem(text, "b.toml");
  const linear_structure s = structure_of(p);
  certifier judged(p, s, contct::exact_means_of(p));
  judged.keep_proofs();
  const auto k = make_kernel("corrected");
  (void)follow(p, s, "refactor", *k, {&judged}, {0, judged.ends()});
  return nlohmann::json::parse(proof_json(p, judged));
}

constexpr const char* stopped_beam =
    "[beam]\nlength = 4\nelements = 4\nEI = 1e4\n[[support]]\nnodes = [1, 5]\nfix = \"w\"\n"
    "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -1e-4\nstiffness = 1e5\n"
    "[[step]]\nuniform = -10\n[[step]]\nuniform = 0\n";

}  // namespace

TEST_CASE("a proof file has state, pairs in contact, factor and error bounds of each step") {
  const nlohmann::json proof = proof_of(stopped_beam);
  CHECK(proof["format"] == "contct-proof-2");
  REQUIRE(proof["steps"].size() == 2);
  CHECK(proof["steps"][0]["step"] == 1);
  CHECK(proof["steps"][1]["step"] == 2);
  const nlohmann::json& loaded = proof["steps"][0];
  CHECK(loaded["certified"] == true);
  CHECK(loaded["closed"] == nlohmann::json::array({1}));
  CHECK(loaded["error"]["w"].get<double>() < 1e-15);
  for (const char* each_dof : {"displacement", "u", "z", "scale", "row_of", "L"})
    CHECK(loaded[each_dof].size() == 10);
  CHECK(loaded["force"].size() == 1);
  CHECK(loaded["state"] == nlohmann::json::array({"contact"}));
  CHECK(loaded["reactions"].size() == 2);
  CHECK(loaded["elements"].size() == 16);
  CHECK(loaded["L"][0].size() == 1);
  CHECK(loaded["L"][9].size() == 4);
  CHECK(loaded["shift"].get<double>() > 0.0);
  const nlohmann::json& unloaded = proof["steps"][1];
  CHECK(unloaded["closed"].empty());
  CHECK(unloaded["z"].empty());
  CHECK(unloaded["L"].size() == 10);
  CHECK(unloaded["state"] == nlohmann::json::array({"separated"}));
}

TEST_CASE("if doubles cannot factor a matrix, the proof file has the factor L as a sum of two matrices") {
  const nlohmann::json proof = proof_of(
      "[beam]\nx = [0, 0.008, 7.008, 7.00802, 7.02802, 12.02802]\nEI = 92\n[[support]]\nnode = 1\n"
      "fix = [\"w\", \"theta\"]\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = 0\nstiffness = 1e5\n"
      "[[step]]\npoint = [ { node = 2, w = -94 } ]\n");
  const nlohmann::json& step = proof["steps"][0];
  REQUIRE(step.contains("L_low"));
  CHECK(step["L_low"].size() == step["L"].size());
  CHECK(step["L_low"][11].size() == step["L"][11].size());
}

TEST_CASE("if a step has no error bounds, the proof file gives the reason") {
  const nlohmann::json proof = proof_of(
      "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[contact]]\nnodes = [1, 2]\nsurface = \"below\"\nface = 0\n"
      "stiffness = 1e6\n[[step]]\npoint = [ { node = 2, w = -1 } ]\n");  // node 1 is not held
  const nlohmann::json& step = proof["steps"][0];
  CHECK(step["error"].is_null());
  CHECK_FALSE(step["because"].get<std::string>().empty());
  CHECK_FALSE(step.contains("L"));
}

TEST_CASE("for a free beam without load, a proof file has forces, but no displacements and no statuses") {
  const nlohmann::json proof = proof_of(
      "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[contact]]\nnodes = [1, 3]\nsurface = \"below\"\nface = 0\n"
      "stiffness = 1e6\n[[step]]\nuniform = -1\n[[step]]\nuniform = 0\n");
  const nlohmann::json& step = proof["steps"][1];
  CHECK(step["error"]["w"].is_null());
  CHECK(step["force"].size() == 2);
  for (const char* unknown : {"displacement", "state", "u", "L"}) CHECK_FALSE(step.contains(unknown));
}
