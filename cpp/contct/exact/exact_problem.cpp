#include "contct/exact/exact_problem.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

#include "contct/exact/elements.hpp"

namespace contct::exact {
namespace {

/// As the file has them: equal parts of its lengths where it gives lengths, otherwise number by number.
vector coordinates(std::span<const double> x, std::span<const even_run> runs) {
  vector exactly;
  if (runs.empty())
    for (const double at : x) exactly.push_back(decimal_of(at));
  else
    exactly.push_back(decimal_of(x.front()));
  for (const even_run& run : runs) {
    const rational start = exactly.back();
    const rational length = decimal_of(run.end) - start;
    for (int i = 1; i <= run.elements; ++i) exactly.emplace_back(start + length * i / run.elements);
  }
  return exactly;
}

/// a0 + a1 x + a2 x^2 + ..
rational polynomial_value(std::span<const double> coefficients, const rational& x) {
  rational sum;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = sum * x + decimal_of(coefficients[i]);
  return sum;
}

/// The sums of the parts of a distributed load, from the constant on.
vector summed_parts(std::span<const double> polynomial, std::span<const std::vector<double>> parts) {
  vector sum(polynomial.size());
  const auto add = [&](std::span<const double> part) {
    for (std::size_t i = 0; i < part.size(); ++i) sum[i] += decimal_of(part[i]);
  };
  if (parts.empty()) add(polynomial);
  for (const std::vector<double>& part : parts) add(part);
  return sum;
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

/// Call visit(element, polynomial) for every element that a distributed load acts on.
template <class Visit>
void for_each_exact_load(const load& l, int elements, const Visit& visit) {
  for (const distributed_load& d : l.distributed) {
    const vector q = summed_parts(d.polynomial, d.parts);
    for (const int i : d.elements) visit(i, q);
    for (int i = 0; d.elements.empty() && i < elements; ++i) visit(i, q);
  }
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
  explicit exact_beam(const beam& b) : beam_(b), x_(coordinates(b.x, b.runs)) {}

  void assemble(exact_problem& e) const {
    for (int i = 0; i < beam_.elements(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      add_element(e.stiffness, beam_stiffness(decimal_of(beam_.EI[at]), x_[at + 1] - x_[at]), dofs_of(i));
    }
    e.place.resize(e.dofs());
    std::iota(e.place.begin(), e.place.end(), 0);
    e.ground = {{0, rational(1, 2)}, {beam_.dofs() - 2, rational(1, 2)}};
  }

  void add_distributed(const load& l, vector& f) const {
    for_each_exact_load(l, beam_.elements(), [&](int i, const vector& q) {
      const auto at = static_cast<std::size_t>(i);
      const std::array<rational, 4> work = beam_load(q, x_[at], x_[at + 1] - x_[at]);
      for (std::size_t k = 0; k < 4; ++k) f[2 * at + k] += work[k];
    });
  }

  [[nodiscard]] vector shares() const { return tributary(x_); }

  /// The face that is such a polynomial in x.
  [[nodiscard]] rational face_at(int node, std::span<const double> polynomial) const {
    return polynomial_value(polynomial, x_[static_cast<std::size_t>(node)]);
  }

 private:
  static std::array<int, 4> dofs_of(int i) { return {2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3}; }

  const beam& beam_;
  vector x_;
};

class exact_plate {
 public:
  explicit exact_plate(const plate& p)
      : plate_(p), x_(coordinates(p.x, p.x_runs)), y_(coordinates(p.y, p.y_runs)) {}

  void assemble(exact_problem& e) const {
    const rational nu = decimal_of(plate_.nu);
    const rational D = bending_stiffness_of(nu);
    for (int i = 0; i < plate_.elements(); ++i) {
      const auto [a, b] = halves_of(i);
      add_element(e.stiffness, plate_stiffness(a, b, D, nu), plate_.dofs_of(i));
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
    for_each_exact_load(l, plate_.elements(), [&](int i, const vector& q) {
      const auto [a, b] = halves_of(i);
      const vector12 unit = plate_unit_load(a, b);
      const std::array<int, 12> dofs = plate_.dofs_of(i);
      for (std::size_t k = 0; k < 12; ++k) f[static_cast<std::size_t>(dofs[k])] += q[0] * unit[k];
    });
  }

  [[nodiscard]] vector shares() const {
    vector areas;
    for (const rational& height : tributary(y_))
      for (const rational& width : tributary(x_)) areas.push_back(width * height);
    return areas;
  }

  [[nodiscard]] static rational face_at(int /*node*/, std::span<const double> /*polynomial*/) { return 0; }

 private:
  [[nodiscard]] rational bending_stiffness_of(const rational& nu) const {
    if (plate_.E == 0) return decimal_of(plate_.D);
    const rational t = decimal_of(plate_.thickness);
    return decimal_of(plate_.E) * t * t * t / (12 * (1 - nu * nu));
  }

  [[nodiscard]] std::pair<rational, rational> halves_of(int element) const {
    const auto i = static_cast<std::size_t>(element % (plate_.columns() - 1));
    const auto j = static_cast<std::size_t>(element / (plate_.columns() - 1));
    return {(x_[i + 1] - x_[i]) / 2, (y_[j + 1] - y_[j]) / 2};
  }

  const plate& plate_;
  vector x_, y_;
};

class exact_matrix {
 public:
  explicit exact_matrix(const assembled& a) : assembled_(a) {}

  void assemble(exact_problem& e) const {
    for (const matrix_entry& m : assembled_.stiffness.entries) {
      const rational value = decimal_of(m.value);
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
  [[nodiscard]] static rational face_at(int /*node*/, std::span<const double> /*polynomial*/) { return 0; }

 private:
  const assembled& assembled_;
};

exact_beam exactly(const beam& b) {
  return exact_beam(b);
}
exact_plate exactly(const plate& p) {
  return exact_plate(p);
}
exact_matrix exactly(const assembled& a) {
  return exact_matrix(a);
}

/// Elastic supports go into the stiffness.
void put_on_supports(const problem& p, exact_problem& e) {
  for (std::size_t dof = 0; dof < e.dofs(); ++dof) e.stiffness[dof][static_cast<int>(dof)] += 0;
  for (const support& s : p.supports) {
    const int dof = s.node * dofs_per_node(p.geometry) + s.dof;
    e.supports.push_back({dof, s.fixed, s.fixed ? rational(0) : decimal_of(s.spring)});
    if (s.fixed) e.fixed[static_cast<std::size_t>(dof)] = 1;
    e.stiffness[static_cast<std::size_t>(dof)][dof] += e.supports.back().spring;
  }
}

/// Pairs of a bed whose faces are a polynomial: in contact where the exact face is 0, unless the file says
/// otherwise.
template <class Kind>
void put_on_polynomial(const problem& p, const bed& b, const Kind& kind, exact_problem& e) {
  for (std::size_t i = b.first_pair; i < b.first_pair + b.share.size(); ++i) {
    exact_pair& c = e.pairs[i];
    c.face = kind.face_at(p.pairs[i].node, b.face);
    c.closed = b.closed.value_or(c.face == 0);
  }
}

template <class Kind>
void add_pairs(const problem& p, const Kind& kind, exact_problem& e) {
  for (const contact_pair& c : p.pairs)
    e.pairs.push_back({c.node * dofs_per_node(p.geometry), c.surface, decimal_of(c.face),
                       decimal_of(c.stiffness), c.closed});
  if (p.beds.empty()) return;
  const vector shares = kind.shares();
  for (const bed& b : p.beds) {
    for (std::size_t i = b.first_pair; i < b.first_pair + b.share.size(); ++i)
      e.pairs[i].stiffness = decimal_of(b.modulus) * shares[static_cast<std::size_t>(p.pairs[i].node)];
    if (!b.face.empty()) put_on_polynomial(p, b, kind, e);
  }
}

template <class Kind>
void add_step(const problem& p, const load& l, const Kind& kind, exact_problem& e) {
  const int per_node = dofs_per_node(p.geometry);
  exact_step step{vector(e.dofs()), vector(e.dofs())};
  for (const point_load& q : l.points)
    step.load[static_cast<std::size_t>(q.node * per_node + q.dof)] += decimal_of(q.value);
  kind.add_distributed(l, step.load);
  for (const prescribed_displacement& g : l.settlements)
    step.settlement[static_cast<std::size_t>(g.node * per_node + g.dof)] += decimal_of(g.value);
  e.steps.push_back(std::move(step));
}

}  // namespace

exact_problem exact_problem_of(const problem& p) {
  exact_problem e;
  e.fixed.assign(static_cast<std::size_t>(dofs(p.geometry)), 0);
  e.stiffness.resize(e.fixed.size());
  std::visit(
      [&](const auto& geometry) {
        const auto kind = exactly(geometry);
        kind.assemble(e);
        put_on_supports(p, e);
        add_pairs(p, kind, e);
        for (const load& l : p.steps) add_step(p, l, kind, e);
      },
      p.geometry.kind);
  std::erase_if(e.ground,
                [&e](const added_spring& g) { return e.fixed[static_cast<std::size_t>(g.dof)] != 0; });
  return e;
}

}  // namespace contct::exact
