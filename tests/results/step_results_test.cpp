// Tests results at the ends of steps, and their change by refinement.
#include "contct/results/step_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <set>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/number/random.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/run_result.hpp"
#include "contct/structure/line.hpp"
#include "contct/write/words.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"
#include "support/words.hpp"

using namespace contct;

namespace {

/// Returns a simple beam of length 12, EI = 1e4, with stops at one third and two thirds.
problem beam_over_stops(double face, double q) {
  return parsed(
      fmt::format("[beam]\nlength = 12.0\nelements = 3\nEI = 1e4\n[[support]]\nnodes = [1, 4]\nfix = "
                  "'w'\n[[contact]]\n"
                  "nodes = [2, 3]\nsurface = 'below'\nface = {}\nstiffness = 1e9\n[[step]]\nuniform = {}\n",
                  face, q));
}

/// Returns where the beam passes through the face at the end of a problem's only step.
std::optional<penetration> passage(const problem& p) {
  return deepest_penetration(p, p.steps[0], a_run(p, "corrected").end().displacement);
}

}  // namespace

TEST_CASE("hardest_pair and hardest_supports give the largest force, and of equal forces the first") {
  const a_run stops(beam_over_stops(-0.001, -10.0), "corrected");
  const step_results read = stops.results();
  REQUIRE(read.pairs.size() == 2);
  CHECK(read.hardest_pair() == 0);  // both forces are equal except for rounding
  CHECK(read.pairs[0].force == Approx(read.pairs[1].force).epsilon(1e-9));
  CHECK(read.hardest_supports() == std::vector<std::size_t>{0});
  CHECK_FALSE(a_run(beam_over_stops(-10.0, -10.0), "corrected").results().hardest_pair());
  // One loaded span of two: the middle support has the largest reaction, and the last one pulls.
  const a_run uplift(loaded_span, "corrected");
  CHECK(uplift.results().hardest_supports() == std::vector<std::size_t>{1, 2});
}

TEST_CASE("In every reference beam and plate, loads, reactions and contact forces add up to 0") {
  int compared = 0;
  for (const auto& file : std::filesystem::directory_iterator(CONTCT_REFERENCE "/problems")) {
    if (file.path().extension() != ".toml") continue;
    const a_run run = reference_run(file.path().stem().string());
    // Matrices have no direction "up".
    if (std::holds_alternative<assembled>(run.what.geometry.kind)) continue;
    for (std::size_t step = 0; step < run.result.record.steps.size(); ++step) {
      const step_results read = run.results(step);
      const auto sums = balance_of(read);
      REQUIRE(sums);
      double size = std::abs(sums->loads);
      for (const double r : read.reactions) size += std::abs(r);
      for (const pair_reading& pair : read.pairs) size += std::abs(pair.force);
      INFO(file.path().filename().string() << ", step " << step + 1);
      CHECK(std::abs(sums->loads + sums->reactions + sums->contact) <= 1e-12 * size);
      ++compared;
    }
  }
  CHECK(compared >= 60);
}

TEST_CASE("In the balance of a step, the contact force of a face above counts downwards") {
  const a_run run(loaded_and_freed, "corrected");  // the second step presses the beam upwards
  const auto sums = balance_of(run.results(1));
  REQUIRE(sums);
  CHECK(sums->loads == 60.0);
  CHECK(sums->contact < 0.0);
  CHECK(sums->reactions == Approx(-60.0 - sums->contact).epsilon(1e-12));
}

