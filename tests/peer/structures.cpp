// Beams and plates: contct's elements against CalculiX's, whose difference goes with the section's thickness
// and with the mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/read/problem_file.hpp"
#include "peer/calculix_deck.hpp"
#include "peer/programs.hpp"

namespace contct::app::peer {
namespace {

using nlohmann::json;

/// A problem and what contct says of its steps.
struct solved_problem {
  std::string name;
  problem given;
  json steps;
};

solved_problem solve(const places& p, const std::string& name, const std::string& path) {
  return {name, read_problem(path), run_contct(p, path)["steps"]};
}

solved_problem solve_reference(const places& p, const std::string& name) {
  return solve(p, name.substr(0, name.find('-')), p.reference + "/problems/" + name + ".toml");
}

/// What comes out of CalculiX for a deck, against a step of contct's.
difference compare_answers(const json& step, const problem& given, const calculix_deck& deck,
                           const std::vector<calculix_table>& tables) {
  difference d;
  double largest = 0.0;
  const auto w = step["w"].get<std::vector<double>>();
  const auto u = values_at_end(tables, "displacements", "GIVEN", 1, static_cast<int>(w.size()), "job.dat");
  for (std::size_t i = 0; i < w.size(); ++i) {
    d.displacement = std::max(d.displacement, std::abs(u[i][2] / deck.displacement_scale - w[i]));
    largest = std::max(largest, std::abs(w[i]));
  }
  if (largest > 0.0) d.displacement /= largest;
  const auto count = static_cast<int>(given.pairs.size());
  const auto held = values_at_end(tables, "forces", "GROUND", deck.first_ground, count, "job.dat");
  double pressing = 0.0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    const json& pair = step["pairs"][i];
    const double ours = pair["force"];
    const double theirs = -given.pairs[i].surface * held[i][2] / deck.force_scale;
    d.force = std::max(d.force, std::abs(theirs - ours));
    pressing = std::max(pressing, std::abs(ours));
    d.same_pairs = d.same_pairs && (theirs > 0.0) == (pair["state"] == "contact");
  }
  if (pressing > 0.0) d.force /= pressing;
  d.values = static_cast<int>(w.size() + held.size());
  return d;
}

calculix_deck deck_of(const problem& given, const json& step, const deck_choice& choice) {
  double deflection = 0.0;
  for (const double w : step["w"]) deflection = std::max(deflection, std::abs(w));
  return calculix_deck_of(given, choice, deflection);
}

difference compare_answers(const places& p, const solved_problem& s, const deck_choice& choice) {
  const json& step = s.steps[static_cast<std::size_t>(choice.step - 1)];
  const calculix_deck deck = deck_of(s.given, step, choice);
  return compare_answers(step, s.given, deck, run_calculix(p, "structure", deck.text));
}

std::string words_of(const difference& d) {
  return fmt::format("w within {:.1e}, forces within {:.1e}, {} pairs closed, {} values", d.displacement,
                     d.force, d.same_pairs ? "the same" : "OTHER", d.values);
}

bool within(const difference& d, double displacement, double force) {
  return d.same_pairs && d.values > 0 && d.displacement <= displacement && d.force <= force;
}

/// How fast differences fall where what causes them is halved.
double order_of(double before, double after) {
  return std::log2(before / after);
}

/// Every step of a beam that carries load.
void check_every_step(const places& p, verdicts& v, const solved_problem& s, int least_closed) {
  int closed = 0;
  for (int step = 1; step <= static_cast<int>(s.given.steps.size()); ++step) {
    const json& of_step = s.steps[static_cast<std::size_t>(step - 1)];
    const auto w = of_step["w"].get<std::vector<double>>();
    if (std::all_of(w.begin(), w.end(), [](double x) { return std::abs(x) < 1e-12; })) continue;
    const difference d = compare_answers(p, s, {step, 2, 500});
    for (const json& pair : of_step["pairs"]) closed += pair["state"] == "contact" ? 1 : 0;
    v.check(within(d, 1e-5, 3e-4), fmt::format("{} step {}: {}", s.name, step, words_of(d)));
  }
  v.check(closed >= least_closed, fmt::format("{}: {} closed pairs were compared", s.name, closed));
}

/// A beam's difference is shear, which Euler and Bernoulli leave out: (thickness over length)^2.
void check_shear(const places& p, verdicts& v, const solved_problem& s, int step) {
  std::vector<difference> d;
  for (const double slenderness : {25.0, 50.0, 100.0})
    d.push_back(compare_answers(p, s, {step, 2, slenderness}));
  for (std::size_t i = 1; i < d.size(); ++i) {
    const double w = order_of(d[i - 1].displacement, d[i].displacement);
    const double n = order_of(d[i - 1].force, d[i].force);
    v.check(d[i].same_pairs && w > 1.7 && n > 1.7,
            fmt::format("{} step {}, section {} times thinner: {}; order {:.2f} and {:.2f}", s.name, step,
                        1 << i, words_of(d[i]), w, n));
  }
}

/// Everything that a beam may have and that the references lack here.
const char* const motley_beam = R"(
[beam]
x = [0.0, 0.7, 1.0, 2.0, 2.5, 4.0]
EI = [1e3, 2e3, 1e3, 5e2, 1e3]
[[support]]
node = 1
fix = ["w", "theta"]
[[support]]
node = 5
spring = { w = 2.0e3 }
[[contact]]
node = 3
surface = "above"
face = 0.001
stiffness = 3e4
[[contact]]
node = 6
surface = "below"
face = -0.02
stiffness = 3e3
[[contact]]
node = 2
surface = "below"
face = 0
stiffness = 3e3
[[step]]
uniform = [ { value = 30.0, elements = "4..5" }, { polynomial = [10.0, 2.0, -3.0, 4.0], elements = "1..3" } ]
point = [ { node = 2, theta = -111.5 }, { node = 6, theta = -7, w = -13 } ]
)";

