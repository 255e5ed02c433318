// The program itself, as one more of the programs that are compared, and the state that judges them all.
//     state     writes the problem for the others, and the certified state of its end
//     path, path-certified, cholmod    the whole path under the corrected rule; cholmod: on that engine
//     final, final-certified           the end alone (contct run --final-only)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <stdexcept>

#include "bench/peers/certified_state.hpp"
#include "bench/peers/exchange.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "peer/calculix_deck.hpp"

namespace {

using bench::peers::answer;
using bench::peers::contact_problem;
namespace app = contct::app;

/// A problem with its structure, and which of its dofs the others see.
struct given {
  explicit given(const std::string& folder)
      : problem(app::read_problem(folder + "/problem.toml")), structure(app::structure_of(problem)) {
    if (problem.steps.size() != 1 || !structure.settles.empty())
      throw std::invalid_argument("found settlements or several load steps; allowed: one step of loads");
    std::vector<int> dof_at(static_cast<std::size_t>(structure.dofs()));
    for (int dof = 0; dof < structure.dofs(); ++dof) dof_at[structure.row_of(dof)] = dof;
    for (const int dof : dof_at)
      if (structure.fixed[dof] == 0) free_dofs.push_back(dof);
  }

  app::problem problem;
  app::linear_structure structure;
  std::vector<int> free_dofs;  ///< in the order of their rows
};

/// The end of the step as it is told last.
class last_state final : public app::observer {
 public:
  void step_ended(const app::step_state& s) override {
    fraction = s.fraction;
    u.assign(s.displacement.begin(), s.displacement.end());
    isep.assign(s.isep.begin(), s.isep.end());
    rcond = s.rcond;
    if (s.numbers != nullptr) forces = s.numbers->pair_forces;
  }

  double fraction = 0.0;
  double rcond = 0.0;
  std::vector<double> u, forces;
  std::vector<int> isep;
};

std::vector<double> at_free_dofs(const given& g, const std::vector<double>& u) {
  std::vector<double> list;
  for (const int dof : g.free_dofs) list.push_back(u[dof]);
  return list;
}

std::vector<double> forces_of(const given& g, const last_state& end) {
  if (!end.forces.empty()) return end.forces;
  std::vector<double> forces;
  for (std::size_t i = 0; i < g.structure.pairs.size(); ++i)
    forces.push_back(app::force_of(g.structure.pairs[i], end.u[g.structure.dof_of_pair(i)],
                                   end.isep[i] == app::in_contact));
  return forces;
}

contact_problem problem_for_others(const given& g) {
  const app::linear_structure& s = g.structure;
  const contct::matrix::sparse_columns all =
      s.stiffness.is_band() ? contct::matrix::columns_of(s.stiffness.band()) : s.stiffness.columns();
  std::vector<int> number(static_cast<std::size_t>(s.dofs()), -1);  // of each row, among those that are free
  for (std::size_t i = 0; i < g.free_dofs.size(); ++i) number[s.row_of(g.free_dofs[i])] = static_cast<int>(i);
  contact_problem p;
  for (int column = 0; column < all.order(); ++column) {
    if (number[column] < 0) continue;
    for (int i = all.starts[column]; i < all.starts[column + 1]; ++i) {
      if (number[all.rows[i]] < 0) continue;
      p.stiffness.rows.push_back(number[all.rows[i]]);
      p.stiffness.values.push_back(all.values[i]);
    }
    p.stiffness.starts.push_back(static_cast<int>(p.stiffness.rows.size()));
  }
  std::vector<double> load(static_cast<std::size_t>(s.dofs()));
  app::loads_of(g.problem, s)(1, load);
  p.load = at_free_dofs(g, load);
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const app::contact_pair& at = s.pairs[i];
    const int row = number[s.row_of(s.dof_of_pair(i))];
    if (row < 0) throw std::invalid_argument("found a pair at a fixed dof, which other programs do not have");
    p.springs.push_back({row, at.surface, at.face, at.stiffness});
  }
  return p;
}

/// "25.3": CalculiX's node and direction; a deflection of a beam or a plate is along z.
bench::peers::place place_of(const given& g, int dof) {
  const app::linear_structure& s = g.structure;
  if (const auto* matrix = std::get_if<app::assembled>(&g.problem.geometry.kind)) {
    const std::string label = matrix->label_of(dof);
    const std::size_t dot = label.find('.');
    if (dot == std::string::npos) return {};
    return {std::stoi(label.substr(0, dot)), std::stoi(label.substr(dot + 1))};
  }
  return s.deflects(dof) ? bench::peers::place{dof / s.dofs_per_node + 1, 3} : bench::peers::place{};
}

