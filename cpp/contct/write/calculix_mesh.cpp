#include "contct/write/calculix_mesh.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <set>

#include "contct/structure/gauss.hpp"

namespace contct::write {
namespace {

/// One of the problem's dofs in CalculiX's directions. A slope is a turn: dw/dx against the turn about y,
/// dw/dy with that about x.
struct turned_dof {
  int direction;
  double sign;
};
constexpr std::array<turned_dof, 3> turned = {{{3, 1.0}, {5, -1.0}, {4, 1.0}}};  // w, wx (theta), wy

/// Which (node, dof) the problem's supports fix.
std::set<std::pair<int, int>> fixed_of(const problem& p) {
  std::set<std::pair<int, int>> fixed;
  for (const support& s : p.supports) {
    if (s.fixed) fixed.insert({s.node, s.dof});
  }
  return fixed;
}

void add_point_loads(const load& l, calculix_mesh& m) {
  for (const point_load& at : l.points) {
    const turned_dof t = turned[at.dof];
    m.forces[{at.node, t.direction}] += t.sign * at.value;
  }
}

/// Nodes of one of a beam's elements, from its left end to its right.
std::vector<int> line_of(const beam& b, int element, int intervals, calculix_mesh& m) {
  std::vector<int> line = {element};
  const double left = b.x[element];
  for (int i = 1; i < intervals; ++i) {
    line.push_back(static_cast<int>(m.nodes.size()));
    m.nodes.push_back({left + b.length_of(element) * i / intervals, 0.0});
  }
  line.push_back(element + 1);
  return line;
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
  for (int e = 0; e < b.elements(); ++e) {
    const std::vector<int> line = line_of(b, e, 2 * refine, m);
    for (std::size_t i = 0; i + 2 < line.size(); i += 2) {
      m.elements.push_back({line[i], line[i + 1], line[i + 2]});
      m.origins.push_back(e);
    }
  }
  for (const auto& [node, dof] : fixed_of(p)) m.fixed.push_back({node, turned[dof].direction});
  // Nothing pulls it sideways or turns it about its axis; these only keep it from floating there.
  m.fixed.insert(m.fixed.end(), {{0, 1}, {0, 2}, {0, 4}, {b.nodes() - 1, 2}});
  add_point_loads(l, m);
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
/// problem's own lines are every 2 `refine`-th.
class fine_grid {
 public:
  fine_grid(const plate& p, int refine, calculix_mesh& m)
      : own_(p),
        step_(2 * refine),
        columns_((p.columns() - 1) * step_ + 1),
        rows_((p.rows() - 1) * step_ + 1) {
    for (const double y : p.y) {
      for (const double x : p.x) m.nodes.push_back({x, y});
    }
    numbers_.assign(place_of(0, rows_), -1);
    for (int b = 0; b < rows_; ++b) {
      for (int a = 0; a < columns_; ++a) number(a, b, m);
    }
  }

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int step() const { return step_; }
  [[nodiscard]] int at(int a, int b) const { return numbers_[place_of(a, b)]; }
  /// The problem's element that the refined one with its lower left corner at (a, b) is part of.
  [[nodiscard]] int origin_of(int a, int b) const { return b / step_ * (own_.columns() - 1) + a / step_; }

 private:
  [[nodiscard]] std::size_t place_of(int a, int b) const {
    return static_cast<std::size_t>(b) * columns_ + a;
  }

  void number(int a, int b, calculix_mesh& m) {
    if (a % 2 == 1 && b % 2 == 1) return;  // the middle of an element: S8R has no node there
    int& n = numbers_[place_of(a, b)];
    if (a % step_ == 0 && b % step_ == 0) {
      n = own_.node_at(a / step_, b / step_);
      return;
    }
    n = static_cast<int>(m.nodes.size());
    m.nodes.push_back({along(own_.x, a), along(own_.y, b)});
  }

  [[nodiscard]] double along(const std::vector<double>& lines, int a) const {
    const int i = a / step_;
    if (a % step_ == 0) return lines[i];
    return lines[i] + (lines[i + 1] - lines[i]) * (a % step_) / step_;
  }

  const plate& own_;
  int step_, columns_, rows_;
  std::vector<int> numbers_;  // [rows][columns]
};

/// What is fixed at a node on the line between two of the problem's nodes follows from both. In an ACM
/// rectangle the deflection there is a cubic, the slope across it linear: the first is zero where both ends
/// have w and the slope along the line fixed, the second where both have it fixed.
void fix_between(const std::set<std::pair<int, int>>& fixed, int one, int other, int along, int node,
                 calculix_mesh& m) {
  const auto both = [&](int dof) { return fixed.contains({one, dof}) && fixed.contains({other, dof}); };
  const int across = 3 - along;
  if (both(0) && both(along)) {
    m.fixed.push_back({node, turned[0].direction});
    m.fixed.push_back({node, turned[along].direction});
  }
  if (both(across)) m.fixed.push_back({node, turned[across].direction});
}

void fix(const plate& own, const problem& p, const fine_grid& grid, calculix_mesh& m) {
  const auto fixed = fixed_of(p);
  for (const auto& [node, dof] : fixed) m.fixed.push_back({node, turned[dof].direction});
  const int step = grid.step();
  for (int b = 0; b < grid.rows(); ++b) {
    for (int a = 0; a < grid.columns(); ++a) {
      const int i = a / step;
      const int j = b / step;
      const bool on_column = a % step == 0;
      const bool on_row = b % step == 0;
      if (on_column == on_row) continue;
      if (on_row) fix_between(fixed, own.node_at(i, j), own.node_at(i + 1, j), 1, grid.at(a, b), m);
      if (on_column) fix_between(fixed, own.node_at(i, j), own.node_at(i, j + 1), 2, grid.at(a, b), m);
    }
  }
  // Nothing pulls it in its plane; these only keep it from floating there.
  m.fixed.insert(m.fixed.end(), {{0, 1}, {0, 2}, {own.columns() - 1, 2}});
}

calculix_mesh mesh_of(const plate& own, const problem& p, int refine, const load& l) {
  calculix_mesh m;
  const fine_grid grid(own, refine, m);
  std::vector<double> pressure(own.elements(), 0.0);
  for_each_loaded_element(
      l, own.elements(), [&](int e, const std::vector<double>& polynomial) { pressure[e] += polynomial[0]; });
  for (int b = 0; b + 2 < grid.rows(); b += 2) {
    for (int a = 0; a + 2 < grid.columns(); a += 2) {
      m.elements.push_back({grid.at(a, b), grid.at(a + 2, b), grid.at(a + 2, b + 2), grid.at(a, b + 2),
                            grid.at(a + 1, b), grid.at(a + 2, b + 1), grid.at(a + 1, b + 2),
                            grid.at(a, b + 1)});
      m.origins.push_back(grid.origin_of(a, b));
    }
  }
  fix(own, p, grid, m);
  add_point_loads(l, m);
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const int origin = m.origins[e];
    const double q = pressure[origin];
    if (q == 0.0) continue;
    const double force = q * own.width_of(origin) * own.height_of(origin) / refine / refine;
    // Work of a uniform pressure on S8R's shape functions: its corners take less than nothing.
    for (std::size_t k = 0; k < 8; ++k) m.forces[{m.elements[e][k], 3}] += k < 4 ? -force / 12 : force / 3;
  }
  return m;
}

}  // namespace

calculix_mesh calculix_mesh_of(const problem& p, int refine, int step) {
  const load& l = p.steps[step];
  if (const auto* b = std::get_if<beam>(&p.geometry.kind)) return mesh_of(*b, p, refine, l);
  return mesh_of(std::get<plate>(p.geometry.kind), p, refine, l);
}

}  // namespace contct::write
