// A linear elastic structure with its supports, candidate contact pairs and loads.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "contct/model/rigid_modes.hpp"
#include "contct/number/double_double.hpp"

namespace contct {

/// The value of a load at one dof of one node.
struct nodal_value {
  int node = 0;         ///< from 0
  int dof = 0;          ///< within the node, from 0
  double value = 0.0;   ///< positive as the dof
  double factor = 1.0;  ///< of a combination; the load is product_of(value, factor)
};
using point_load = nodal_value;               ///< a force or moment, work-conjugate to the dof
using prescribed_displacement = nodal_value;  ///< the displacement of a dof that a support fixes
using face_move = nodal_value;                ///< how far the faces of all pairs at the node are moved

/// A polynomial in a file times `factor` times `times`, multiplied as decimals.
struct scaled_polynomial {
  std::vector<double> coefficients;
  double factor = 1.0;  ///< the factor of a combination
  double times = 1.0;   ///< for self-weight: the area or thickness that multiplies the weight per volume
};

/// Force per length of a beam, as a polynomial in x: a0 + a1 x + a2 x^2 + ...; or force per area of a plate,
/// constant. Positive up.
struct distributed_load {
  std::vector<double> polynomial;  ///< coefficients, constant first; at least one
  std::vector<int> elements;       ///< from 0; empty means all
  /// The file's polynomials whose sum is `polynomial`, for exact arithmetic; empty: `polynomial` itself.
  std::vector<scaled_polynomial> parts = {};
  bool is_self_weight = false;
};

/// The kind of a placed load: a force per length or area, a force at a point, a moment at a point, or an
/// imposed curvature of a beam, as by a temperature gradient.
enum class load_kind { force, point, moment, curvature };

/// An exact place along a line: its point `point`, from 0; if this is -1, the sum of the decimals `x` and
/// `more`.
struct line_place {
  line_place(double at = 0.0) : x(at) {}  // NOLINT(google-explicit-constructor): a number is a place
  double x;                               ///< rounded
  int point = -1;
  std::vector<double> more = {};
  bool operator==(const line_place&) const = default;
  bool operator<(const line_place& o) const {
    return std::tie(x, point, more) < std::tie(o.x, o.point, o.more);
  }
};

/// A load that need not follow the mesh.
struct placed_load {
  load_kind what = load_kind::force;
  line_place from, to;                 ///< along x, from < to; equal for a point between nodes
  std::vector<double> polynomial;      ///< for a force along a beam as in distributed_load; or one number
  std::array<line_place, 2> across{};  ///< a plate's rectangle: from and to along y
  double factor = 1.0;                 ///< multiplies `polynomial`, as decimals
};

/// `polynomial` times `factor`, in doubles.
[[nodiscard]] std::vector<double> values_of(const placed_load& p);

/// A term of a combination: a case, or a train at a place.
struct load_term {
  std::string name;
  double factor = 1.0;
  std::optional<double> at = {};
};

/// Everything that acts on the structure at one moment.
struct load {
  std::vector<point_load> points;
  std::vector<distributed_load> distributed;
  std::vector<prescribed_displacement> settlements = {};
  std::vector<face_move> moves = {};
  std::string name = {};  ///< the step that ends with this load; may be empty
  std::vector<placed_load> placed = {};
  bool from_zero = false;  ///< the step starts from the unloaded structure, not from the step before
  std::vector<load_term> terms = {};  ///< for a combination: the terms that it consists of
};
/// The members of a load that are values at nodes.
inline constexpr std::array nodal_values = {&load::points, &load::settlements, &load::moves};

/// before + fraction * (after - before), with loads at the same place merged; exactly `after` if `fraction`
/// is 1.
[[nodiscard]] load mix(const load& before, const load& after, double fraction);

/// The values at each dof that has any, in the order of the file.
[[nodiscard]] inline std::map<int, std::vector<nodal_value>> by_dof(std::span<const nodal_value> values,
                                                                    int dofs_per_node) {
  std::map<int, std::vector<nodal_value>> at;
  for (const nodal_value& v : values) at[v.node * dofs_per_node + v.dof].push_back(v);
  return at;
}

/// sum += share * part, for coefficients with the constant first.
void add_polynomial(std::vector<double>& sum, std::span<const double> part, double share);

/// The value at x of the polynomial with coefficients `p`, constant first.
template <class Polynomial, class Number>
[[nodiscard]] Number polynomial_at(const Polynomial& p, const Number& x) {
  Number sum(0);
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
  return sum;
}
template <class Polynomial>
[[nodiscard]] Polynomial derivative(const Polynomial& p) {
  using number = typename Polynomial::value_type;
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * number(static_cast<int>(i)));
  return d;
}
/// The integral of p q over x from `from` to `to`.
template <class Number>
[[nodiscard]] Number integral_of(const std::vector<Number>& p, const std::vector<Number>& q,
                                 const Number& from, const Number& to) {
  std::vector<Number> primitive(p.size() + q.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t k = 0; k < q.size(); ++k)
      primitive[i + k + 1] += p[i] * q[k] / static_cast<int>(i + k + 1);
  return polynomial_at(primitive, to) - polynomial_at(primitive, from);
}

