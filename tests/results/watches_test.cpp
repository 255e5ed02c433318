// Tests the extremes of the parts that [[watch]] tables name, against closed forms.
#include "catch.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/quantities.hpp"
#include "contct/write/words.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"
#include "support/words.hpp"

using namespace contct;

namespace {

// With nodes at the pairs.
const std::string with_nodes =
    "[beam]\nlength = 4\nelements = 4\nEI = 1e4\n[[support]]\nx = [0, 4]\nfix = 'w'\nname = ['A', 'B']\n";
const std::string simple_span =
    "[beam]\nlength = 4\nelements = 3\nsection = { E = 1e4, I = 1, W = 0.5 }\n[[support]]\nx = [0, 4]\n"
    "fix = 'w'\nname = ['A', 'B']\n";

const watched_range& found(const std::vector<watched_range>& all, std::size_t part, std::string_view key) {
  for (const watched_range& w : all)
    if (w.part == part && w.row->key == key) return w;
  FAIL("no " << key << " in part " << part);
  return all.front();
}

}  // namespace

TEST_CASE("A watched range of a beam has the extremes between its ends, which need not be nodes") {
  const a_run r(parsed(simple_span + "[[step]]\nuniform = -8\n[[watch]]\nname = 'm'\nfrom = 1.1\nto = 3.7\n"
                                     "[[watch]]\nname = 'left'\nto = 1.5\n"),
                "corrected");
  const std::vector<watched_range> all = watched_in(r.results());
  CHECK(all.size() == 8);
  const watched_range& moment = found(all, 0, "moment");  // 4 x (4 - x)
  CHECK(moment.most.value == Approx(16).epsilon(1e-12));
  CHECK(moment.most.x == Approx(2).epsilon(1e-6));
  CHECK(moment.least.value == Approx(4 * 3.7 * 0.3).epsilon(1e-12));
  CHECK(moment.least.x == 3.7);
  const watched_range& shear = found(all, 0, "shear");  // 8 (2 - x)
  CHECK(shear.most.value == Approx(7.2).epsilon(1e-12));
  CHECK(shear.least.value == Approx(-13.6).epsilon(1e-12));
  CHECK(found(all, 0, "stress").most.value == Approx(32).epsilon(1e-12));
  CHECK(found(all, 0, "w").least.value == Approx(-5.0 * 8 * 256 / 384 / 1e4).epsilon(1e-9));
  CHECK(found(all, 1, "moment").most.value == Approx(4 * 1.5 * 2.5).epsilon(1e-12));
  CHECK(found(all, 1, "shear").most.node == 0);
}

TEST_CASE("A watched range of a plate has the nodes of its rectangle, and beds their pressure there") {
  const std::string plate =
      "[plate]\nsize = [2, 1]\nelements = [4, 2]\nD = 10\nnu = 0.3\n[[bed]]\nmodulus = 50\nface = 0\n"
      "[[step]]\nuniform = -1\npoint = [ { at = [2, 1], w = -1 } ]\n[[watch]]\nname = 'left'\nto = [1, 1]\n"
      "[[watch]]\nname = 'all'\nfrom = [0, 0]\n";
  const a_run r(parsed(plate), "corrected");
  const std::vector<watched_range> all = watched_in(r.results());
  CHECK(all.size() == 10);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(all[5 + i].least.value == r.results().ranges()[i].least.value);
    CHECK(all[5 + i].most.value == r.results().ranges()[i].most.value);
    CHECK(all[i].most.x <= 1);
  }
  CHECK(found(all, 1, "pressure").most.x == 2);
  CHECK(found(all, 0, "pressure").most.value < 0.5 * found(all, 1, "pressure").most.value);
  CHECK(found(all, 0, "w").least.value > found(all, 1, "w").least.value);
}

TEST_CASE(
    "Watched names have the reactions, forces and gaps of their supports and pairs, over all combinations "
    "too") {
  const a_run r(
      parsed(
          with_nodes +
          "[[contact]]\nx = [2, 3]\nsurface = 'below'\nface = [0, -1]\nstiffness = 1e9\nname = ['S', 'T']\n"
          "[[case]]\nname = 'G'\nuniform = -8\n[[combination]]\nname = 'one'\nterms = { G = 1 }\n"
          "[[combination]]\nname = 'two'\nterms = { G = 2 }\n[[watch]]\nname = 'ends'\nnames = ['A', 'B']\n"
          "[[watch]]\nname = 'stops'\nnames = ['S', 'T']\n"),
      "corrected");
  const std::vector<watched_range> all = watched_in(r.results());
  CHECK(all.size() == 3);
  CHECK(found(all, 0, "reaction").most.value == Approx(3 * 8 * 2 / 8.0).epsilon(1e-4));  // two spans
  CHECK(found(all, 1, "force").most.x == 2);
  CHECK(found(all, 1, "force").least.value == 0.0);
  CHECK(found(all, 1, "gap").most.x == 3);
  const envelope e = envelope_of(r.result);
  REQUIRE(e.watched.size() == 3);
  CHECK(e.watched[0].at[0].most.step == 2);
  CHECK(e.watched[0].at[0].least.step == 1);
  CHECK(e.watched[1].at[0].most.name == "T");
  const auto gaps =
      std::ranges::find(e.lists, "gap", [](const envelope::listed& list) { return list.row->key; });
  REQUIRE(gaps != e.lists.end());
  CHECK(gaps->at[1].most.step == 1);
  CHECK(gaps->at[1].least.step == 2);
  check_words(watch_lines(r.results())[0], {"ends:", "reaction", "at A, node 1"});
}

TEST_CASE(
    "A deflection above a tenth of a beam's length, or half a plate's thickness, or a slope above 0.1 is "
    "warned of") {
  const auto warned = [](const std::string& text) {
    const a_run r(parsed(text), "corrected");
    return size_warning(r.what, r.result.record.steps);
  };
  const std::string cantilever =
      "[beam]\nlength = 3\nelements = 2\nEI = 9\n[[support]]\nx = 0\nfix = ['w', 'theta']\n[[step]]\npoint = "
      "[ { x = 3, w = ";
  CHECK(warned(cantilever + "-0.19 } ]\n").empty());  // w = F, slope = F / 2
  check_words(warned(cantilever + "-0.21 } ]\n"), {"step 1: a slope of 0.105", "small displacements"});
  check_words(warned(cantilever + "-0.31 } ]\n"),
              {"step 1: a deflection of 0.31", "a tenth of the length, 0.3,"});
  const std::string plate =
      "[plate]\nsize = [2, 1]\nelements = [2, 2]\nE = 1e6\nnu = 0.3\nthickness = 0.02\n[[support]]\n"
      "at = [[0, 0], [2, 0], [0, 1], [2, 1]]\nspring = { w = 10 }\n[[step]]\npoint = [ { at = [1, 0.5], w = ";
  CHECK(warned(plate + "-0.001 } ]\n").empty());
  check_words(warned(plate + "-0.45 } ]\n"), {"a deflection of ", "half the thickness, 0.01,"});
}
