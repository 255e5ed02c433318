#include "contct/exact/exact_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "contct/exact/elements.hpp"

namespace contct::exact {
namespace {

/// x[i] = length i / n, where that gives these doubles: what the reader makes of `length` and `elements`.
std::optional<vector> even_parts(std::span<const double> x, const exact_values& values) {
  const auto n = static_cast<int>(x.size()) - 1;
  for (const double length :
       {x.back(), std::nextafter(x.back(), 0.0), std::nextafter(x.back(), 2 * x.back())}) {
    bool even = length > 0.0;
    for (int i = 0; i <= n && even; ++i) even = x[static_cast<std::size_t>(i)] == length * i / n;
    if (!even) continue;
    vector parts;
    for (int i = 0; i <= n; ++i) parts.push_back(values.of(length) * i / n);
    return parts;
  }
  return std::nullopt;
}

vector coordinates(std::span<const double> x, const exact_values& values) {
  if (std::optional<vector> even = even_parts(x, values)) return *even;
  vector exactly;
  for (const double at : x) exactly.push_back(values.of(at));
  return exactly;
}

/// Half of each interval beside a point of a line.
vector tributary(const vector& x) {
  vector lengths(x.size());
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const rational half = (x[i + 1] - x[i]) / 2;
    lengths[i] += half;
    lengths[i + 1] += half;
  }
  return lengths;
}

template <class Matrix, class Dofs>
void add_element(sparse_rows& k, const Matrix& element, const Dofs& dofs) {
  for (std::size_t i = 0; i < dofs.size(); ++i)
    for (std::size_t j = 0; j < dofs.size(); ++j)
      k[static_cast<std::size_t>(dofs[i])][dofs[j]] += element[i][j];
}

/// A structure of one kind: what the conversion of a problem asks of it.
class exact_beam {
 public:
  exact_beam(const beam& b, const exact_values& values)
      : beam_(b), values_(values), x_(coordinates(b.x, values)) {}

  void assemble(exact_problem& e) const {
    for (int i = 0; i < beam_.elements(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      add_element(e.stiffness, beam_stiffness(values_.of(beam_.EI[at]), x_[at + 1] - x_[at]), dofs_of(i));
    }
    e.place.resize(e.dofs());
    std::iota(e.place.begin(), e.place.end(), 0);
    e.ground = {{0, rational(1, 2)}, {beam_.dofs() - 2, rational(1, 2)}};
  }

  void add_distributed(const load& l, vector& f) const {
    for_each_loaded_element(l, beam_.elements(), [&](int i, std::span<const double> polynomial) {
      const auto at = static_cast<std::size_t>(i);
      vector q;
      for (const double a : polynomial) q.push_back(values_.of(a));
      const std::array<rational, 4> work = beam_load(q, x_[at], x_[at + 1] - x_[at]);
      for (std::size_t k = 0; k < 4; ++k) f[2 * at + k] += work[k];
    });
  }

  [[nodiscard]] vector shares() const { return tributary(x_); }

 private:
  static std::array<int, 4> dofs_of(int i) { return {2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3}; }

  const beam& beam_;
  const exact_values& values_;
  vector x_;
};

class exact_plate {
 public:
  exact_plate(const plate& p, const exact_values& values)
      : plate_(p), values_(values), x_(coordinates(p.x, values)), y_(coordinates(p.y, values)) {}

  void assemble(exact_problem& e) const {
    for (int i = 0; i < plate_.elements(); ++i) {
      const auto [a, b] = halves_of(i);
      add_element(e.stiffness, plate_stiffness(a, b, values_.of(plate_.D), values_.of(plate_.nu)),
                  dofs_of(i));
    }
    const bool along_y = plate_.columns() > plate_.rows();  // numbered along the shorter side
    for (int j = 0; j < plate_.rows(); ++j)
      for (int i = 0; i < plate_.columns(); ++i)
        for (int d = 0; d < 3; ++d)
          e.place.push_back(3 * (along_y ? i * plate_.rows() + j : j * plate_.columns() + i) + d);
    for (const int j : {0, plate_.rows() - 1})
      for (const int i : {0, plate_.columns() - 1})
        e.ground.push_back({3 * plate_.node_at(i, j), rational(1, 4)});
  }

  void add_distributed(const load& l, vector& f) const {
    for_each_loaded_element(l, plate_.elements(), [&](int i, std::span<const double> polynomial) {
      const auto [a, b] = halves_of(i);
      const vector12 unit = plate_unit_load(a, b);
      const std::array<int, 12> dofs = dofs_of(i);
      for (std::size_t k = 0; k < 12; ++k)
        f[static_cast<std::size_t>(dofs[k])] += values_.of(polynomial[0]) * unit[k];
    });
  }

  [[nodiscard]] vector shares() const {
    vector areas;
    for (const rational& height : tributary(y_))
      for (const rational& width : tributary(x_)) areas.push_back(width * height);
    return areas;
  }