TEST_CASE("Far from x = 0, bearing pressures are within their bound, and lengths in contact are exact") {
  random_numbers random(3);
  for (int number = 0; number < 20; ++number) {
    std::string x;
    const double start = std::pow(10.0, random.whole(3, 7));
    for (int tenth = 0; tenth < 20; tenth += random.whole(1, 4))
      x += fmt::format("{:.1f}, ", start + 0.1 * tenth);
    const a_run run("[beam]\nx = [" + x +
                        "]\nEI = 1\n[[bed]]\nmodulus = 7\nface = 0\n[[step]]\n"
                        "uniform = -3\npoint = [ { node = 2, w = -2 } ]\n",
                    "corrected");
    const bed_reading read = beds_in(run.results()).at(0);
    const exact_problem exactly = exact_problem_of(run.what);
    const exact_step_end truly = follow_corrected_path(exactly).steps.at(0);
    rational length, least(1000), most;
    for (std::size_t i = 0; i < exactly.pairs.size(); ++i) {
      const rational pressure = 7 * truly.force[i] / exactly.pairs[i].stiffness;
      least = std::min(least, pressure);
      most = std::max(most, pressure);
      if (truly.isep[i] == in_contact) length += exactly.pairs[i].stiffness / 7;
    }
    CAPTURE(number, x);
    const double bound = run.result.record.steps[0].judged->pressure.value();
    CHECK(std::abs(contct::rounded(binary_value(read.pressure.least.value) - least)) <= bound);
    CHECK(std::abs(contct::rounded(binary_value(read.pressure.most.value) - most)) <= bound);
    CHECK(bound < 1e-12);
    CHECK(read.contact == Approx(contct::rounded(length)).epsilon(1e-15));
  }
}

TEST_CASE("The pressure under a half-lifted footing is that of a rigid body on the springs in contact") {
  const a_run run = reference_run("pb11a-strip-footing-n20");
  const std::vector<bed_reading> beds = beds_in(run.results());
  REQUIRE(beds.size() == 1);
  // Solves p = a + b x at the nodes from 0 to 0.6, with tributary lengths, for a sum of 1 and a moment about
  // x = 0 of 0.2.
  double s0 = 0.0, s1 = 0.0, s2 = 0.0;
  for (int i = 0; i <= 12; ++i) {
    const double x = 0.05 * i;
    const double share = i == 0 ? 0.025 : 0.05;
    s0 += share;
    s1 += share * x;
    s2 += share * x * x;
  }
  const bed_reading& bed = beds[0];
  CHECK(bed.pressure.most.value == Approx((s2 - 0.2 * s1) / (s0 * s2 - s1 * s1)).epsilon(1e-3));
  CHECK(bed.pressure.most.value == Approx(10.0 / 3).epsilon(7e-3));  // SEAINT: 2 P / (Y B), Y = 0.6
  CHECK((bed.pressure.most.x == 0.0 && bed.pressure.least.value == 0.0));
  CHECK(bed.contact == Approx(0.625).epsilon(1e-12));
  CHECK(bed.force == Approx(1.0).epsilon(1e-12));  // the load
}

TEST_CASE("A beam that sags through the face between two pairs is reported, but none above the face") {
  const problem soft = beam_over_stops(0.0, -500.0);
  const auto through = passage(soft);
  REQUIRE(through);
  CHECK((through->first == 0 && through->second == 1));
  CHECK(through->x == Approx(6.0).epsilon(1e-6));
  CHECK(through->depth == Approx(500.0 * 256 / (1920 * 1e4)).epsilon(1e-3));  // q L^4 / (1920 EI)
  const a_run run(soft);
  check_words(passage_warning(run.what, run.result.record.steps),
              {"^step 1: between pair 1 and pair 2 the beam passes through"});
  CHECK_FALSE(passage(beam_over_stops(-10.0, -1.0)));
  problem backwards = soft;  // its pairs are named from right to left
  std::ranges::reverse(backwards.pairs);
  const auto same = passage(backwards);
  REQUIRE(same);
  CHECK((same->x == through->x && same->first == backwards.pairs.size() - 1));
  problem other_face = soft;
  other_face.pairs[1].face = -1e-9;
  other_face.pairs[1].closed = false;
  CHECK_FALSE(passage(other_face));
}

