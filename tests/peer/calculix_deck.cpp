#include "peer/calculix_deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "contct/kernel/call.hpp"
#include "contct/structure/structure.hpp"

namespace contct::app::peer {
namespace {

/// One of the problem's dofs in CalculiX's directions, 1 to 3 along the axes and 4 to 6 about them: dw/dx is
/// a turn against that about y, dw/dy one with that about x.
struct turned_dof {
  int direction;
  double sign;
};
constexpr std::array<turned_dof, 3> turned = {{{3, 1.0}, {5, -1.0}, {4, 1.0}}};  // w, wx (theta), wy

/// Deflection is along z; a beam lies on the x axis. Nodes and elements count from 0.
struct mesh {
  std::vector<std::array<double, 2>> nodes{};  // the problem's own first, in their order
  std::vector<std::vector<int>> elements{};    // 3 nodes along a line, or 4 corners and 4 middles
  std::vector<int> origins{};                  // [elements] the problem's element that each is part of
  std::vector<std::pair<int, int>> fixed{};    // node, direction
  std::map<std::pair<int, int>, double> forces{}, settled{};  // by node and direction
};

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

void add_elements(const beam& b, int refine, const load& l, mesh& m) {
  for (const double x : b.x) m.nodes.push_back({x, 0.0});
  for (int e = 0; e < b.elements(); ++e) {
    std::vector<int> line = {e};  // from the left end to the right
    for (int i = 1; i < 2 * refine; ++i) {
      line.push_back(static_cast<int>(m.nodes.size()));
      m.nodes.push_back({b.x[e] + b.length_of(e) * i / (2 * refine), 0.0});
    }
    line.push_back(e + 1);
    for (int i = 0; i < 2 * refine; i += 2) {
      m.elements.push_back({line[i], line[i + 1], line[i + 2]});
      m.origins.push_back(e);
    }
  }
  // Nothing pulls it sideways or turns it about its axis; these only keep it from floating there.
  m.fixed.insert(m.fixed.end(), {{0, 1}, {0, 2}, {0, 4}, {b.nodes() - 1, 2}});
  for_each_loaded_element(l, b.elements(), [&](int e, const std::vector<double>& polynomial) {
    const double h = b.length_of(e) / refine;
    for (int i = 0; i < refine; ++i) {
      const auto f = load_on_line(polynomial, b.x[e] + i * h, h);
      for (std::size_t k = 0; k < 3; ++k) m.forces[{m.elements[e * refine + i][k], 3}] += f[k];
    }
  });
}

/// The points of a plate's refined grid, every other line of which runs through the middles of elements. The
/// problem's own lines are every `step`-th.
struct fine_grid {
  int step, columns, rows;
  std::vector<int> numbers{};  // of the nodes, [rows][columns]

