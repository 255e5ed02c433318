// Tests the proved error of the mesh of beams on beds.
#include "contct/results/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "catch.hpp"
#include "contct/write/words.hpp"
#include "support/a_run.hpp"
#include "support/bedded_beams.hpp"
#include "support/words.hpp"

using namespace contct;

namespace {

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
  for (const auto& [length, w, moment] : {std::tuple(2, 0.147317648806035898, 0.230279824904519431),
                                          {6, 0.136291426340921029, 0.272582852681842058}})
    for (const int elements : {4, 20}) {
      const proved_run run = loaded(length, elements);
      REQUIRE(run.error().not_proved.empty());
      CHECK(run.without("w").least == Approx(-w).epsilon(1e-9));
      CHECK(run.without("moment").most == Approx(moment).epsilon(1e-9));
      CHECK(run.without("shear").most == Approx(0.5).epsilon(1e-9));
      CHECK(std::abs(run.without("w").told_least + w) <= run.bound("w"));
    }
}

TEST_CASE("Without mesh error, the cookbook's footing has the same extremes at every mesh") {
  const auto footing = [](int elements) {
    return parsed(
        fmt::format("[beam]\nlength = 3\nelements = {}\nEI = 1.4e6\n[[bed]]\nmodulus = 5e4\nface = 0\n"
                    "[[step]]\npoint = [ {{ x = 1.5, w = -300 }} ]\n"
                    "[[step]]\npoint = [ {{ x = 1.5, w = -300, theta = -240 }} ]\n",
                    elements));
  };
  const proved_run finest(footing(240));
  int compared = 0;
  for (const int elements : {6, 12, 30, 60}) {
    const proved_run run(footing(elements));
    for (std::size_t i = 0; i < run.ends.result.mesh.size(); ++i)
      for (const true_extremes& x : run.ends.result.mesh[i].extremes) {
        const auto& exact = finest.ends.result.mesh[i].extremes;
        const auto same = std::ranges::find(exact, x.key, &true_extremes::key);
        REQUIRE(same != exact.end());
        const double size = std::max(-same->least, same->most);  // both meshes are right to a millionth of it
        CHECK(std::abs(x.least - same->least) <= 2e-6 * size);
        CHECK(std::abs(x.most - same->most) <= 2e-6 * size);
        ++compared;
      }
  }
  CHECK(compared == 4 * 2 * 3);
  const std::vector<std::string> told = certificate_summary(proved_run(footing(6)).ends.result, true);
  check_words(told.back(), {"without mesh error: ", " in step 2, shear 150 in step 1"});
}

TEST_CASE(
    "The bound on pressures covers sums of beds at a node, and the least pressure beside a softer piece") {
  const auto beam = [](const std::string& of_beam, const std::string& rest) {
    return proved_run(parsed("[beam]\nlength = 4\n" + of_beam + rest));
  };
  const std::string two =
      "EI = 100\n[[bed]]\nmodulus = 50\nface = 0\n[[bed]]\nmodulus = 50\nface = 0\n[[step]]\nuniform = "
      "-1\npoint = [ { x = 2, w = -10 } ]\n";
  const proved_run overlapping = beam("elements = 8\n", two);
  const proved_run finer = beam("elements = 512\n", two);
  const double off = std::abs(bed_pressure(overlapping.results())[4] - bed_pressure(finer.results())[256]);
  CHECK(off <= overlapping.bound("pressure") + finer.bound("pressure"));
  CHECK(off >= 0.7 * overlapping.bound("pressure"));  // one bound for all pressures

  const std::string soft =
      "EI = 1e5\n[[bed]]\nmodulus = [ { to = 1, value = 100 }, { to = 2, value = 10 }, { to = 4, value = 100 "
      "} "
      "]\nface = 0\n[[step]]\npoint = [ { x = 2.654, w = -97.5 } ]\n";
  const auto least = [](const proved_run& run) { return beds_in(run.results())[0].pressure.least.value; };
  const proved_run coarse = beam("elements = 16\n", soft);
  const proved_run fine = beam("elements = 512\n", soft);
  CHECK(std::abs(least(coarse) - least(fine)) > 0.2);
  CHECK(std::abs(least(coarse) - least(fine)) <= coarse.bound("pressure") + fine.bound("pressure"));
}

TEST_CASE("One long element without a bed does not divide all elements") {
  const problem p = parsed(
      "[beam]\nx = [0, 100, 100.1, 100.2, 100.3, 100.4]\nEI = 10\n[[bed]]\nfrom = 100\nto = 100.4\nmodulus = "
      "1\nface = 0\n[[step]]\nuniform = -1\n");
  CHECK(finely_divided(p).halvings == 0);
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
  int told = 0;
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
        told += e.extremes.empty() ? 0 : 1;
      }
    }
  CHECK(told >= 28);  // all steps but the five of PB05 have extremes without mesh error
}

TEST_CASE("What is not proved about the mesh says why") {
  const auto why = [](const std::string& text) { return proved_run(parsed(text)).error().not_proved; };
  const std::string on_bed = "[[bed]]\nmodulus = 10\nface = 0\n[[step]]\nuniform = -1\n";
  CHECK(why("[beam]\nlength = 1\nelements = 2\nEI = 1\nGA = 5\n" + on_bed) ==
        "with shear flexibility, nothing is proved about beds");
  CHECK(why("[beam]\nlength = 2\nelements = 8\nEI = 1\n[[support]]\nnode = 1\nfix = ['w', 'theta']\n"
            "[[hinge]]\nx = 1\n[[bed]]\nmodulus = 10\nface = 0\n[[step]]\n"
            "uniform = [ { value = -1, to = 1 }, { value = -1e-8, from = 1 } ]\n") ==
        "it is not certain that contact holds the beam; use a finer mesh (element_size)");
}
