// Tests the proved error of the mesh of beams on beds.
#include "contct/results/mesh_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "catch.hpp"
#include "contct/number/random.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/results/run.hpp"
#include "contct/results/step_results.hpp"
#include "support/a_run.hpp"

using namespace contct;

namespace {

/// Returns random beam `number` on beds with a mesh of `elements`, a multiple of 8. Every mesh has the same
/// beam.
std::string bedded(std::uint64_t number, int elements) {
  random_numbers chance(number * 977 + 5);
  const auto place = [&chance] { return 0.25 * chance.whole(1, 15) + 0.01 * chance.whole(0, 9); };
  const auto pick = [&chance](const std::vector<std::string>& all) {
    return all[chance.whole(0, static_cast<int>(all.size()) - 1)];
  };
  std::string text = fmt::format(
      "[beam]\nlength = 4\nelements = {}\nEI = {}\n[[bed]]\nfrom = {:.2f}\nmodulus = {}\nface = {}\n",
      elements, pick({"3", "12", "0.8"}), std::min(place(), 3.0),
      pick({"40", "[ { to = 3.5, value = 15 }, { to = 4, value = 60 } ]"}),
      pick({"0", "-0.01", "{ polynomial = [ 0, -0.02, 0.003 ] }"}));
  if (chance.chance(0.7))
    text += fmt::format("[[bed]]\nto = {:.2f}\nmodulus = 25\nface = {}\n", std::max(place(), 0.8),
                        pick({"0", "-0.005"}));
  if (chance.chance(0.3)) text += "[[bed]]\nsurface = 'above'\nto = 2\nmodulus = 30\nface = 0.02\n";
  if (chance.chance(0.4)) text += "[[hinge]]\nx = 1.5\n" + pick({"", "stiffness = 3\n"});
  if (chance.chance(0.5)) text += "[[contact]]\nx = 2.5\nsurface = 'below'\nface = -0.02\nstiffness = 300\n";
  text += pick({"[[support]]\nx = 0\nfix = 'w'\n", "[[support]]\nx = 4\nfix = ['w', 'theta']\n",
                "[[support]]\nx = [0, 4]\nspring = { w = 2, theta = 1 }\n", ""});
  return text +
         fmt::format(
             "[[step]]\nuniform = -{}\npoint = [ {{ x = {:.2f}, w = -{} }}, {{ x = 2, theta = {} }} ]\n",
             pick({"0.3", "1", "0.05"}), place(), pick({"2", "0.5"}), pick({"0", "0.6"}));
}

struct proved_run {
  explicit proved_run(problem p)
      : what(std::move(p)), structure(structure_of(what)), ends(what, structure, {}) {
    ends.go({});
    ends.find_mesh_errors();
  }

  [[nodiscard]] bool certified() const { return !ends.result.mesh.empty() && ends.result.all_certified(); }
  [[nodiscard]] const mesh_error& error() const { return ends.result.mesh.back(); }
  [[nodiscard]] step_results results() const { return {what, ends.result.record.steps.back()}; }
  [[nodiscard]] double bound(std::string_view key) const {
    return std::ranges::find(error().numbers, key, &mesh_number::key)->error;
  }
  [[nodiscard]] const true_extremes& without(std::string_view key) const {
    return *std::ranges::find(error().extremes, key, &true_extremes::key);
  }