TEST_CASE("An envelope has the largest value of each quantity over all increments, with its step") {
  const a_run run(loaded_and_freed, "corrected");
  const envelope all = envelope_of(run.result);
  const std::vector<structure_state> states = pictures_of(run.result);
  CHECK(all.states == static_cast<int>(states.size()) - 1);  // all but the unloaded state
  double least = 0.0;
  double force = 0.0;
  for (const structure_state& s : states) {
    if (s.step == 0) continue;
    least = std::min(least, s.displacement[4]);
    force = std::max(force, step_results(run.what, s).pairs[0].force);
  }
  CHECK(all.values.front().row->key == "w");
  const auto& w = all.values.front().at[0];
  CHECK((w.least.value == least && w.least.step == 1 && w.most.step == 2));
  CHECK(listed(all, "force").at(0).most.value == Approx(force).epsilon(1e-12));
  CHECK(listed(all, "force")[0].most.step == 1);
  REQUIRE(listed(all, "reaction").size() == 2);
  const auto& reaction = listed(all, "reaction")[0];
  CHECK((reaction.most.value > 0.0 && reaction.least.value < 0.0 && reaction.least.step == 2));
}

TEST_CASE("A place is described by node and coordinates, and a value has a unit if the problem has units") {
  problem p = parsed(good_problem);
  CHECK(place_words(p.geometry, placed_value{1.0, 2.0, 0.0, 2}) == "node 3, x = 2");
  CHECK(place_words(p.geometry, placed_value{1.0, 0.5, 0.0, -1}) == "x = 0.5");
  CHECK(unit_words(p, unit::length).empty());
  p.units = {"m", "kN"};
  for (const auto& [key, words] :
       {std::pair("w", " m"), {"moment", " kN m"}, {"shear", " kN"}, {"theta", ""}})
    CHECK(unit_words(p, row_named(p, key).in) == words);
  CHECK(places_of_extremes(p.geometry) == "the whole length");
  // Nodes of a plate are numbered along x first, and w is the first dof of each node.
  const problem plate = parsed(good_plate);
  CHECK(place_words(plate.geometry, placed_value{1.0, 1.0, 0.5, 2}) == "node 3, (1, 0.5)");
  CHECK(places_of_extremes(plate.geometry) == "nodes and corners of elements");
  CHECK((place_of_node(plate.geometry, 4).x == 0.5 && place_of_node(plate.geometry, 4).y == 1.0));
  CHECK(place_name(plate.geometry, 4) == "5");
  std::vector<double> u(18);
  u[12] = 7.0;
  CHECK(deflection_of(plate, u, 4) == 7.0);
}

TEST_CASE("the deflection at a pair gives a gap if the pair is separated, and a force if it is in contact") {
  const problem p = parsed(good_problem);  // face -0.004, stiffness 5e4
  for (const auto& [w, closed, gap, force, look] : {std::tuple(-0.001, false, 0.003, 0.0, pair_state::open),
                                                    {-0.005, true, 0.0, 50.0, pair_state::closed},
                                                    {-0.004, false, 0.0, 0.0, pair_state::at_face}}) {
    const pair_reading read = reading_of(pairs_under(p, {})[0], w, closed);
    CHECK(read.gap == Approx(gap));
    CHECK(read.force == Approx(force));
    CHECK(read.look == look);
  }
}

TEST_CASE("translations of a matrix with coordinates count as deflections, without coordinates all dofs") {
  const std::vector<int> dofs = deflecting_nodes(parsed(portal_frame()));
  CHECK(dofs.size() == 22);
  CHECK(std::ranges::none_of(dofs, [](int dof) { return dof % 3 == 2; }));
  CHECK(deflecting_nodes(parsed(frame_without_coordinates())).size() == 33);
}

TEST_CASE("an extreme of the envelope is in the first of the states with this value, except for rounding") {
  int compared = 0;
  for (const std::string load : {"-8", "-0.7", "3.3"}) {
    std::string text = propped_cantilever;
    for (const std::string& next : {std::string("-0.3"), load, std::string("-0.1"), load})
      text += "[[step]]\nuniform = " + next + "\n";
    const a_run run(text.replace(text.find("-8.0"), 4, load));
    for (const auto& v : envelope_of(run.result).values)
      for (const auto& at : {v.at[0].least, v.at[0].most}) {
        CAPTURE(load, at.value, at.step);
        CHECK(at.step < 4);
        ++compared;
      }
  }
  CHECK(compared == 18);
}

