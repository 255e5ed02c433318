// The equations of a problem: K, supports, pairs and loads in one kind of number. The certificate uses
// double_double, the exact path uses rational.
#pragma once

#include <algorithm>
#include <boost/container/flat_map.hpp>
#include <functional>
#include <utility>
#include <vector>

#include "contct/structure/elements.hpp"
#include "contct/structure/statics.hpp"

namespace contct {

/// A row of a symmetric matrix: the entries that may differ from 0, by column.
template <class Number>
using sparse_row = boost::container::flat_map<int, Number>;
template <class Number>
using sparse_rows = std::vector<sparse_row<Number>>;

template <class Number>
struct equations {
  sparse_rows<Number> stiffness;  ///< includes elastic supports; rows of fixed dofs are not changed
  std::vector<char> fixed;        ///< [dofs]
  std::vector<support_in<Number>> supports;
  std::vector<pair_in<Number>> pairs;
  std::vector<pair_in<Number>> held;  ///< see bed::held
  std::function<loads_in<Number>(const load&)> loads_of;

  [[nodiscard]] std::size_t dofs() const { return fixed.size(); }

  /// `start` plus row `dof` of K u. Calls also(column, entry) for each entry of the row.
  template <class Vector, class Also>
  [[nodiscard]] Number add_row(std::size_t dof, const Vector& u, Number start, const Also& also) const {
    for (const auto& [column, entry] : stiffness[dof]) {
      start += entry * u[column];
      also(column, entry);
    }
    return start;
  }
  template <class Vector>
  [[nodiscard]] Number add_row(std::size_t dof, const Vector& u, Number start) const {
    return add_row(dof, u, std::move(start), [](int /*column*/, const Number& /*entry*/) {});
  }

  /// K u - f + sum of n k max(0, d) over all pairs, whatever their statuses: 0 at free dofs in equilibrium,
  /// the reaction at fixed dofs [dofs]. f: the force of `l`; d: the depth of a pair beyond its moved face.
  template <class Vector>
  [[nodiscard]] std::vector<Number> needed(const Vector& u, const loads_in<Number>& l) const {
    std::vector<Number> all;
    all.reserve(dofs());
    for (std::size_t dof = 0; dof < dofs(); ++dof) all.push_back(add_row(dof, u, -l.force[dof]));
    for (const auto* const list : {&pairs, &held})
      for (const pair_in<Number>& p : with_moved_faces(*list, l.moved)) add_pressing(p, u, all);
    return all;
  }
  /// The loads for displacements relative to the faces, as right_hand_side has them: the force is 0 at fixed
  /// dofs, and includes K times the settlements, and at free dofs times the moves of faces. At fixed dofs,
  /// settlements are relative to the faces.
  [[nodiscard]] loads_in<Number> from_faces(loads_in<Number> l) const {
    for (std::size_t dof = 0; dof < dofs(); ++dof) {
      const Number& shift = fixed[dof] != 0 ? l.settlement[dof] : l.moved[dof];
      if (!(shift == Number(0)))
        for (const auto& [row, k] : stiffness[dof]) l.force[row] -= k * shift;
    }
    for (std::size_t dof = 0; dof < dofs(); ++dof) {
      if (fixed[dof] != 0) l.force[dof] = 0;
      l.settlement[dof] = fixed[dof] != 0 ? Number(l.settlement[dof] - l.moved[dof]) : Number(0);
    }
    return l;
  }

  /// Adds the force of a pair beyond its face, also if its depth is not a number.
  template <class Vector>
  static void add_pressing(const pair_in<Number>& p, const Vector& u, std::vector<Number>& needed) {
    const Number w = p.seen_in(u);
    const Number depth = depth_of(p, w);
    if (!(depth < Number(0) || depth == Number(0)))
      p.add_to(needed, Number(p.surface * force_of(p, w, true)));
  }
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
  for (std::size_t dof = 0; dof < e.dofs(); ++dof) e.stiffness[dof][static_cast<int>(dof)] += Number(0);
  e.supports = supports_in<Number>(p.supports, dofs_per_node(p.geometry));
  for (const support_in<Number>& s : e.supports) {
    if (s.fixed) e.fixed[s.dof] = 1;
    e.stiffness[s.dof][s.dof] += s.spring;
  }
}

/// The stiffness of a bed's pair is the bed's modulus times the share of the node. If a polynomial gives the
/// faces, a pair whose face is 0 starts in contact unless bed::closed decides.
template <class Number, class Elements>
void add_pairs(const problem& p, const Elements& elements, equations<Number>& e) {
  e.pairs = pairs_in<Number>(p.pairs, dofs_per_node(p.geometry));
  if (p.beds.empty()) return;
  const std::vector<Number> shares = elements.shares();
  for (const bed& b : p.beds) {
    std::vector<pair_in<Number>> held = pairs_in<Number>(b.held, dofs_per_node(p.geometry));
    std::vector<pair_in<Number>*> all;
    std::vector<int> nodes;
    for (std::size_t i = 0; i < b.share.size() + held.size(); ++i) {
      all.push_back(i < b.share.size() ? &e.pairs[b.first_pair + i] : &held[i - b.share.size()]);
      nodes.push_back(all.back()->dof / dofs_per_node(p.geometry));
    }
    const bed_springs springs = springs_of(p.geometry, b.parts);
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i]->stiffness = b.parts.empty() ? Number(number_of<Number>(b.modulus) * shares[nodes[i]])
                                          : nearest<Number>(springs.stiffness[nodes[i]]);
    if (!b.face.empty()) {
      const auto faces = values_at<Number>(std::get<beam>(p.geometry.kind), b.face, nodes);
      for (std::size_t i = 0; i < faces.size(); ++i) {
        all[i]->face = faces[i];
        all[i]->closed = b.closed.value_or(faces[i] == Number(0));
      }
    }
    e.held.insert(e.held.end(), held.begin(), held.end());
  }
}

template <template <class> class Elements, class Number>
[[nodiscard]] loads_in<Number> loads_in_numbers(const load& l, const Elements<Number>& elements,
                                                std::size_t dofs, int per_node) {
  const auto at_dofs = [dofs, per_node](const std::vector<nodal_value>& values) {
    return sums_at_dofs<Number>(values, dofs, per_node);
  };
  loads_in<Number> f{at_dofs(l.points), std::vector<double>(dofs), at_dofs(l.settlements), at_dofs(l.moves),
                     l.from_zero};
  std::ranges::transform(f.force, f.size.begin(), size_of<Number>);
  elements.for_each_work(l, [&](int /*e*/, const auto& work) {
    for (std::size_t i = 0; i < work.dofs.size(); ++i) {
      f.force[work.dofs[i]] += work.force[i];
      f.size[work.dofs[i]] += work.size[i];
    }
  });
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
          return loads_in_numbers(l, elements, n, per_node);
        };
      },
      p.geometry.kind);
  return e;
}

}  // namespace contct
