// The equations of a problem: K, supports, pairs and loads in one kind of number. The certificate uses
// double_double, the exact path uses rational.
#pragma once

#include <boost/container/flat_map.hpp>
#include <functional>
#include <utility>
#include <vector>

#include "contct/model/elements.hpp"

namespace contct {

/// A row of a symmetric matrix: the entries that may differ from 0, by column.
template <class Number>
using sparse_row = boost::container::flat_map<int, Number>;
template <class Number>
using sparse_rows = std::vector<sparse_row<Number>>;

/// A candidate contact pair.
template <class Number>
struct pair_in {
  int dof = 0;
  int surface = 0;  ///< n: face_above (+1) or face_below (-1)
  Number face{}, stiffness{};
  bool closed = false;  ///< in contact at the start
  int other = -1;       ///< the dof with the face; -1: the face is fixed

  /// The relative displacement of the pair, from the displacements `u` [dofs].
  template <class Vector>
  [[nodiscard]] Number seen_in(const Vector& u) const {
    return other < 0 ? u[dof] : Number(u[dof] - u[other]);
  }
  template <class Vector, class Value>
  void add_to(Vector& f, const Value& force) const {
    f[dof] += force;
    if (other >= 0) f[other] -= force;
  }
};

template <class Number>
struct support_in {
  int dof;
  bool fixed;
  Number spring;
};

/// The loads at the end of a step.
template <class Number>
struct loads_in {
  std::vector<Number> force;       ///< [dofs] consistent loads
  std::vector<double> size;        ///< [dofs] the sum of the magnitudes of the parts of `force`: see size_of
  std::vector<Number> settlement;  ///< [dofs] the prescribed displacements; 0 at other dofs
  std::vector<Number> moved;       ///< [dofs] how far the faces of the pairs at the dof are moved
  bool from_zero = false;          ///< see load::from_zero
};

template <class Number>
struct equations {
  sparse_rows<Number> stiffness;  ///< includes elastic supports; rows of fixed dofs are not changed
  std::vector<char> fixed;        ///< [dofs]
  std::vector<support_in<Number>> supports;
  std::vector<pair_in<Number>> pairs;
  std::function<loads_in<Number>(const load&)> loads_of;

  [[nodiscard]] std::size_t dofs() const { return fixed.size(); }
};

template <class Number, class Kind, class Elements>
void assemble(const Kind& /*kind*/, const Elements& elements, sparse_rows<Number>& k) {
  for_each_stiffness(elements, [&k](int /*e*/, const auto& dofs, const auto& own) {
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      sparse_row<Number>& row = k[dofs[i]];
      if (row.empty()) row.reserve(dofs.size() == 4 ? 6 : 27);  // the dofs of the adjacent elements
      auto at = row.end();
      for (std::size_t j = 0; j < dofs.size(); ++j) {  // most columns are next to the one before
        if (at == row.end() || ++at == row.end() || at->first != dofs[j]) at = row.try_emplace(dofs[j]).first;
        at->second += own[i][j];
      }
    }
  });
}

template <class Number>
void assemble(const assembled& a, const no_elements<Number>& /*none*/, sparse_rows<Number>& k) {
  for (const matrix_entry& m : a.stiffness.entries) {
    const auto value = number_of<Number>(m.value);
    k[m.row][m.column] += value;
    if (m.row != m.column) k[m.column][m.row] += value;
  }
}

template <class Number>
void put_on_supports(const problem& p, equations<Number>& e) {
  const int per_node = dofs_per_node(p.geometry);
  for (std::size_t dof = 0; dof < e.dofs(); ++dof) e.stiffness[dof][static_cast<int>(dof)] += Number(0);
  for (const support& s : p.supports) {
    const int dof = s.node * per_node + s.dof;
    e.supports.push_back({dof, s.fixed, s.fixed ? Number(0) : number_of<Number>(s.spring)});
    if (s.fixed) e.fixed[dof] = 1;
    e.stiffness[dof][dof] += e.supports.back().spring;
  }
}

/// The stiffness of a bed's pair is the bed's modulus times the tributary length or area of the node. If a
/// polynomial gives the faces, a pair whose face is 0 starts in contact unless bed::closed decides.
template <class Number, class Elements>
void add_pairs(const problem& p, const Elements& elements, equations<Number>& e) {
  for (const contact_pair& c : p.pairs)
    e.pairs.push_back({c.node * dofs_per_node(p.geometry), c.surface, number_of<Number>(c.face),
                       number_of<Number>(c.stiffness), c.closed,
                       c.other < 0 ? -1 : c.other * dofs_per_node(p.geometry)});
  if (p.beds.empty()) return;
  const std::vector<Number> shares = elements.shares();
  for (const bed& b : p.beds) {
    std::vector<int> nodes;
    for (std::size_t i = 0; i < b.share.size(); ++i) {
      nodes.push_back(p.pairs[b.first_pair + i].node);
      e.pairs[b.first_pair + i].stiffness = number_of<Number>(b.modulus) * shares[nodes.back()];
    }
    if (b.face.empty()) continue;
    const auto faces = values_at<Number>(std::get<beam>(p.geometry.kind), b.face, nodes);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      e.pairs[b.first_pair + i].face = faces[i];
      e.pairs[b.first_pair + i].closed = b.closed.value_or(faces[i] == Number(0));
    }
  }
}

template <class Number, class Elements>
[[nodiscard]] loads_in<Number> loads_in_numbers(const load& l, const Elements& elements, std::size_t dofs,
                                                int per_node) {
  loads_in<Number> f{std::vector<Number>(dofs), std::vector<double>(dofs), std::vector<Number>(dofs),
                     std::vector<Number>(dofs)};
  for (const auto& [dof, values] : by_dof(l.points, per_node)) {
    f.force[dof] = sum_of<Number>(values);
    f.size[dof] = size_of(f.force[dof]);
  }
  elements.for_each_work(l, [&](int /*e*/, const auto& work) {
    for (std::size_t i = 0; i < work.dofs.size(); ++i) {
      f.force[work.dofs[i]] += work.force[i];
      f.size[work.dofs[i]] += work.size[i];
    }
  });
  for (const auto& [dof, values] : by_dof(l.settlements, per_node))
    f.settlement[dof] = sum_of<Number>(values);
  for (const auto& [dof, values] : by_dof(l.moves, per_node)) f.moved[dof] = sum_of<Number>(values);
  f.from_zero = l.from_zero;
  return f;
}

/// `p` must outlive the equations, because loads_of uses it.
template <class Number>
[[nodiscard]] equations<Number> equations_of(const problem& p) {
  equations<Number> e;
  e.fixed.assign(dofs(p.geometry), 0);
  e.stiffness.resize(e.fixed.size());
  std::visit(
      [&](const auto& geometry) {
        const auto elements = elements_of<Number>(geometry);
        assemble(geometry, elements, e.stiffness);
        put_on_supports(p, e);
        add_pairs(p, elements, e);
        e.loads_of = [elements, n = e.dofs(), per_node = dofs_per_node(p.geometry)](const load& l) {
          return loads_in_numbers<Number>(l, elements, n, per_node);
        };
      },
      p.geometry.kind);
  return e;
}

}  // namespace contct
