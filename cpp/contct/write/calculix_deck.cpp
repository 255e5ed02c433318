#include "contct/write/calculix_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numeric>
#include <set>
#include <stdexcept>

#include "contct/certify/reference_solution.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/structure/structure.hpp"

namespace contct::write {
namespace {

/// One of the problem's dofs in CalculiX's directions. A slope is a turn: dw/dx against the turn about y,
/// dw/dy with that about x.
struct turned_dof {
  int direction;
  double sign;
};
constexpr std::array<turned_dof, 3> turned = {{{3, 1.0}, {5, -1.0}, {4, 1.0}}};  // w, wx (theta), wy

/// Add what a problem's own nodes have: supports that are fixed, and point loads. Returns which (node, dof)
/// the supports fix.
std::set<std::pair<int, int>> take_over_nodes(const problem& p, const load& l, calculix_mesh& m) {
  std::set<std::pair<int, int>> fixed;
  for (const support& s : p.supports) {
    if (s.fixed) fixed.insert({s.node, s.dof});
  }
  for (const auto& [node, dof] : fixed) m.fixed.push_back({node, turned[dof].direction});
  for (const point_load& at : l.points) {
    const turned_dof t = turned[at.dof];
    m.forces[{at.node, t.direction}] += t.sign * at.value;
  }
  for (const prescribed_displacement& g : l.settlements) {
    const turned_dof t = turned[g.dof];
    m.settled[{g.node, t.direction}] = t.sign * g.value;
  }
  return fixed;
}

/// Work of a distributed load on the three shape functions of a quadratic line from x = left, h long.
std::array<double, 3> load_on_line(const std::vector<double>& polynomial, double left, double h) {
  std::array<double, 3> f{};
  const int degree = static_cast<int>(polynomial.size()) - 1 + 2;
  for (const auto& [t, weight] : gauss_points(degree / 2 + 1)) {  // t from 0 to 1
    const double q = polynomial_at(polynomial, left + t * h) * weight * h;
    f[0] += q * (1 - t) * (1 - 2 * t);
    f[1] += q * 4 * t * (1 - t);
    f[2] += q * t * (2 * t - 1);
  }
  return f;
}

calculix_mesh mesh_of(const beam& b, const problem& p, int refine, const load& l) {
  calculix_mesh m;
  for (const double x : b.x) m.nodes.push_back({x, 0.0});
  const int intervals = 2 * refine;
  for (int e = 0; e < b.elements(); ++e) {
    std::vector<int> line = {e};  // from the left end to the right
    for (int i = 1; i < intervals; ++i) {
      line.push_back(static_cast<int>(m.nodes.size()));
      m.nodes.push_back({b.x[e] + b.length_of(e) * i / intervals, 0.0});
    }
    line.push_back(e + 1);
    for (int i = 0; i < intervals; i += 2) {
      m.elements.push_back({line[i], line[i + 1], line[i + 2]});
      m.origins.push_back(e);
    }
  }
  take_over_nodes(p, l, m);
  // Nothing pulls it sideways or turns it about its axis; these only keep it from floating there.
  m.fixed.insert(m.fixed.end(), {{0, 1}, {0, 2}, {0, 4}, {b.nodes() - 1, 2}});
  for_each_loaded_element(l, b.elements(), [&](int e, const std::vector<double>& polynomial) {
    const double h = b.length_of(e) / refine;
    for (int i = 0; i < refine; ++i) {
      const std::vector<int>& nodes = m.elements[e * refine + i];
      const auto f = load_on_line(polynomial, b.x[e] + i * h, h);
      for (std::size_t k = 0; k < 3; ++k) m.forces[{nodes[k], 3}] += f[k];
    }
  });
  return m;
}

/// The points of a plate's refined grid, every other line of which runs through the middles of elements. The
/// problem's own lines are every `step`-th.
struct fine_grid {
  int step, columns, rows;
  std::vector<int> numbers{};  // of the nodes, [rows][columns]

