// Tests that every kind of `contct new` runs and is certified, and that one number of each kind agrees with
// the hand calculation in reference/cookbook.md.
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "app/process.hpp"
#include "catch.hpp"
#include "nlohmann/json.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Returns the result of running the unchanged file of a kind.
json solved(const std::string& kind) {
  const scratch_folder dir;
  REQUIRE(contct_program(dir.path(), {"new", kind}).exit == 0);
  const finished f = contct_program(
      dir.path(), {"run", kind + ".toml", "--kernels", "corrected", "--strict", "--json", "out.json"});
  INFO(f.out << f.err);
  REQUIRE(f.exit == 0);
  return json::parse(dir.read("out.json"));
}

/// Returns the sum of the contact forces of the pairs with this surface, "above" or "below".
double force_of(const json& step, const std::string& surface) {
  double sum = 0.0;
  for (const json& pair : step["pairs"])
    if (pair["surface"] == surface) sum += pair["force"].get<double>();
  return sum;
}

/// Returns (modulus / 4 EI)^(1/4), the decay constant of Winkler's beam.
double decay(double modulus, double EI) {
  return std::pow(modulus / (4 * EI), 0.25);
}

}  // namespace

TEST_CASE("contct new without a kind of problem lists the kinds of the cookbook, and has exit status 2") {
  const finished f = contct_program(".", {"new"});
  CHECK(f.exit == 2);
  int kinds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(root / "reference/cookbook")) {
    if (entry.path().extension() != ".toml") continue;
    CHECK_THAT(f.out, Contains("\n  " + entry.path().stem().string() + " "));
    ++kinds;
  }
  CHECK(std::count(f.out.begin(), f.out.end(), '\n') == kinds + 1);
  CHECK(kinds == 9);
}

TEST_CASE("contct new also writes the files that its new problem names, and overwrites no existing file") {
  const scratch_folder dir;
  std::filesystem::create_directory(dir.path() / "own");
  const finished f = contct_program(dir.path(), {"new", "matrix", "own/grillage.toml"});
  CHECK_THAT(f.out,
             Contains("own/grillage.toml, own/matrix.mtx, own/matrix.dof, own/matrix.xyz are written"));
  CHECK(contct_program(dir.path(), {"check", "own/grillage.toml"}).exit == 0);
  const finished again = contct_program(dir.path(), {"new", "matrix", "own/second.toml"});
  CHECK(again.exit == 2);
  CHECK_THAT(again.err, Contains("own/matrix.mtx, which exists already"));
  CHECK_FALSE(std::filesystem::exists(dir.path() / "own/second.toml"));
}

TEST_CASE(
    "cookbook, crane: after the bracket separates, moments about the left bearing give the column's "
    "reaction") {
  const json step = solved("crane")["steps"][0];
  CHECK(step["name"] == "SLS left");
  CHECK(step["pairs"][0]["state"] == "separated");
  const double weight = 78.5 * 1.491e-2;
  CHECK(step["reactions"][1]["value"].get<double>() ==
        Approx((weight * 12 * 6 + 75.0 * 2 + 75.0 * 4) / 6).epsilon(1e-9));
}

TEST_CASE(
    "cookbook, slab: the settlement is that of an infinite beam under the axle plus that under the "
    "self-weight") {
  const json step = solved("slab")["steps"][13];
  CHECK(step["name"] == "axle at 6");
  const double w = 6.25 / 4e4 + 100 * decay(4e4, 4.3e4) / (2 * 4e4);
  CHECK(step["w"][120].get<double>() == Approx(-w).epsilon(1e-3));
}

TEST_CASE("cookbook, base plate: the grout's force is the sum of the column's force and the bolts' forces") {
  const json step = solved("base-plate")["steps"][1];
  const double of_bolts = force_of(step, "above");
  CHECK(of_bolts > 50.0);
  CHECK(force_of(step, "below") == Approx(80.0 + of_bolts).epsilon(1e-9));
}

TEST_CASE("cookbook, racks: the last rack has the reaction of a propped cantilever whose clamp rises") {
  const json steps = solved("racks")["steps"];
  for (const auto& [step, rise] : {std::pair(1, 0.015), std::pair(2, 0.015 + 0.010)}) {
    CHECK(steps[step]["pairs"][0]["state"] == "separated");
    const double force = 3 * 0.8 * 8 / 8 - 3 * 4772 * rise / (8 * 8 * 8);
    CHECK(steps[step]["pairs"][1]["force"].get<double>() == Approx(force).epsilon(1e-3));
  }
}

TEST_CASE("cookbook, rail: the settlement under the wheel is that of an infinite beam, within 1 %") {
  const json step = solved("rail")["steps"][1];
  const double w = (0.6 + 112.5 * decay(5e4, 6380.0) / 2) / 5e4;
  CHECK(step["w"][24].get<double>() == Approx(-w).epsilon(0.01));
}

TEST_CASE(
    "cookbook, bed: the pressed edge settles like that of a rigid footing with its load outside the kern") {
  const json step = solved("bed")["steps"][1];
  const double e = 240.0 / 300.0;
  CHECK(step["w"][30].get<double>() == Approx(-2 * 300.0 / (3 * (1.5 - e)) / 5e4).epsilon(0.01));
}

TEST_CASE(
    "cookbook, matrix: if both girders have the same load, each girder of the grillage bends like a simple "
    "beam") {
  const json step = solved("matrix")["steps"][0];
  CHECK(step["w"][6].get<double>() == Approx(-40.0 * 512 / (48 * 2.1e8 * 8.36e-5)).epsilon(1e-9));
}