/// Calls visit(element) for every element, from 0, that a distributed load acts on.
template <class Visit>
void for_each_loaded_element(const distributed_load& d, int elements, Visit visit) {
  for (const int e : d.elements) visit(e);
  for (int e = 0; d.elements.empty() && e < elements; ++e) visit(e);
}
/// Calls visit(element, polynomial) for every distributed load and every element that it acts on.
template <class Visit>
void for_each_loaded_element(const load& l, int elements, Visit visit) {
  for (const distributed_load& d : l.distributed)
    for_each_loaded_element(d, elements, [&](int e) { visit(e, d.polynomial); });
}

/// A point of a Gauss-Legendre rule on [0, 1].
struct gauss_point {
  double t;       ///< place, between 0 and 1
  double weight;  ///< the weights add up to 1
};

/// The `n` >= 1 points of the rule that is exact for polynomials up to degree 2 n - 1.
[[nodiscard]] std::vector<gauss_point> gauss_points(int n);

/// A permanent support of one dof, in both directions.
struct support {
  int node = 0;          ///< from 0
  int dof = 0;           ///< within the node, from 0
  bool fixed = true;     ///< held in place; otherwise elastic
  double spring = 0.0;   ///< stiffness of an elastic support
  bool settles = false;  ///< fixed, and steps may prescribe a displacement of the dof
};

/// A candidate contact pair: a one-sided spring between a node and a face, which is fixed or belongs to
/// another node. With another node, the pair depends on the difference of the two deflections, and no support
/// fixes either deflection.
struct contact_pair {
  int node = 0;            ///< from 0
  int surface = 0;         ///< n: face_above (+1) or face_below (-1)
  double face = 0.0;       ///< c: the position of the face
  double stiffness = 0.0;  ///< k: the stiffness of the spring, positive
  bool closed = false;     ///< in contact at the start
  int other = -1;          ///< the node with the face, from 0; -1: the face is fixed

  /// w of the node, minus w of `other` if there is one. `u`: displacements, or rows of numbers [dofs].
  template <class Vector>
  [[nodiscard]] auto seen_in(const Vector& u, std::size_t dofs_per_node, std::size_t deflection = 0) const {
    auto w = u[node * dofs_per_node + deflection];
    if (other >= 0) w -= u[other * dofs_per_node + deflection];
    return w;
  }
};

/// n (c - w): the distance of a separated pair from its face at deflection w; 0 if the pair is in contact.
[[nodiscard]] inline double gap_of(const contact_pair& p, double w, bool closed) {
  return closed ? 0.0 : p.surface * (p.face - w);
}

/// -n k (c - w): the contact force of a pair in contact; 0 if the pair is separated. Not clamped: tension is
/// negative.
[[nodiscard]] inline double force_of(const contact_pair& p, double w, bool closed) {
  return closed ? -p.surface * p.stiffness * (p.face - w) : 0.0;
}

/// A structure of any kind. Dof d of node i is dof i * dofs_per_node + d, from 0.
struct linear_structure {
  int dofs_per_node = 0;
  int deflection = 0;          ///< the dof of a node that is its deflection, from 0 (INDOF - 1)
  stiffness_matrix stiffness;  ///< includes elastic supports; rows of fixed dofs are decoupled: see in_row
  std::vector<char> fixed;     ///< [dofs] 1 if a support fixes the dof
  std::vector<char> settles;   ///< [dofs] 1 if steps may prescribe the dof's displacement; empty: all 0
  std::vector<matrix_entry> to_settling;  ///< K's entries in rows of free dofs and columns of settling dofs
  std::vector<contact_pair> pairs;        ///< in the order of pair numbers

  std::vector<int> rows;  ///< [dofs] the row of each dof in `stiffness`; empty: row and dof are equal

  int rigid_motions = 0;  ///< 2 + number of hinges for a beam, 3 for a plate, up to 6 for a matrix
  std::vector<rigid_row> rigid_rows;  ///< [dofs] the displacements by the rigid-body motions
  std::vector<int> supported_dofs;    ///< the dof of each support; empty for a matrix
  /// The exact rigid-body motions of a beam or plate; null for a matrix.
  std::shared_ptr<const rigid_truth> truth;
  std::optional<rigid_rank> on_supports;  ///< held_by_supports(), if `truth` is known
  /// The largest error of `rigid_rows`, relative to the largest row: 0 for beams and plates.
  double rigid_rounding = 0.0;
  double rigid_stiffness = 0.0;  ///< free_motions::stiffness of a matrix

  /// [dofs] 1 if the dof is a deflection; empty: dof `deflection` of each node is the deflection.
  std::vector<char> lengths;