  [[nodiscard]] int& at(int a, int b) { return numbers[static_cast<std::size_t>(b) * columns + a]; }
};

fine_grid add_grid(const plate& own, int step, mesh& m) {
  for (const double y : own.y) {
    for (const double x : own.x) m.nodes.push_back({x, y});
  }
  const auto along = [step](const std::vector<double>& lines, int a) {
    const int i = a / step;
    return a % step == 0 ? lines[i] : lines[i] + (lines[i + 1] - lines[i]) * (a % step) / step;
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

/// A node on the line between two of the problem's is fixed as an ACM rectangle's edge is there: its w and
/// its slope along the line where both have these fixed, the slope across it where both have that.
void fix_between(const std::set<std::pair<int, int>>& fixed, int one, int other, int along, int node,
                 mesh& m) {
  const auto both = [&](int dof) { return fixed.contains({one, dof}) && fixed.contains({other, dof}); };
  for (const int dof : {0, 1, 2})
    if (dof == 3 - along ? both(dof) : both(0) && both(along))
      m.fixed.emplace_back(node, turned[dof].direction);
}

void add_elements(const plate& own, int refine, const load& l, const std::set<std::pair<int, int>>& fixed,
                  mesh& m) {
  fine_grid grid = add_grid(own, 2 * refine, m);
  for (int b = 0; b < grid.rows; ++b) {
    for (int a = 0; a < grid.columns; ++a) {
      const int here = own.node_at(a / grid.step, b / grid.step);
      const bool on_column = a % grid.step == 0;
      const bool on_row = b % grid.step == 0;
      if (on_row && !on_column) fix_between(fixed, here, here + 1, 1, grid.at(a, b), m);
      if (on_column && !on_row) fix_between(fixed, here, here + own.columns(), 2, grid.at(a, b), m);
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
      const double force = pressure[origin] * own.width_of(origin) * own.height_of(origin) / refine / refine;
      // Work of a uniform pressure on S8R's shape functions: its corners take less than nothing.
      for (std::size_t k = 0; k < 8; ++k) m.forces[{nodes[k], 3}] += k < 4 ? -force / 12 : force / 3;
    }
  }
}

mesh mesh_of(const problem& p, const deck_choice& choice) {
  const load& l = p.steps[choice.step - 1];
  mesh m;
  std::set<std::pair<int, int>> fixed;  // node, dof
  for (const support& s : p.supports)
    if (s.fixed) fixed.insert({s.node, s.dof});
  for (const auto& [node, dof] : fixed) m.fixed.emplace_back(node, turned[dof].direction);
  for (const point_load& at : l.points)
    m.forces[{at.node, turned[at.dof].direction}] += turned[at.dof].sign * at.value;
  for (const prescribed_displacement& g : l.settlements)
    m.settled[{g.node, turned[g.dof].direction}] = turned[g.dof].sign * g.value;
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) {
    add_elements(*b, choice.refine, l, m);
  } else {
    add_elements(std::get<plate>(p.geometry.kind), choice.refine, l, fixed, m);
  }
  return m;
}

/// Largest deflection over the structure's length: CalculiX's NLGEOM must not notice that anything turns.
constexpr double smallness = 1e-7;
/// All forces together, in the unit of force that the deck counts in: CalculiX treats forces far below 0.01
/// as zero.
constexpr double total_force = 1e6;
/// How far a spring's table reaches, in largest deflections: Newton's first steps may go far, and outside it
/// the force is constant. A second point is near the answer, since the far end, rounded to a field's digits,
/// would misplace a stiff spring's face.
constexpr double far_away = 1e6;
constexpr double near = 4;

/// CalculiX cuts a field after 20 characters; this has 19 at most.
std::string field(double x) {
  return fmt::format("{:.12e}", x);
}

/// Writes one problem's step.
class deck_writer {
 public:
  deck_writer(const problem& p, const deck_choice& choice, double deflection)
      : problem_(p), choice_(choice), mesh_(mesh_of(p, choice)) {
    for (const auto& at : mesh_.nodes)
      length_ = std::max({length_, at[0] - mesh_.nodes[0][0], at[1] - mesh_.nodes[0][1]});
    thickness_ = length_ / choice_.slenderness;
    scale_ = smallness * length_ / deflection;
    deflection_ = deflection * scale_;
    double forces = 0.0;
    for (const auto& [at, value] : mesh_.forces) forces += std::abs(value);
    if (forces > 0.0) unit_ = total_force / (forces * scale_);
  }

  calculix_deck write() {
    line("*NODE,NSET=STRUCTURE");
    for (std::size_t i = 0; i < mesh_.nodes.size(); ++i)
      line("{},{},{},0", i + 1, field(mesh_.nodes[i][0]), field(mesh_.nodes[i][1]));
    write_elements();
    for (const contact_pair& at : problem_.pairs)
      write_spring(at.node, at.surface, at.stiffness, at.surface * at.face, false);
    for (const support& s : problem_.supports)
      if (!s.fixed) write_spring(s.node, face_below, s.spring, 0.0, true);
    line("*BOUNDARY");
    for (const auto& [node, direction] : mesh_.fixed) line("{},{}", node + 1, direction);
    if (springs_ > 0) line("GROUND,1,3");
    write_step();
    return {std::move(text_), scale_, scale_ * unit_, first_ground()};
  }

 private:
  [[nodiscard]] int first_ground() const { return static_cast<int>(mesh_.nodes.size()) + 1; }

  template <class... Arguments>
  void line(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
    text_ += fmt::format(words, std::forward<Arguments>(arguments)...) + '\n';
  }

  /// A beam's section is a square, and its nu is 0, since a beam of given EI has none. E is chosen to give EI
  /// or D.
  void write_elements() {
    const auto* const b = std::get_if<beam>(&problem_.geometry.kind);
    std::map<double, std::vector<std::size_t>> by_stiffness;
    for (std::size_t e = 0; e < mesh_.elements.size(); ++e)
      by_stiffness[b != nullptr ? b->EI[mesh_.origins[e]] : 0.0].push_back(e);
    const double t = thickness_;
    for (int part = 1; const auto& [EI, which] : by_stiffness) {
      line("*ELEMENT,TYPE={},ELSET=PART{}", b != nullptr ? "B32R" : "S8R", part);
      for (const std::size_t e : which) {
        text_ += std::to_string(e + 1);
        for (const int n : mesh_.elements[e]) text_ += fmt::format(",{}", n + 1);
        text_ += '\n';
      }
      line("*MATERIAL,NAME=M{}\n*ELASTIC", part);
      if (b != nullptr) {
        line("{},0.\n*BEAM SECTION,ELSET=PART{},MATERIAL=M{},SECTION=RECT\n{},{}\n0.,0.,1.",
             field(unit_ * 12 * EI / t / t / t / t), part, part, field(t), field(t));
      } else {
        const auto& p = std::get<plate>(problem_.geometry.kind);
        line("{},{}\n*SHELL SECTION,ELSET=PART{},MATERIAL=M{}\n{}",
             field(unit_ * 12 * p.D * (1 - p.nu * p.nu) / t / t / t), field(p.nu), part, part, field(t));
      }
      ++part;
    }
  }

  /// SPRINGA to a node on the ground above (+1) or below, since SPRING1 cannot be nonlinear in CalculiX 2.20:
  /// a table of force against lengthening, from a shortening of `from` on.
  void write_spring(int node, int side, double stiffness, double from, bool both_ways) {
    const auto& at = mesh_.nodes[node];
    line("*NODE,NSET=GROUND\n{},{},{},{}", first_ground() + springs_, field(at[0]), field(at[1]),
         field(side * length_ / 100));
    ++springs_;
    line("*ELEMENT,TYPE=SPRINGA,ELSET=SPRING{}\n{},{},{}", springs_, mesh_.elements.size() + springs_,
         node + 1, first_ground() + springs_ - 1);
    line("*SPRING,ELSET=SPRING{},NONLINEAR", springs_);
    const double face = -from * scale_;
    for (const double end : {-far_away * deflection_, -near * deflection_})
      line("{},{}", field(unit_ * stiffness * end), field(face + end));
    if (!both_ways) line("0.,{}", field(face));
    line("{},{}", both_ways ? field(unit_ * stiffness * far_away * deflection_) : "0.",
         field(face + far_away * deflection_));
  }

  /// Without NLGEOM CalculiX treats one-sided springs as linear.
  void write_step() {
    line("*STEP,NLGEOM\n*STATIC\n1.,1.");
    if (!mesh_.settled.empty()) line("*BOUNDARY");
    for (const auto& [at, value] : mesh_.settled)
      line("{0},{1},{1},{2}", at.first + 1, at.second, field(value * scale_));
    line("*CLOAD");
    for (const auto& [at, value] : mesh_.forces)
      if (value != 0.0) line("{},{},{}", at.first + 1, at.second, field(value * scale_ * unit_));
    line("*NSET,NSET=GIVEN,GENERATE\n1,{},1\n*NODE PRINT,NSET=GIVEN\nU", nodes(problem_.geometry));
    if (springs_ > 0) line("*NODE PRINT,NSET=GROUND\nRF");
    line("*END STEP");
  }

  const problem& problem_;
  deck_choice choice_;
  mesh mesh_;
  int springs_ = 0;  // the pairs', then those of elastic supports
  double length_ = 0.0;
  double thickness_ = 0.0;
  double scale_ = 1.0;       // of displacements
  double deflection_ = 0.0;  // the largest, scaled
  double unit_ = 1.0;        // of force: everything elastic is so much stiffer than the problem's
  std::string text_;
};

}  // namespace

calculix_deck calculix_deck_of(const problem& p, const deck_choice& choice, double deflection) {
  return deck_writer(p, choice, deflection).write();
}

}  // namespace contct::app::peer