 private:
  [[nodiscard]] std::pair<rational, rational> halves_of(int element) const {
    const auto i = static_cast<std::size_t>(element % (plate_.columns() - 1));
    const auto j = static_cast<std::size_t>(element / (plate_.columns() - 1));
    return {(x_[i + 1] - x_[i]) / 2, (y_[j + 1] - y_[j]) / 2};
  }

  [[nodiscard]] std::array<int, 12> dofs_of(int element) const {
    std::array<int, 12> dofs{};
    std::size_t next = 0;
    for (const int node : plate_.corners_of(element))
      for (int d = 0; d < 3; ++d) dofs[next++] = 3 * node + d;
    return dofs;
  }

  const plate& plate_;
  const exact_values& values_;
  vector x_, y_;
};

class exact_matrix {
 public:
  exact_matrix(const assembled& a, const exact_values& values) : assembled_(a), values_(values) {}

  void assemble(exact_problem& e) const {
    for (const matrix_entry& m : assembled_.stiffness.entries) {
      const rational value = values_.of(m.value);
      e.stiffness[static_cast<std::size_t>(m.row)][m.column] += value;
      if (m.row != m.column) e.stiffness[static_cast<std::size_t>(m.column)][m.row] += value;
    }
    e.place = assembled_.rows;
    if (e.place.empty()) {
      e.place.resize(e.dofs());
      std::iota(e.place.begin(), e.place.end(), 0);
    }
    for (int dof = 0; dof < assembled_.dofs(); ++dof) e.ground.push_back({dof, 1});
  }

  void add_distributed(const load& /*l*/, vector& /*f*/) const {}

  /// No [[bed]] can be on a matrix.
  [[nodiscard]] vector shares() const { return vector(assembled_.stiffness.order); }

 private:
  const assembled& assembled_;
  const exact_values& values_;
};

exact_beam exactly(const beam& b, const exact_values& values) {
  return {b, values};
}
exact_plate exactly(const plate& p, const exact_values& values) {
  return {p, values};
}
exact_matrix exactly(const assembled& a, const exact_values& values) {
  return {a, values};
}

/// Elastic supports go into the stiffness.
void put_on_supports(const problem& p, const exact_values& values, exact_problem& e) {
  for (std::size_t dof = 0; dof < e.dofs(); ++dof) e.stiffness[dof][static_cast<int>(dof)] += 0;
  for (const support& s : p.supports) {
    const int dof = s.node * dofs_per_node(p.geometry) + s.dof;
    e.supports.push_back({dof, s.fixed, s.fixed ? rational(0) : values.of(s.spring)});
    if (s.fixed) e.fixed[static_cast<std::size_t>(dof)] = 1;
    e.stiffness[static_cast<std::size_t>(dof)][dof] += e.supports.back().spring;
  }
}

template <class Kind>
void add_pairs(const problem& p, const Kind& kind, const exact_values& values, exact_problem& e) {
  for (const contact_pair& c : p.pairs)
    e.pairs.push_back(
        {c.node * dofs_per_node(p.geometry), c.surface, values.of(c.face), values.of(c.stiffness), c.closed});
  if (p.beds.empty()) return;
  const vector shares = kind.shares();
  for (const bed& b : p.beds) {
    for (std::size_t i = b.first_pair; i < b.first_pair + b.share.size(); ++i)
      e.pairs[i].stiffness = values.of(b.modulus) * shares[static_cast<std::size_t>(p.pairs[i].node)];
  }
}

template <class Kind>
void add_step(const problem& p, const load& l, const Kind& kind, const exact_values& values,
              exact_problem& e) {
  const int per_node = dofs_per_node(p.geometry);
  exact_step step{vector(e.dofs()), vector(e.dofs())};
  for (const point_load& q : l.points)
    step.load[static_cast<std::size_t>(q.node * per_node + q.dof)] += values.of(q.value);
  kind.add_distributed(l, step.load);
  for (const prescribed_displacement& g : l.settlements)
    step.settlement[static_cast<std::size_t>(g.node * per_node + g.dof)] += values.of(g.value);
  e.steps.push_back(std::move(step));
}

}  // namespace

exact_problem exact_problem_of(const problem& p, const exact_values& values) {
  exact_problem e;
  e.fixed.assign(static_cast<std::size_t>(dofs(p.geometry)), 0);
  e.stiffness.resize(e.fixed.size());
  std::visit(
      [&](const auto& geometry) {
        const auto kind = exactly(geometry, values);
        kind.assemble(e);
        put_on_supports(p, values, e);
        add_pairs(p, kind, values, e);
        for (const load& l : p.steps) add_step(p, l, kind, values, e);
      },
      p.geometry.kind);
  std::erase_if(e.ground,
                [&e](const added_spring& g) { return e.fixed[static_cast<std::size_t>(g.dof)] != 0; });
  return e;
}

}  // namespace contct::exact