  [[nodiscard]] int& at(int a, int b) { return numbers[static_cast<std::size_t>(b) * columns + a]; }
};

/// Number the nodes of a refined grid, and add them to `m`: the problem's own first.
fine_grid grid_of(const plate& own, int step, calculix_mesh& m) {
  for (const double y : own.y) {
    for (const double x : own.x) m.nodes.push_back({x, y});
  }
  const auto along = [step](const std::vector<double>& lines, int a) {
    const int i = a / step;
    if (a % step == 0) return lines[i];
    return lines[i] + (lines[i + 1] - lines[i]) * (a % step) / step;
  };
  fine_grid grid{step, (own.columns() - 1) * step + 1, (own.rows() - 1) * step + 1};
  grid.numbers.assign(static_cast<std::size_t>(grid.rows) * grid.columns, -1);
  for (int b = 0; b < grid.rows; ++b) {
    for (int a = 0; a < grid.columns; ++a) {
      if (a % 2 == 1 && b % 2 == 1) continue;  // the middle of an element: S8R has no node there
      const bool is_own = a % step == 0 && b % step == 0;
      grid.at(a, b) = is_own ? own.node_at(a / step, b / step) : static_cast<int>(m.nodes.size());
      if (!is_own) m.nodes.push_back({along(own.x, a), along(own.y, b)});
    }
  }
  return grid;
}

/// A node between two of the problem's, at t from 0 to 1 on a line of length h.
struct node_between {
  int one, other;
  int along;  ///< the slope along the line: 1 or 2
  int node;
  double t, h;
};

/// What is fixed at a node on the line between two of the problem's nodes follows from both. In an ACM
/// rectangle the deflection there is a cubic, the slope across it linear: the first is given where both ends
/// have w and the slope along the line fixed, the second where both have it fixed.
void fix_between(const std::set<std::pair<int, int>>& fixed, const node_between& n, calculix_mesh& m) {
  const auto both = [&](int dof) { return fixed.contains({n.one, dof}) && fixed.contains({n.other, dof}); };
  const auto given = [&](int node, int dof) {
    const auto at = m.settled.find({node, turned[dof].direction});
    return at == m.settled.end() ? 0.0 : turned[dof].sign * at->second;
  };
  const auto fix = [&](int dof, double value) {
    m.fixed.push_back({n.node, turned[dof].direction});
    if (value != 0.0) m.settled[{n.node, turned[dof].direction}] = turned[dof].sign * value;
  };
  const auto [one, other, along, node, t, h] = n;
  if (both(0) && both(along)) {
    const double rise = given(other, 0) - given(one, 0);
    const double left = given(one, along) * h;
    const double right = given(other, along) * h;
    const double square = 3 * rise - 2 * left - right;
    const double cube = left + right - 2 * rise;
    fix(0, given(one, 0) + t * (left + t * (square + t * cube)));
    fix(along, (left + t * (2 * square + 3 * t * cube)) / h);
  }
  if (both(3 - along)) fix(3 - along, std::lerp(given(one, 3 - along), given(other, 3 - along), t));
}

calculix_mesh mesh_of(const plate& own, const problem& p, int refine, const load& l) {
  calculix_mesh m;
  fine_grid grid = grid_of(own, 2 * refine, m);
  const auto fixed = take_over_nodes(p, l, m);
  for (int b = 0; b < grid.rows; ++b) {
    for (int a = 0; a < grid.columns; ++a) {
      const int here = own.node_at(a / grid.step, b / grid.step);
      const bool on_column = a % grid.step == 0;
      const bool on_row = b % grid.step == 0;
      const auto share = [&](int lines) { return static_cast<double>(lines % grid.step) / grid.step; };
      const int i = a / grid.step;
      const int j = b / grid.step;
      if (on_row && !on_column)
        fix_between(fixed, {here, here + 1, 1, grid.at(a, b), share(a), own.x[i + 1] - own.x[i]}, m);
      if (on_column && !on_row)
        fix_between(fixed, {here, here + own.columns(), 2, grid.at(a, b), share(b), own.y[j + 1] - own.y[j]},
                    m);
    }
  }
  // Nothing pulls it in its plane; these only keep it from floating there.
  m.fixed.insert(m.fixed.end(), {{0, 1}, {0, 2}, {own.columns() - 1, 2}});
  std::vector<double> pressure(own.elements(), 0.0);
  for_each_loaded_element(
      l, own.elements(), [&](int e, const std::vector<double>& polynomial) { pressure[e] += polynomial[0]; });
  for (int b = 0; b + 2 < grid.rows; b += 2) {
    for (int a = 0; a + 2 < grid.columns; a += 2) {
      const std::vector<int>& nodes = m.elements.emplace_back(std::vector<int>{
          grid.at(a, b), grid.at(a + 2, b), grid.at(a + 2, b + 2), grid.at(a, b + 2), grid.at(a + 1, b),
          grid.at(a + 2, b + 1), grid.at(a + 1, b + 2), grid.at(a, b + 1)});
      const int origin = m.origins.emplace_back(b / grid.step * (own.columns() - 1) + a / grid.step);
      if (pressure[origin] == 0.0) continue;
      const double force = pressure[origin] * own.width_of(origin) * own.height_of(origin) / refine / refine;
      // Work of a uniform pressure on S8R's shape functions: its corners take less than nothing.
      for (std::size_t k = 0; k < 8; ++k) m.forces[{nodes[k], 3}] += k < 4 ? -force / 12 : force / 3;
    }
  }
  return m;
}

/// Largest deflection over the structure's length: CalculiX's NLGEOM must not notice that anything turns.
constexpr double smallness = 1e-7;
/// How far a spring's table reaches, in largest deflections: Newton's first steps may go far.
constexpr double reach = 1e6;
/// All forces together, in the unit of force that the deck counts in.
constexpr double total_force = 1e6;
/// A second point of the table near the answer, likewise: the far end alone, rounded to the digits of a
/// field, would misplace the face of a stiff spring.
constexpr double within = 4;

/// CalculiX cuts a field after 20 characters; this has 19 at most. A number that scaling took beyond doubles
/// is refused.
std::string field(double x) {
  if (!std::isfinite(x))
    throw std::invalid_argument(
        fmt::format("found {}, scaled for CalculiX; allowed: numbers within the range of double precision. "
                    "Choose units in which "
                    "lengths and forces are nearer to 1",
                    x));
  return fmt::format("{:.12e}", x);
}

void refuse_what_cannot_be_written(const problem& p, int step) {
  const auto refuse = [](const std::string& why) { throw std::invalid_argument(why); };
  const int steps = static_cast<int>(p.steps.size());
  if (step < 1 || step > steps)
    refuse(fmt::format("--step: found {}; allowed: {}", step,
                       steps == 1 ? "1, the only one" : fmt::format("1 to {}", steps)));
  if (std::holds_alternative<assembled>(p.geometry.kind))
    refuse("only beams and plates can be written for CalculiX");
  if (const auto* of = std::get_if<plate>(&p.geometry.kind); of != nullptr && of->nu > 0.49)
    refuse(fmt::format(
        "plate.nu: found {:g}; allowed: at most 0.49 for CalculiX, whose plates are solid elements", of->nu));
  for (const support& s : p.supports) {
    if (!s.fixed && s.dof != 0)
      refuse(
          fmt::format("the support at node {} has a spring in {}: CalculiX has no springs for the rotations "
                      "of beams and plates; allowed: springs in w",
                      s.node + 1, dof_names(p.geometry)[s.dof]));
  }
  const linear_structure s = structure_of(p);
  if (!s.is_held(s.held_by([](std::size_t) { return false; })))
    refuse(
        "the supports alone do not hold the structure: CalculiX starts with every pair separated and then "
        "finds no solution; allowed: a structure that its [[support]] tables hold");
}

/// What a spring, one-sided or not, has in common with its like: one table for all of them.
struct spring_law {
  double stiffness;
  double from;  // the shortening at which it begins to press, from the undeformed structure on
  bool both_ways;
  // clang-tidy 14 takes the comparison of a bool for a conversion.
  auto operator<=>(const spring_law&) const = default;  // NOLINT(modernize-use-nullptr,*-bool-conversion)
};

/// A spring between a node of the structure, from 0, and a node on the ground above or below it.
struct ground_spring {
  int node;
  int side;  // +1: the ground is above
  spring_law law;
};

/// Writes one problem's step.
class deck_writer {
 public:
  deck_writer(const problem& p, const calculix_choice& choice) : problem_(p), choice_(choice) {
    if (choice_.step == 0) choice_.step = static_cast<int>(p.steps.size());
    refuse_what_cannot_be_written(p, choice_.step);
    mesh_ = calculix_mesh_of(p, choice_.refine, choice_.step - 1);
    measure();
    for (const contact_pair& at : p.pairs)
      springs_.push_back({at.node, at.surface, {at.stiffness, at.surface * at.face, false}});
    for (const support& s : p.supports) {
      if (!s.fixed) springs_.push_back({s.node, face_below, {s.spring, 0.0, true}});
    }
  }