/// Where loads are no constants, the mesh counts too; down to what solving for so thin a section leaves of
/// double precision, some 1e-5.
void check_mesh(const places& p, verdicts& v) {
  write_text(p.work + "/motley.toml", motley_beam);
  const solved_problem s = solve(p, "motley beam", p.work + "/motley.toml");
  std::vector<difference> d;
  for (const int refine : {1, 2, 4}) d.push_back(compare_answers(p, s, {1, refine, 500}));
  const double order = order_of(d[0].displacement, d[1].displacement);
  v.check(within(d[1], 1e-4, 5e-4) && order > 3,
          fmt::format("{}, 2 elements for each: {}; order {:.2f}", s.name, words_of(d[1]), order));
  v.check(within(d[2], 2e-5, 2e-4) && d[2].displacement < d[1].displacement,
          fmt::format("{}, 4 elements for each: {}", s.name, words_of(d[2])));
}

/// Supports that settle, with a stop that is reached on the way, and a load in one of the steps.
const char* const settling_beam = R"(
[beam]
length = 8.0
elements = 8
EI = 1.0e4
[[support]]
x = 0.0
fix = ["w", "theta"]
[[support]]
x = 8.0
fix = "w"
[[contact]]
x = 4.0
surface = "below"
face = -0.004
stiffness = 5e3
[[step]]
settlement = [ { x = 8.0, w = -0.03 }, { x = 0.0, theta = 0.001 } ]
[[step]]
uniform = -5.0
settlement = [ { x = 8.0, w = -0.01 }, { x = 0.0, w = 0.002 } ]
)";

void check_settlements(const places& p, verdicts& v) {
  write_text(p.work + "/settling.toml", settling_beam);
  check_every_step(p, v, solve(p, "settling beam", p.work + "/settling.toml"), 2);
  const solved_problem line = solve_reference(p, "pp06-plate-over-settling-line");
  for (const int step : {1, 2}) {
    const difference d = compare_answers(p, line, {step, 4, 500});
    v.check(within(d, 4e-3, 2e-2), fmt::format("{} step {}: {}", line.name, step, words_of(d)));
  }
}

/// Plates: contct's mesh and CalculiX's are refined together.
void check_plates(const places& p, verdicts& v) {
  std::vector<solved_problem> meshes;
  for (const char* name : {"pp02a-settled-column-n4", "pp02b-settled-column-n8", "pp02c-settled-column-n16"})
    meshes.push_back(solve_reference(p, name));
  for (const int step : {1, 2, 3, 4}) {
    std::vector<difference> d;
    for (const solved_problem& s : meshes) d.push_back(compare_answers(p, s, {step, 1, 500}));
    for (std::size_t i = 1; i < d.size(); ++i) {
      const double order = order_of(d[i - 1].displacement, d[i].displacement);
      v.check(d[i].same_pairs && order > 1.7,
              fmt::format("{} step {}: {}; order {:.2f}", meshes[i].name, step, words_of(d[i]), order));
    }
    v.check(within(d.back(), 4e-3, 2e-2),
            fmt::format("{} step {}: {}", meshes.back().name, step, words_of(d.back())));
  }
}

}  // namespace

void check_structures(const places& p, verdicts& v) {
  const solved_problem stop = solve_reference(p, "pb01-cantilever-tip-stop");
  const solved_problem settled = solve_reference(p, "pb06-settled-middle-support");
  const solved_problem gaps = solve_reference(p, "pb07-three-gap-supports");
  check_every_step(p, v, stop, 2);
  check_every_step(p, v, settled, 3);
  check_every_step(p, v, gaps, 5);
  check_shear(p, v, stop, 2);
  check_shear(p, v, settled, 3);
  check_shear(p, v, gaps, 3);
  check_mesh(p, v);
  check_plates(p, v);
  check_settlements(p, v);
}

}  // namespace contct::app::peer