TEST_CASE("a problem with halved elements has the deflections of a file with these elements") {
  for (const auto& [coarse, fine] :
       {std::pair("pb11a-strip-footing-n20", "pb11b-strip-footing-n40"),
        {"pp01a-simply-supported-plate-n4", "pp01b-simply-supported-plate-n8"},
        {"pp02a-settled-column-n4", "pp02b-settled-column-n8"},
        {"pp03d-corners-and-settled-stop-n4", "pp03e-corners-and-settled-stop-n8"},
        {"pp05a-free-plate-on-bed-n8", "pp05c-free-plate-on-bed-n16"}}) {
    INFO(coarse);
    const a_run halved(refined(reference_run(coarse).what), "corrected");
    const a_run written = reference_run(fine);
    CHECK(halved.what.pairs.size() == written.what.pairs.size());
    CHECK(halved.what.supports.size() == written.what.supports.size());
    double most = 0.0, difference = 0.0;
    REQUIRE(halved.result.record.steps.size() == written.result.record.steps.size());
    for (std::size_t step = 0; step < written.result.record.steps.size(); ++step)
      for (int node = 0; node < nodes(written.what.geometry); ++node) {
        const double w = deflection_of(written.what, written.end(step).displacement, node);
        most = std::max(most, std::abs(w));
        difference = std::max(difference,
                              std::abs(w - deflection_of(halved.what, halved.end(step).displacement, node)));
      }
    CHECK(difference <= 1e-10 * most);
  }
}

TEST_CASE("Refinement of a beam without a bed changes extremes only by rounding") {
  const a_run coarse(
      "[beam]\nx = [0, 0.1, 0.7, 2]\nEI = [100, 200, 100]\n[[support]]\nnodes = [1, 4]\nfix = ['w']\n"
      "[[contact]]\nnode = 3\nsurface = 'below'\nface = -0.001\nstiffness = 1e4\n[[step]]\n"
      "uniform = [ { polynomial = [-8, 1], elements = [1, 3] } ]\npoint = [ { node = 2, w = -3, theta = 1 } "
      "]",
      "corrected");
  const a_run fine(refined(coarse.what), "corrected");
  std::set<std::string> kinds;
  for (const mesh_change& c : changes_between(coarse.result, fine.result)) {
    INFO(c.kind);
    CHECK((c.of > 0.0 && c.change <= 1e-12 * c.of));
    kinds.emplace(c.kind);
  }
  CHECK(kinds == std::set<std::string>{"force", "moment", "reaction", "shear", "w"});
  const auto& b = std::get<beam>(fine.what.geometry.kind);
  CHECK(line<rational>(b.x, b.runs).at(1) == rational(1) / 20);  // the middle of 0 and 0.1
  CHECK(line<rational>(b.x, b.runs).at(3) == rational(2) / 5);
}

TEST_CASE("two halvings show the order of convergence, and without one there is no estimate") {
  const auto estimated = [](double first, double second) {
    std::vector<mesh_change> all = {{"w", first, 1.0}};
    estimate_errors(all, {{"w", second, 1.0}});
    return all[0];
  };
  CHECK(estimated(0.3, 0.075).order == Approx(2.0));
  CHECK(estimated(0.3, 0.075).error == Approx(0.4));                // of the sum 0.3 (1 + 1/4 + 1/16 + ..)
  CHECK(estimated(0.3, 0.01).error == Approx(0.3 + 0.01 * 4 / 3));  // no order is taken to be above 2
  CHECK(estimated(0.3, 0.2).error == Approx(0.3 + 0.2 / (1 - std::exp2(-0.6))));
  CHECK_FALSE(estimated(0.3, 0.25).error);
  CHECK(estimated(1e-15, 2e-15).error == Approx(3e-15));
  CHECK_FALSE(estimated(0.0, 0.25).error);
  CHECK((estimated(0.3, 0.0).error == 0.3 && estimated(0.0, 0.0).error == 0.0));
}