  calculix_deck write() {
    write_heading();
    write_nodes();
    if (const auto* b = std::get_if<beam>(&problem_.geometry.kind)) {
      write_beam(*b);
    } else {
      write_plate(std::get<plate>(problem_.geometry.kind));
    }
    write_springs();
    line("*BOUNDARY");
    for (const auto& [node, direction] : mesh_.fixed) line("{},{}", node + 1, direction);
    if (!springs_.empty()) line("GROUND,1,3");
    write_step();
    return {std::move(text_),
            scale_,
            force_scale(),
            choice_.step,
            static_cast<int>(mesh_.nodes.size()),
            static_cast<int>(mesh_.elements.size()),
            first_ground()};
  }

 private:
  /// The sizes that everything is chosen by. Only the size of the answer is taken from the reference
  /// solution.
  void measure() {
    const auto extent = [this](double calculix_mesh::place::*along) {
      const auto [least, most] = std::ranges::minmax(mesh_.nodes, {}, along);
      return most.*along - least.*along;
    };
    length_ = std::max(extent(&calculix_mesh::place::x), extent(&calculix_mesh::place::y));
    thickness_ = length_ / choice_.slenderness;

    const linear_structure s = structure_of(problem_);
    std::vector<double> total(s.dofs(), 0.0);
    const load_history loads = loads_of(problem_, s);
    loads(choice_.step, total);
    reference_solver finds(s);
    const reference_answer found = finds.solve(total, loads.work(choice_.step));
    if (found.how != reference_answer::outcome::found)
      throw std::invalid_argument(
          fmt::format("the load of step {} has no equilibrium, so there is no final state", choice_.step));
    for (std::size_t dof = 0; dof < found.displacement.size(); dof += s.dofs_per_node)
      deflection_ = std::max(deflection_, std::abs(found.displacement[dof]));
    if (deflection_ == 0.0) deflection_ = length_;  // any length will do
    scale_ = smallness * length_ / deflection_;
    double forces = 0.0;
    for (const auto& [at, value] : mesh_.forces) forces += std::abs(value);
    if (forces > 0.0) unit_ = total_force / (forces * scale_);
  }