  problem what;
  linear_structure structure;
  run ends;
};

/// The largest differences between two meshes of the numbers that both have; the second mesh has `ratio`
/// times as many elements.
std::map<std::string_view, double> differences(const step_results& coarse, const step_results& fine,
                                               std::size_t ratio) {
  std::map<std::string_view, double> most;
  const auto take = [&most](std::string_view key, double a, double b) {
    most[key] = std::max(most[key], std::abs(a - b));
  };
  const std::vector<double>& u = coarse.state.displacement;
  for (std::size_t dof = 0; dof < u.size(); ++dof)
    take(dof % 2 == 0 ? "w" : "slope", u[dof], fine.state.displacement[dof / 2 * 2 * ratio + dof % 2]);
  for (std::size_t e = 0; e < coarse.elements.elements(); ++e)
    for (const std::size_t name : {0, 1}) {
      const std::string_view key = coarse.elements.names[name];
      take(key, coarse.elements.at(e, name)[0], fine.elements.at(e * ratio, name)[0]);
      take(key, coarse.elements.at(e, name)[1], fine.elements.at((e + 1) * ratio - 1, name)[1]);
    }
  for (std::size_t i = 0; i < coarse.reactions.size(); ++i)
    take(coarse.what.supports[i].dof == 0 ? "reaction" : "moment", coarse.reactions[i], fine.reactions[i]);
  for (std::size_t i = 0; i < contacts_of(coarse.what); ++i) {
    take("force", coarse.pairs[i].force, fine.pairs[i].force);
    take("gap", coarse.pairs[i].gap, fine.pairs[i].gap);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    take(coarse.ranges()[i].name, coarse.ranges()[i].least.value, fine.ranges()[i].least.value);
    take(coarse.ranges()[i].name, coarse.ranges()[i].most.value, fine.ranges()[i].most.value);
  }
  for (std::size_t bed = 0; bed < coarse.what.beds.size(); ++bed)
    take("pressure", beds_in(coarse)[bed].pressure.most.value, beds_in(fine)[bed].pressure.most.value);
  return most;
}

struct tally_of_bounds {
  int from_32 = 0, proved_from_32 = 0;
  std::vector<double> ratios;  // bound over error, from 16 elements on
};

/// Compares random beams with a mesh of 2048 elements.
tally_of_bounds try_beams(std::uint64_t count) {
  constexpr int finest = 2048;
  tally_of_bounds t;
  for (std::uint64_t number = 0; number < count; ++number) {
    INFO(bedded(number, 8));
    const proved_run fine(parsed(bedded(number, finest)));
    if (!fine.certified()) continue;  // a mechanism
    REQUIRE(fine.error().not_proved.empty());
    const step_results exact = fine.results();
    for (const int elements : {8, 16, 32, 64, 128}) {
      const proved_run run(parsed(bedded(number, elements)));
      REQUIRE(run.certified());
      const bool proved = run.error().not_proved.empty();
      t.from_32 += elements >= 32 ? 1 : 0;
      t.proved_from_32 += elements >= 32 && proved ? 1 : 0;
      if (!proved) continue;
      for (const auto& [key, off] : differences(run.results(), exact, finest / elements)) {
        INFO(elements << " elements, " << key);
        CHECK(off <= run.bound(key) + fine.bound(key));
        if (elements >= 16 && key != "gap" && key != "force") t.ratios.push_back(run.bound(key) / off);
      }
    }
  }
  std::ranges::sort(t.ratios);
  return t;
}

}  // namespace

TEST_CASE("No true error of random beams on beds is outside its bound, and half of the bounds are sharp") {
  const tally_of_bounds t = try_beams(8);
  CHECK(t.ratios.size() >= 180);
  CHECK(t.ratios[t.ratios.size() / 2] < 1.05);
  CHECK(t.proved_from_32 == t.from_32);
}

TEST_CASE("No true error of 48 random beams on beds at five meshes is outside its bound", "[long]") {
  const tally_of_bounds t = try_beams(48);
  CHECK(t.ratios.size() >= 1000);
  CHECK(t.ratios[t.ratios.size() / 2] < 1.05);
  CHECK(t.ratios[t.ratios.size() * 9 / 10] < 1.5);
  CHECK(t.from_32 >= 132);
  CHECK(t.proved_from_32 >= 0.9 * t.from_32);
}

