// A linear elastic structure with its supports, candidate contact pairs and loads.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "contct/linear/system.hpp"
#include "contct/number/double_double.hpp"
#include "contct/structure/rigid_modes.hpp"

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

/// The kind of a placed load: a force per length or area, a force at a point, a moment at a point of a beam
/// or spread over a rectangle of a plate, or an imposed curvature of a beam, as by a temperature gradient.
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
  line_place from, to;  ///< along x, from < to; equal for a point between nodes
  /// For a force along a beam as in distributed_load; for a moment on a plate its totals, which do work on wx
  /// and wy; otherwise one number.
  std::vector<double> polynomial;
  std::array<line_place, 2> across{};  ///< a plate's rectangle: from and to along y
  double factor = 1.0;                 ///< multiplies `polynomial`, as decimals

  [[nodiscard]] bool is_at_point() const { return from == to; }
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

/// Calls visit(element, polynomial) for every distributed load and every element, from 0, that it acts on.
template <class Visit>
void for_each_loaded_element(const load& l, int elements, Visit visit) {
  for (const distributed_load& d : l.distributed) {
    for (const int e : d.elements) visit(e, d.polynomial);
    for (int e = 0; d.elements.empty() && e < elements; ++e) visit(e, d.polynomial);
  }
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

/// A candidate contact pair of a problem: a one-sided spring between a node and a face, which is fixed or
/// belongs to another node. With another node, the pair depends on the difference of the two deflections, and
/// no support fixes either deflection.
struct contact_pair {
  int node = 0;            ///< from 0
  int surface = 0;         ///< n: face_above (+1) or face_below (-1)
  double face = 0.0;       ///< c: the position of the face
  double stiffness = 0.0;  ///< k: the stiffness of the spring, positive
  bool closed = false;     ///< in contact at the start
  int other = -1;          ///< the node with the face, from 0; -1: the face is fixed
};

template <class Number>
struct support_in {
  int dof = 0;
  bool fixed = false;
  Number spring = Number(0);
  /// False for a fixed support whose dof an earlier support fixes too: that one gets the whole reaction.
  bool reacts = true;

  /// The force of the support on the structure under displacements `u` [dofs]. Elastic support: minus spring
  /// times displacement. Fixed support: needed(dof), where `needed` is as equations::needed.
  template <class Vector, class Needed>
  [[nodiscard]] Number force(const Vector& u, const Needed& needed) const {
    if (!fixed) return -spring * u[dof];
    return reacts ? Number(needed(dof)) : Number(0);
  }
};

// The law of a pair, once for all kinds of number. `Pair`: contact_pair or pair_in. w: see seen_in.

/// n (w - c): the depth of a pair beyond its face; negative before the face.
template <class Pair, class Number>
[[nodiscard]] Number depth_of(const Pair& p, const Number& w) {
  return p.surface * (w - p.face);
}

/// n (c - w): the distance of a separated pair from its face; 0 if the pair is in contact.
template <class Pair, class Number>
[[nodiscard]] Number gap_of(const Pair& p, const Number& w, bool closed) {
  return closed ? Number(0) : Number(p.surface * (p.face - w));
}

/// -n k (c - w): the contact force of a pair in contact; 0 if the pair is separated. Not clamped: tension is
/// negative.
template <class Pair, class Number>
[[nodiscard]] Number force_of(const Pair& p, const Number& w, bool closed) {
  return closed ? Number(-p.surface * p.stiffness * (p.face - w)) : Number(0);
}

/// The loads at the end of a step.
template <class Number>
struct loads_in {
  std::vector<Number> force;       ///< [dofs] consistent loads
  std::vector<double> size;        ///< [dofs] the sum of the magnitudes of the parts of `force`: see size_of
  std::vector<Number> settlement;  ///< [dofs] the prescribed displacements; 0 at other dofs
  std::vector<Number> moved;       ///< [dofs] how far the faces of the pairs at the dof are moved
  bool from_zero = false;          ///< see load::from_zero

  [[nodiscard]] bool moves_faces() const {
    return std::any_of(moved.begin(), moved.end(), [](const Number& m) { return !(m == Number(0)); });
  }
};

/// The equations of a structure of any kind, and its rigid-body motions.
struct linear_structure : linear_system {
  int rigid_motions = 0;              ///< as many as a beam has corners, 3 for a plate, up to 6 for a matrix
  std::vector<rigid_row> rigid_rows;  ///< [dofs] the displacements by the rigid-body motions
  std::vector<int> supported_dofs;    ///< the dof of each support; empty for a matrix
  /// The exact rigid-body motions of a beam or plate; null for a matrix.
  std::shared_ptr<const rigid_truth> truth;
  std::optional<rigid_rank> on_supports;  ///< held_by_supports(), if `truth` is known
  /// The largest error of `rigid_rows`, relative to the largest row: 0 for beams and plates.
  double rigid_rounding = 0.0;
  double rigid_stiffness = 0.0;  ///< free_motions::stiffness of a matrix

  /// [dofs] 1 if the dof is a deflection; empty: the first dof of each node is its deflection.
  std::vector<char> lengths;

  [[nodiscard]] bool deflects(int dof) const {
    return lengths.empty() ? dof % dofs_per_node == 0 : lengths[dof] != 0;
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
    if (!truth || !work || rigid_motions - held_by_supports().rank() > most_decided) return std::nullopt;
    return truth->is_carried(work, supported_dofs, pairs);
  }
  /// Returns the first pairs that stop motions that `rank` leaves free, and counts these pairs as held.
  [[nodiscard]] std::vector<int> pairs_that_hold(rigid_rank& rank) const;
  /// Counts the motions as held that pair `i`, from 0, stops.
  void hold(rigid_rank& rank, std::size_t i) const { rank.hold(pairs[i].dof, pairs[i].other); }
};

/// Adds supports and pairs to the assembled structure `s`. Springs and fixed dofs change its stiffness.
void put_on_supports(linear_structure& s, std::span<const support> supports,
                     std::vector<pair_in<double>> pairs);

/// The right-hand side under `l` [dofs] for the displacements v = u - m of a path, where m is how far the
/// faces at a dof are moved. The distance c + m - u of a pair from its face is then c - v with a constant c,
/// and K u = f becomes K v = f - K m. At settling dofs it is their prescribed displacement relative to the
/// faces, and K times this displacement acts at free dofs. Throws std::logic_error if a support with a
/// prescribed displacement was not built to settle.
[[nodiscard]] std::vector<double> right_hand_side(const linear_structure& s, const loads_in<double>& l);

}  // namespace contct