  [[nodiscard]] double force_scale() const { return scale_ * unit_; }
  [[nodiscard]] int first_ground() const { return static_cast<int>(mesh_.nodes.size()) + 1; }

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
    text_ += fmt::format(words, std::forward<Arguments>(arguments)...) + '\n';
  }

  void write_heading() {
    line(
        R"(** The state at the end of load step {} of {} of a contct problem.
** Displacements and faces are the problem's times the first of these, forces times the second:
** displacement-scale {}
** force-scale {}
** NLGEOM is needed: without it CalculiX treats one-sided springs as linear. It also makes rotations
** nonlinear, so displacements are scaled: the largest is {:g} of the length. CalculiX treats forces
** far below 0.01 as zero and stops iterating too early, so loads and stiffnesses are scaled up.
** The problem's node i is node i here; pair i is the spring to ground node {} + i.
** No field has more than 20 characters, since CalculiX cuts longer ones.)",
        choice_.step, problem_.steps.size(), field(scale_), field(force_scale()), smallness,
        first_ground() - 1);
  }

  void write_nodes() {
    line("*NODE,NSET=STRUCTURE");
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i)
      line("{},{},{},0", i + 1, field(mesh_.nodes[i].x), field(mesh_.nodes[i].y));
    if (springs_.empty()) return;
    line(
        "** Ground: a node for each spring, directly above or below the spring's other "
        "node.\n*NODE,NSET=GROUND");
    int next = first_ground();
    for (const ground_spring& s : springs_) {
      const auto& at = mesh_.nodes[s.node];
      line("{},{},{},{}", next++, field(at.x), field(at.y), field(s.side * length_ / 100));
    }
  }

  void element_lines(const std::vector<std::size_t>& which) {
    for (const std::size_t e : which) {
      std::string nodes;
      for (const int n : mesh_.elements[e]) nodes += fmt::format(",{}", n + 1);
      line("{}{}", e + 1, nodes);
    }
  }

  void write_beam(const beam& b) {
    line(
        R"(** A square section, 1/{:g} of the length: shear adds (thickness over length)^2. E is chosen
** to give EI; nu = 0, since a beam of given EI has no nu. Elements between two nodes of the problem
** are of equal length.)",
        choice_.slenderness);
    std::map<double, std::vector<std::size_t>> by_stiffness;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e) by_stiffness[b.EI[mesh_.origins[e]]].push_back(e);
    for (int part = 1; const auto& [EI, which] : by_stiffness) {
      line("*ELEMENT,TYPE=B32R,ELSET=PART{}", part);
      element_lines(which);
      line("*MATERIAL,NAME=EI{}\n*ELASTIC\n{},0.", part,
           field(unit_ * 12 * EI / thickness_ / thickness_ / thickness_ / thickness_));
      line("*BEAM SECTION,ELSET=PART{},MATERIAL=EI{},SECTION=RECT\n{},{}\n0.,0.,1.", part, part,
           field(thickness_), field(thickness_));
      ++part;
    }
  }

  void write_plate(const plate& p) {
    line("** Thickness 1/{:g} of the length: shear adds (thickness over length)^2. E is chosen to give D.",
         choice_.slenderness);
    line("*ELEMENT,TYPE=S8R,ELSET=PLATE");
    std::vector<std::size_t> all(mesh_.elements.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    element_lines(all);
    line("*MATERIAL,NAME=D\n*ELASTIC\n{},{}\n*SHELL SECTION,ELSET=PLATE,MATERIAL=D\n{}",
         field(unit_ * 12 * p.D * (1 - p.nu * p.nu) / thickness_ / thickness_ / thickness_), field(p.nu),
         field(thickness_));
  }

  /// Each law is a table of force over lengthening. CalculiX holds the force constant outside it, so it ends
  /// far beyond anything that happens.
  void write_springs() {
    if (springs_.empty()) return;
    line(
        R"(** Springs to the ground: SPRINGA, since SPRING1 cannot be nonlinear in CalculiX 2.20. A table is force
** against elongation: slope k in contact, zero when separated. Outside its table a force is constant,
** so a table ends {:g} times the largest deflection away.)",
        reach);
    std::map<spring_law, std::vector<std::size_t>> by_law;
    for (std::size_t i = 0; i < springs_.size(); ++i) by_law[springs_[i].law].push_back(i);
    const double far = reach * deflection_ * scale_;
    const double near = within * deflection_ * scale_;
    for (int set = 1; const auto& [law, which] : by_law) {
      line("*ELEMENT,TYPE=SPRINGA,ELSET=SPRINGS{}", set);
      for (const std::size_t i : which)
        line("{},{},{}", mesh_.elements.size() + 1 + i, springs_[i].node + 1,
             first_ground() + static_cast<int>(i));
      line("*SPRING,ELSET=SPRINGS{},NONLINEAR", set++);
      const double face = -law.from * scale_;
      for (const double end : {-far, -near})
        line("{},{}", field(unit_ * law.stiffness * end), field(face + end));
      if (!law.both_ways) line("0.,{}", field(face));
      line("{},{}", law.both_ways ? field(unit_ * law.stiffness * far) : "0.", field(face + far));
    }
  }

  void write_step() {
    line(
        R"(** One increment. The default criterion is enough: with piecewise linear springs Newton's method
** terminates.
*STEP,NLGEOM
*STATIC
1.,1.)");
    if (!mesh_.settled.empty()) line("*BOUNDARY");
    for (const auto& [at, value] : mesh_.settled)
      line("{0},{1},{1},{2}", at.first + 1, at.second, field(value * scale_));
    line("*CLOAD");
    for (const auto& [at, value] : mesh_.forces) {
      if (value != 0.0) line("{},{},{}", at.first + 1, at.second, field(value * force_scale()));
    }
    line("*NSET,NSET=GIVEN,GENERATE\n1,{},1\n*NODE PRINT,NSET=GIVEN\nU", nodes(problem_.geometry));
    if (!springs_.empty())
      line("** Reactions of the ground nodes: the contact forces, positive up.\n*NODE PRINT,NSET=GROUND\nRF");
    line("*NODE FILE,OUTPUT=2D\nU\n*END STEP");
  }

  const problem& problem_;
  calculix_choice choice_;
  calculix_mesh mesh_;
  std::vector<ground_spring> springs_;  // the pairs', then those of elastic supports
  double length_ = 0.0;
  double thickness_ = 0.0;
  double deflection_ = 0.0;  // the largest
  double scale_ = 1.0;       // of displacements
  double unit_ = 1.0;        // of force: everything elastic is so much stiffer than the problem's
  std::string text_;
};

}  // namespace

calculix_mesh calculix_mesh_of(const problem& p, int refine, int step) {
  const load& l = p.steps[step];
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) return mesh_of(*b, p, refine, l);
  return mesh_of(std::get<plate>(p.geometry.kind), p, refine, l);
}

calculix_deck calculix_deck_of(const problem& p, const calculix_choice& choice) {
  return deck_writer(p, choice).write();
}

}  // namespace contct::write