TEST_CASE("the estimate for a simply supported plate is the error of its deflection, 0.00406235 q L^4 / D") {
  const a_run coarse = reference_run("pp01a-simply-supported-plate-n4");
  const a_run fine(refined(coarse.what), "corrected");
  const a_run finest(refined(fine.what), "corrected");
  std::vector<mesh_change> all = changes_between(coarse.result, fine.result);
  estimate_errors(all, changes_between(fine.result, finest.result));
  const double error = -coarse.results().ranges()[0].least.value - 0.00406235;
  CHECK(std::ranges::find(all, "w", &mesh_change::kind)->error.value() == Approx(error).epsilon(0.01));
}

TEST_CASE("Refinement of a plate adds fixed nodes to a line, with the mean settlement beside them") {
  const a_run coarse = reference_run("pp06-plate-over-settling-line");
  const problem fine = refined(coarse.what);  // 9 by 5 nodes
  CHECK(fine.supports.size() == coarse.what.supports.size() + 6);
  CHECK(fine.pairs.size() == coarse.what.pairs.size());
  CHECK(fine.pairs[1].node == 2 * 9 + 2);
  REQUIRE(fine.steps[0].settlements.size() == 5);
  for (const prescribed_displacement& g : fine.steps[0].settlements) {
    CHECK(g.node % 9 == 4);
    CHECK(g.value == Approx(-0.01).epsilon(1e-15));
  }
}

TEST_CASE("Refinement gives a new node of a bed the mean of the faces beside it, or the polynomial") {
  const auto refined_bed = [](const std::string& face) {
    return refined(parsed("[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nnode = 1\n"
                          "fix = 'w'\n[[bed]]\nmodulus = 8\nface = " +
                          face + "\n[[step]]\nuniform = -1\n"))
        .pairs;
  };
  const auto means = refined_bed("[-1, -2, -4]");
  REQUIRE(means.size() == 4);  // the first node is fixed
  CHECK((means[0].face == -1.5 && means[2].face == -3.0 && means[3].stiffness == 2.0));
  const auto curve = refined_bed("{ polynomial = [-1, 0, -1] }");
  CHECK((curve[0].face == -1.25 && curve[2].face == -3.25));
}

TEST_CASE(
    "Refinement keeps the places where a bed ends and its modulus changes, and moves its new nodes with the "
    "others") {
  const std::string head = "[beam]\nlength = 8\nelements = 4\nEI = 1\n[[bed]]\nface = 0\n";
  const std::string steps = "[[step]]\nmove = [ { node = 3, w = 4 }, { node = 4, w = 2 } ]\n";
  const auto sums_of = [](const problem& p) {
    double stiffness = 0.0, length = 0.0, moment = 0.0;
    const auto& b = std::get<beam>(p.geometry.kind);
    for (std::size_t i = 0; i < p.pairs.size(); ++i) {
      stiffness += p.pairs[i].stiffness;
      length += p.beds[0].share[i];
      moment += p.pairs[i].stiffness * b.x[p.pairs[i].node];
    }
    return std::array{stiffness, length, moment};
  };
  // By nodes 2 to 4 the bed acts from 1 to 7, by from and to between them.
  for (const auto& [keys, stiffness, length] :
       {std::tuple("modulus = 3\nnodes = '2..4'\n", 18.0, 6.0),
        {"modulus = 3\nfrom = 1\nto = 7\n", 18.0, 6.0},
        {"from = 1.5\nto = 7\nmodulus = [ { to = 4.75, value = 2 }, { to = 7, value = 4 } ]\n", 15.5, 5.5}}) {
    const problem coarse = parsed(head + keys + steps), fine = refined(coarse), finest = refined(fine);
    CAPTURE(keys);
    CHECK(sums_of(coarse)[0] == Approx(stiffness).epsilon(1e-14));
    CHECK(sums_of(coarse)[1] == Approx(length).epsilon(1e-14));
    for (const problem& p : {fine, finest})
      for (std::size_t i = 0; i < 2; ++i) CHECK(sums_of(p)[i] == Approx(sums_of(coarse)[i]).epsilon(1e-14));
    const auto moved = pairs_under(fine, fine.steps[0]);
    const auto move_at = [&](int node) {
      return std::ranges::find(moved, 2 * node, &pair_in<double>::dof)->face;
    };
    CHECK((move_at(4) == 4.0 && move_at(5) == 3.0 && move_at(6) == 2.0 && move_at(3) == 2.0));
  }
}