  [[nodiscard]] int dofs() const { return stiffness.order(); }
  /// The row of `dof` in the stiffness matrix, where plates are numbered along their shorter side.
  [[nodiscard]] int row_of(std::size_t dof) const { return rows.empty() ? static_cast<int>(dof) : rows[dof]; }
  /// The right-hand side of K u = f in the row of `dof`. Free dof: its load. Settling dof: the pivot times
  /// the displacement that `load` prescribes. Other fixed dof: 0. The pivot of a settling dof is a power of
  /// four near its former stiffness: the rows keep similar sizes, and u is exact.
  [[nodiscard]] double in_row(std::size_t dof, double load) const {
    if (fixed[dof] == 0) return load;
    return !settles.empty() && settles[dof] != 0 ? stiffness.diagonal(row_of(dof)) * load : 0.0;
  }
  [[nodiscard]] bool deflects(int dof) const {
    return lengths.empty() ? dof % dofs_per_node == deflection : lengths[dof] != 0;
  }
  [[nodiscard]] rigid_rank nothing_held() const {
    return truth ? rigid_rank(*truth) : rigid_rank(rigid_rows, std::max(1e-12, rigid_rounding));
  }
  [[nodiscard]] rigid_rank held_by_supports() const {
    if (on_supports) return *on_supports;
    rigid_rank rank = nothing_held();
    for (std::size_t i = 0; i < supported_dofs.size() && !is_held(rank); ++i) rank.hold(supported_dofs[i]);
    return rank;
  }
  /// The rank of the supported dofs and of each pair i (from 0) for which closed(i) is true.
  template <class Closed>
  [[nodiscard]] rigid_rank held_by(Closed closed) const {
    rigid_rank rank = held_by_supports();
    for (std::size_t i = 0; i < pairs.size() && !is_held(rank); ++i)
      if (closed(i)) hold(rank, i);
    return rank;
  }
  /// True if `rank` includes all rigid-body motions.
  [[nodiscard]] bool is_held(const rigid_rank& rank) const { return rank.rank() >= rigid_motions; }
  /// The rigid-body motion in the direction in which the work grows fastest, among the motions that `held`
  /// leaves free; nothing if the load does no work on any of them. Uses `work` if it is known, otherwise the
  /// rounded `load` [dofs].
  [[nodiscard]] std::optional<free_motion> driven_motion(const rigid_rank& held, std::span<const double> load,
                                                         const rigid_work& work) const;
  /// True if there is an equilibrium under a load that does `work`. Nothing if `truth` or `work` is unknown,
  /// or if the supports leave more than 8 rigid-body motions.
  [[nodiscard]] std::optional<bool> has_equilibrium(const rigid_work& work) const {
    constexpr int most_decided = 8;  // the time of the search doubles with each motion
    if (!truth || !work.is_known() || rigid_motions - held_by_supports().rank() > most_decided)
      return std::nullopt;
    return truth->is_carried(work, supported_dofs, pairs);
  }
  /// Returns the first pairs that stop motions that `rank` leaves free, and counts these pairs as held.
  [[nodiscard]] std::vector<int> pairs_that_hold(rigid_rank& rank) const;
  /// The dof, from 0, of the node of pair `i` (from 0).
  [[nodiscard]] int dof_of_pair(std::size_t i) const { return pairs[i].node * dofs_per_node + deflection; }
  /// The dof that carries the face of pair `i`; -1 if the face is fixed.
  [[nodiscard]] int other_of_pair(std::size_t i) const {
    return pairs[i].other < 0 ? -1 : pairs[i].other * dofs_per_node + deflection;
  }
  /// The relative displacement of pair `i`, from the displacements `u` [dofs].
  template <class Vector>
  [[nodiscard]] auto seen_by_pair(std::size_t i, const Vector& u) const {
    return pairs[i].seen_in(u, dofs_per_node, deflection);
  }
  void hold(rigid_rank& rank, std::size_t i) const { rank.hold(dof_of_pair(i), other_of_pair(i)); }
};

/// Adds supports and pairs to the assembled structure `s`. Springs and fixed dofs change its stiffness.
void put_on_supports(linear_structure& s, std::span<const support> supports, std::vector<contact_pair> pairs);

/// Completes a load vector `f` [dofs], which already contains the loads of `l`: sets settling dofs to the
/// displacements g that `l` prescribes, and adds -K g at free dofs. Throws std::logic_error if a support with
/// a prescribed displacement was not built to settle.
void add_settlements(const linear_structure& s, const load& l, std::span<double> f);

/// Adds to `moved` [dofs] how far `l` moves the faces at each dof.
void add_moves(const load& l, int dofs_per_node, std::span<double> moved);

/// Changes `f` [dofs], which already contains the settlements, to the right-hand side for the displacements
/// v = u - m of a path, where m is how far the faces at a dof are moved. The distance c + m - u of a pair
/// from its face is then c - v with a constant c, and K u = f becomes K v = f - K m.
void count_from_faces(const linear_structure& s, std::span<const double> moved, std::span<double> f);

}  // namespace contct