TEST_CASE("Without mesh error, a beam in full contact and one that lifts off have Hetenyi's values") {
  // lambda = 1 for EI = 1, k = 4. A load in the middle of a free beam of length 2, and of length 6, of which
  // pi stay in contact: its ends, which carry nothing, are where cos(pi / 2) = 0.
  const auto loaded = [](int length, int elements) {
    return proved_run(
        parsed(fmt::format("[beam]\nlength = {0}\nelements = {1}\nEI = 1\n[[bed]]\nmodulus = 4\nface = 0\n"
                           "[[step]]\npoint = [ {{ x = {2}, w = -1 }} ]\n",
                           length, elements, length / 2)));
  };
  // (cosh 2 + cos 2 + 2) / (sinh 2 + sin 2) / 8, (cosh 2 - cos 2) / (sinh 2 + sin 2) / 4, and coth(pi / 2)
  // over 8 and 4, from 40 digits
  struct row {
    int length;
    double w, moment;
  };
  for (const row& r : {row{2, 0.147317648806035898, 0.230279824904519431},
                       row{6, 0.136291426340921029, 0.272582852681842058}})
    for (const int elements : {4, 20}) {
      const proved_run run = loaded(r.length, elements);
      REQUIRE(run.error().not_proved.empty());
      CHECK(run.without("w").least == Approx(-r.w).epsilon(1e-9));
      CHECK(run.without("moment").most == Approx(r.moment).epsilon(1e-9));
      CHECK(run.without("shear").most == Approx(0.5).epsilon(1e-9));
      CHECK(std::abs(run.without("w").told_least + r.w) <= run.bound("w"));
    }
}

TEST_CASE("Faces by list and their moves are linear between the nodes of a mesh, in its finer meshes too") {
  const problem p = parsed(
      "[beam]\nlength = 3\nelements = 6\nEI = 2\n[[bed]]\nmodulus = 30\nface = [-0.02, 0, -0.01, 0.005, "
      "-0.03, 0, 0]\n"
      "[[support]]\nnode = 4\nfix = 'w'\n[[step]]\nuniform = -1\nsettlement = [ { node = 4, w = -0.04 } ]\n"
      "move = [ { node = 2, w = 0.01 } ]\npoint = [ { x = 2.2, w = -2 } ]\n");
  problem finer = p;
  for (int halvings = 0; halvings < 8; ++halvings) finer = refined(finer);
  const proved_run run(p);
  const proved_run fine(finer);
  REQUIRE(run.error().not_proved.empty());
  for (const auto& [key, off] : differences(run.results(), fine.results(), 256)) {
    INFO(key);
    CHECK(off <= run.bound(key) + fine.bound(key));
    if (key != "pressure") CHECK(off >= 0.9 * run.bound(key) - fine.bound(key));
  }
}

TEST_CASE("The mesh error of every beam with beds in the cookbook and among the problems is proved") {
  int proved = 0;
  for (const char* const folder : {"/cookbook", "/problems"})
    for (const auto& file : std::filesystem::directory_iterator(std::string(CONTCT_REFERENCE) + folder)) {
      if (file.path().extension() != ".toml") continue;
      problem p = read_problem(file.path().string());
      if (!std::holds_alternative<beam>(p.geometry.kind) || p.beds.empty()) continue;
      if (p.steps.size() > 5) p.steps.resize(5);
      const proved_run run(p);
      for (const mesh_error& e : run.ends.result.mesh) {
        INFO(file.path() << ": " << e.not_proved);
        CHECK(e.not_proved.empty());
        ++proved;
      }
    }
  CHECK(proved >= 12);
}

TEST_CASE("What is not proved about the mesh says why") {
  const auto why = [](const std::string& text) { return proved_run(parsed(text)).error().not_proved; };
  const std::string on_bed = "[[bed]]\nmodulus = 10\nface = 0\n[[step]]\nuniform = -1\n";
  CHECK(why("[beam]\nlength = 1\nelements = 2\nEI = 1\nGA = 5\n" + on_bed) ==
        "with shear flexibility, nothing is proved about beds");
  CHECK(why("[beam]\nlength = 2\nelements = 8\nEI = 1\n[[support]]\nnode = 1\nfix = ['w', "
            "'theta']\n[[hinge]]\nx = 1\n"
            "[[bed]]\nmodulus = 10\nface = 0\n[[step]]\nuniform = [ { value = -1, to = 1 }, { value = -1e-8, "
            "from = 1 } ]\n") == "it is not certain that contact holds the beam");
}