/// CalculiX's input, unless it is there: a solid comes from CalculiX.
void write_deck(const given& g, const last_state& end, const std::string& folder) {
  if (std::filesystem::exists(folder + "/ccx.inp")) return;
  app::peer::deck_choice choice;
  choice.refine = 1;
  // A section as thin as CalculiX can solve for: the shear that beams of ours do not have is less then.
  if (std::holds_alternative<app::beam>(g.problem.geometry.kind))
    choice.slenderness = 4.0 * app::elements(g.problem.geometry);
  double deflection = 0.0;
  for (int dof = 0; dof < g.structure.dofs(); ++dof)
    if (g.structure.deflects(dof)) deflection = std::max(deflection, std::abs(end.u[dof]));
  const app::peer::calculix_deck deck = app::peer::calculix_deck_of(g.problem, choice, deflection);
  std::ofstream(folder + "/ccx.inp") << deck.text;
  std::ofstream(folder + "/ccx.txt") << fmt::format("{:.17g} {:.17g} GIVEN {} {}\n", deck.displacement_scale,
                                                    deck.force_scale, app::nodes(g.problem.geometry),
                                                    deck.first_ground);
}

void write_state(const std::string& folder) {
  const given g(folder);
  last_state end;
  app::certifier judge(g.problem, g.structure);
  app::observer* const observers[] = {&judge, &end};
  (void)judge.find_final_states(observers);
  if (!judge.all_certified() || end.fraction != 1.0 || !judge.steps().front()->proved)
    throw std::runtime_error("the end of " + g.problem.title + " is not certified");
  const app::certificate& c = *judge.steps().front();
  bench::peers::write_problem(folder, problem_for_others(g));
  bench::peers::certified_state state;
  state.bounds = {c.error[app::quantity::w].value_or(0.0), c.error[app::quantity::slope].value_or(0.0),
                  c.error[app::quantity::force].value_or(0.0)};
  state.u = at_free_dofs(g, end.u);
  state.forces = forces_of(g, end);
  for (const int dof : g.free_dofs) {
    state.deflects.push_back(g.structure.deflects(dof) ? 1 : 0);
    state.places.push_back(place_of(g, dof));
  }
  bench::peers::write_state(folder, state);
  write_deck(g, end, folder);
}

/// The whole path. The certificate's time counts where it is asked for.
answer follow(const given& g, const std::string& engine, bool certified) {
  answer a;
  last_state end;
  const auto leader = app::make_kernel("corrected");
  const app::load_history loads = app::loads_of(g.problem, g.structure);
  const double start = bench::peers::process_seconds();
  std::unique_ptr<app::certifier> judge;
  std::vector<app::observer*> observers = {&end};
  app::path_limits limits;
  if (certified) {
    judge = std::make_unique<app::certifier>(g.problem, g.structure);
    limits.ends = judge->ends();
    observers.insert(observers.begin(), judge.get());
  }
  const auto solves = app::make_engine(engine, g.structure);
  const app::path_end how = app::follow_path(g.structure, 1, loads, *solves, *leader, observers, limits);
  a.seconds = bench::peers::process_seconds() - start;
  a.found = how.status == app::path_status::solved && (!judge || judge->all_certified());
  a.steps = static_cast<int>(solves->counts().solves);
  a.u = at_free_dofs(g, end.u);
  a.forces = forces_of(g, end);
  return a;
}

answer find_end(const given& g, bool certified) {
  answer a;
  last_state end;
  const app::load_history loads = app::loads_of(g.problem, g.structure);
  const double start = bench::peers::process_seconds();
  if (certified) {
    app::certifier judge(g.problem, g.structure);
    app::observer* const observers[] = {&judge, &end};
    a.steps = static_cast<int>(judge.find_final_states(observers).work.factors);
    a.found = judge.all_certified();
  } else {
    app::reference_solver finds(g.structure);
    std::vector<double> load(g.structure.dofs());
    loads(1, load);
    const app::reference_answer answer = finds.solve(load, loads.work(1));
    a.steps = finds.factorisations();
    a.found = answer.how == app::reference_answer::outcome::found;
    end.u = answer.displacement;
    end.isep.clear();
    for (const char pressed : answer.pressed)
      end.isep.push_back(pressed != 0 ? app::in_contact : app::separated);
  }
  a.seconds = bench::peers::process_seconds() - start;
  a.u = at_free_dofs(g, end.u);
  a.forces = forces_of(g, end);
  return a;
}

answer solve(const std::string& method, const std::string& folder) {
  const given g(folder);
  if (method == "path" || method == "path-certified")
    return follow(g, std::string(app::quickest_engine(g.structure)), method == "path-certified");
  if (method == "final" || method == "final-certified") return find_end(g, method == "final-certified");
  throw std::invalid_argument("found method " + method +
                              "; allowed: state, path, path-certified, final, final-certified");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3 || std::string(argv[1]) != "state") return bench::peers::solve_as_asked(argc, argv, solve);
  try {
    write_state(argv[2]);
    return 0;
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}: {}\n", argv[0], e.what());
    return 1;
  }
}