TEST_CASE(
    "the force of a bed under a settled support is part of the reaction, of the force of the bed and of the "
    "balance") {
  // The support at x = 0 presses 0.02 deep on half an element of 0.5, so with 100 * 0.02 * 0.25.
  const a_run run(
      "[beam]\nlength = 4\nelements = 8\nEI = 50\n[[support]]\nx = [0, 4]\nfix = 'w'\n[[bed]]\nmodulus = "
      "100\nface = 0\nto = 3\n"
      "[[step]]\nuniform = -4\nsettlement = [ { x = 0, w = -0.02 } ]\nmove = [ { x = 0, w = -0.005 } ]\n",
      "corrected");
  const step_results read = run.results();
  CHECK(bed_pressure(read)[0] == Approx(100 * (0.02 - 0.005)).epsilon(1e-14));
  const bed_reading bed = beds_in(read)[0];
  CHECK(bed.contact == Approx(3.0).epsilon(1e-14));
  CHECK((bed.pressure.least.node == 0 && bed.pressure.least.value == bed_pressure(read)[0]));
  const double shear = read.elements.at(0, 0)[0];
  CHECK(read.reactions[0] == Approx(shear - 1.5 * 0.25).epsilon(1e-12));
  const force_balance sums = *balance_of(read);
  CHECK(sums.loads + sums.reactions + sums.contact == Approx(0.0).margin(1e-12));
  const exact_path exactly = follow_corrected_path(exact_problem_of(run.what));
  CHECK(read.reactions[0] == Approx(rounded(exactly.steps[0].reactions[0])).epsilon(1e-13));
}

TEST_CASE("a bed on a rectangle of a plate has the same stiffness and area on every mesh") {
  const problem coarse = parsed(
      "[plate]\nsize = [4, 2]\nelements = [4, 2]\nD = 1\nnu = 0.3\n[[bed]]\nfrom = [0.3, 0.5]\nto = "
      "[3.1, 2]\nmodulus = 5\nface = 0\n[[step]]\nuniform = -1\n");
  const problem by_nodes = parsed(
      "[plate]\nsize = [4, 2]\nelements = [4, 2]\nD = 1\nnu = 0.3\n[[bed]]\nnodes = [7, 8, 12]\nmodulus = 5\n"
      "face = 0\n[[step]]\nuniform = -1\n");
  for (const auto& [p, area] : {std::pair(coarse, 2.8 * 1.5), {by_nodes, 2.5}})
    for (const problem& of : {p, refined(p), refined(refined(p))}) {
      double stiffness = 0.0;
      for (const contact_pair& pair : of.pairs) stiffness += pair.stiffness;
      CHECK(stiffness == Approx(5 * area).epsilon(1e-14));
      CHECK(std::accumulate(of.beds[0].share.begin(), of.beds[0].share.end(), 0.0) ==
            Approx(area).epsilon(1e-14));
    }
}

TEST_CASE("Refinement of a matrix is refused, and the message suggests a finer mesh") {
  CHECK_THROWS_WITH(refined(parsed(portal_frame())),
                    Contains("finer mesh with the program that wrote this one"));
}
