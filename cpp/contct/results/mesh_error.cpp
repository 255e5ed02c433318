#include "contct/results/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "contct/proof/error_bounds.hpp"
#include "contct/results/step_results.hpp"

namespace contct {
namespace {

using poly = line_polynomial<double>;

constexpr double close = 1e-10;  // relative accuracy of extremes

double bound_on_most(const poly& p) {
  return bound_on_largest(p, close * sum_of_sizes(p));
}

poly negative(poly p) {
  for (double& c : p) c = -c;
  return p;
}

/// A bound that is far away from most polynomials' values.
double rough_bound_on_most(const poly& p) {
  const double sizes = sum_of_sizes(p);
  return p.front() - std::abs(p.front()) + sizes + 0x1p-48 * sizes;
}

/// The larger of `most` and bound_on_most(p).
double most_of(double most, const poly& p) {
  return rough_bound_on_most(p) <= most ? most : std::max(most, bound_on_most(p));
}

/// A bound on the depth d of a bed where P and d have different signs.
double wrong_in(const line_part& part, const bed_along& b, const poly& d) {
  return most_of(-part.slack, b.pressed.length() > 0.0 ? negative(d) : d) + part.slack;
}

/// The integral from 0 to 1.
double mean_of(const poly& p) {
  double sum = 0.0;
  for (std::size_t i = p.size(); i > 0; --i) sum += p[i - 1] / static_cast<double>(i);
  return sum;
}

/// Does p exceed `least` along a stretch, and certainly?
bool exceeds(const poly& p, double least, const stretch& s) {
  if (-rough_bound_on_most(negative(p)) > least) return true;
  const auto part =
      formulas::in_element<double>(std::span<const double>(p.data(), p.size()), s.from, s.length());
  return -bound_on_most(negative(poly(part.begin(), part.end()))) - 0x1p-45 * sum_of_sizes(p) > least;
}

/// A stretch of a part along which the depth d certainly exceeds `least`; empty if none is found. Begins with
/// almost the whole part, and takes away more and more of the ends where d is too small.
stretch stretch_beyond(const poly& d, double least) {
  const std::array<bool, 2> cut = {d.front() <= least, polynomial_at(d, 1.0) <= least};
  for (int halvings = 8; halvings > 1; --halvings) {
    const double share = std::ldexp(1.0, -halvings);
    const stretch s{cut[0] ? share : 0.0, cut[1] ? 1.0 - share : 1.0};
    if (exceeds(d, least, s)) return s;
  }
  return {};
}

/// A bound from below on the share of a stretch along which d exceeds `least`; an end of contact is off by at
/// most 2^-20 of the part.
double share_beyond(const poly& d, double least, const stretch& s = {0.0, 1.0}) {
  if (exceeds(d, least, s)) return s.length();
  const bool stays_below = sum_of_sizes(d) <= least || exceeds(negative(d), -least, s);
  if (s.length() < 0x1p-19 || stays_below) return 0.0;
  const double middle = s.from + s.length() / 2;
  return share_beyond(d, least, {s.from, middle}) + share_beyond(d, least, {middle, s.to});
}

/// The pressure, the force and the length in contact of a bed under w1.
struct bed_under_line {
  double pressure = 0.0, pressure_bound = 0.0;
  double least_pressure = std::numeric_limits<double>::infinity();
  double_double force = {};
  double force_bound = 0.0;
  double_double least_contact = {}, most_contact = {};
};

class mesh_prover {
 public:
  /// All arguments must outlive this object.
  mesh_prover(const step_results& told, const by_quantity& allowed, bed_line& line)
      : told_(told),
        allowed_(allowed),
        line_(line),
        system_(*line.with_pressed),
        left_(system_.residual(line.u, line.loads())) {}

  /// Proves A, rho and Xh. Returns why this failed, or "".
  [[nodiscard]] std::string find_rho();
  /// Sets the errors of the printed numbers.
  void compare(mesh_error& e) const;

 private:
  void measure();
  [[nodiscard]] bool hold();
  void sum_up();
  [[nodiscard]] bool shrink();
  /// C of a dof, and of w in an element.
  [[nodiscard]] double reach(std::size_t dof) const {
    return system_.fixed[dof] != 0 ? 0.0 : scale_[dof] * root_;
  }
  [[nodiscard]] double reach_in(const line_element& on) const {
    const auto largest = [&](std::size_t i) { return std::max(reach(on.dofs[i]), reach(on.dofs[i + 2])); };
    return largest(0) + on.h.hi / 4 * largest(1) + std::sqrt(std::pow(on.h.hi, 3) / 192 / on.EI.hi);
  }
  /// The squares of the bounds for a moment and for a shear, divided by Xh, at an end of an element or
  /// inside.
  [[nodiscard]] static double moment_square(const line_element& on, bool inside) {
    const double h = on.h.hi;
    return (inside ? 8 : 4) * on.EI.hi / h + on.modulus() * h * h * h / 105;
  }
  [[nodiscard]] static double shear_square(const line_element& on, bool inside) {
    const double h = on.h.hi;
    return (inside ? 96 : 12) * on.EI.hi / (h * h * h) + on.modulus() * h * 13 / 35;
  }
  void compare_nodes(mesh_error& e) const;
  void compare_elements(mesh_error& e) const;
  void compare_supports(mesh_error& e) const;
  void compare_pairs(mesh_error& e) const;
  [[nodiscard]] bed_under_line find_bed(std::size_t bed) const;
  void compare_beds(mesh_error& e) const;
  void compare_extremes(mesh_error& e) const;

  const step_results& told_;
  const by_quantity& allowed_;  // certificate::allowed
  bed_line& line_;
  const long_system& system_;
  long_residual left_;
  std::vector<double> scale_;        // S of K_A
  double root_ = 0.0;                // sqrt((1 + eta) / mu)
  double rho_ = 0.0, forces_ = 0.0;  // forces_: Xh
};

/// Bounds |r| in all parts, and begins A with all stretches and pairs that press.
void mesh_prover::measure() {
  double deepest = 0.0;
  for (line_element& on : line_.elements)
    for (line_part& part : on.parts)
      for (const bed_along& b : part.beds) deepest = most_of(deepest, part.depth(b));
  for (line_element& on : line_.elements)
    for (line_part& part : on.parts) {
      const double late = sum_of_sizes(part.late()) + part.slack_of_b;
      for (bed_along& b : part.beds) {
        const poly d = part.depth(b);
        const bool presses = b.pressed.length() > 0.0;
        part.off += b.modulus.hi * ((presses ? late : 0.0) + wrong_in(part, b, d));
        b.certain = stretch_beyond(d, 0x1p-20 * deepest + part.slack);
      }
    }
  for (std::size_t i = 0; i < system_.pairs.size(); ++i)
    if (system_.depth(i, line_.u).hi > 0.0) line_.closed.push_back(static_cast<int>(i));
}

/// Factors K_A, and proves mu and eta.
bool mesh_prover::hold() {
  const long_system system = line_.system_with(&bed_along::certain);
  scaled_stiffness held = line_.scaled(system);
  const double mu = held.factor(line_.closed) ? held.least_eigenvalue() : 0.0;
  line_.held = held.proof();
  double eta = 0.0;
  for (const line_element& on : line_.elements)
    eta = std::max(eta, on.modulus() * std::pow(on.h.hi, 4) / 500.56 / on.EI.hi);
  root_ = std::sqrt((1 + eta) / mu) * (1 + summation_slack);
  scale_.clear();
  for (std::size_t dof = 0; dof < system.dofs(); ++dof) scale_.push_back(held.scale(dof));
  return mu > 0.0;
}

/// rho and Xh by A.
void mesh_prover::sum_up() {
  double nodal = 0.0;   // squares
  double inside = 0.0;  // A, squares
  double all = 0.0;     // all beds, squares
  double outside = 0.0;
  for (std::size_t dof = 0; dof < system_.dofs(); ++dof) {
    const double off = reach(dof) * (std::abs(left_.force[dof].hi) + left_.slack[dof]);
    nodal += off * off;
  }
  for (const line_element& on : line_.elements)
    for (const line_part& part : on.parts) {
      if (part.beds.empty()) continue;
      const double h = part.load.h.hi;
      const auto of_A =
          std::ranges::max_element(part.beds, {}, [](const bed_along& b) { return b.certain.length(); });
      const double share = of_A->certain.length();
      inside += share * h * part.off * part.off / of_A->modulus.hi;
      all += h * part.off * part.off / part.modulus();
      outside += reach_in(on) * ((1 - share) * part.off + part.modulus() * part.slack_of_b) * h;
    }
  rho_ = (std::sqrt(nodal) + std::sqrt(inside) + outside) * (1 + summation_slack);
  forces_ = (rho_ + std::sqrt(all)) * (1 + summation_slack);
}

/// Takes out of A what may not press; false if nothing was taken out.
bool mesh_prover::shrink() {
  bool any = false;
  for (line_element& on : line_.elements) {
    const double least = reach_in(on) * rho_ * (1 + summation_slack);
    for (line_part& part : on.parts)
      for (bed_along& b : part.beds) {
        if (b.certain.length() == 0.0) continue;
        const poly d = part.depth(b);
        if (exceeds(d, least + part.slack, b.certain)) continue;
        b.certain = stretch_beyond(d, 2 * least + part.slack);
        any = true;
      }
  }
  return std::erase_if(line_.closed,
                       [&](int i) {
                         return !(system_.depth(i, line_.u).hi - system_.doubt(i, line_.u) >
                                  reach(system_.pairs[i].dof) * rho_);
                       }) > 0 ||
         any;
}

std::string mesh_prover::find_rho() {
  constexpr int most = 12;
  measure();
  for (int i = 0; i < most; ++i) {
    if (!hold()) return "it is not certain that contact holds the beam; use a finer mesh (element_size)";
    sum_up();
    if (!std::isfinite(forces_)) break;
    if (!shrink()) return "";
  }
  return "it is not certain where the beds press; use a finer mesh (element_size)";
}

void mesh_prover::compare_nodes(mesh_error& e) const {
  for (int node = 0; node < nodes(told_.what.geometry); ++node)
    for (const int dof : {0, 1}) {
      const std::size_t at = std::size_t{2} * line_.mesh->at(node) + dof;
      e.take(name_of(dof == 0 ? quantity::w : quantity::slope), told_.state.displacement[2 * node + dof],
             line_.u[at].hi, reach(at) * rho_);
    }
}

void mesh_prover::compare_elements(mesh_error& e) const {
  for (int i = 0; i < elements(told_.what.geometry); ++i) {
    const line_element& left = line_.elements[line_.mesh->at(i)];
    const line_element& right = line_.elements[line_.mesh->at(i + 1) - 1];
    const line_part& first = left.parts.front();  // a load at its left end does not act there yet
    const line_part& last = right.parts.back();
    const auto take = [&](quantity kind, std::size_t name, double at_left, double at_right, auto square) {
      const auto printed = told_.elements.at(i, name);
      const double over = kind == quantity::shear ? left.h.hi : 1.0;
      e.take(name_of(kind), printed[0], at_left,
             std::sqrt(square(left, false)) * forces_ + left.slack / over);
      e.take(name_of(kind), printed[1], at_right,
             std::sqrt(square(right, false)) * forces_ + right.slack / over);
    };
    take(quantity::shear, 0, first.shear[0] - first.load.force.hi, polynomial_at(last.shear, 1.0),
         shear_square);
    take(quantity::moment, 1, first.moment[0] + first.load.moment.hi, polynomial_at(last.moment, 1.0),
         moment_square);
  }
}

void mesh_prover::compare_supports(mesh_error& e) const {
  for (std::size_t i = 0; i < system_.supports.size(); ++i) {
    const auto& s = system_.supports[i];
    const std::size_t node = s.dof / 2;
    const double_double force = s.force(line_.u, [this](int dof) { return left_.needed[dof]; });
    double bound = std::min(std::sqrt(s.spring.hi), s.spring.hi * reach(s.dof)) * rho_;
    if (s.fixed) {
      double squares = 0.0;
      for (std::size_t on = node == 0 ? 0 : node - 1; on <= node && on < line_.elements.size(); ++on)
        squares += s.dof % 2 == 0 ? shear_square(line_.elements[on], false)
                                  : moment_square(line_.elements[on], false);
      bound = std::sqrt(squares) * forces_ + left_.slack[s.dof];
    }
    e.take(name_of(s.dof % 2 == 0 ? quantity::reaction : quantity::moment), told_.reactions[i], force.hi,
           bound);
  }
}

void mesh_prover::compare_pairs(mesh_error& e) const {
  const problem& p = told_.what;
  std::map<int, std::array<double, 3>> pressures;  // of all beds at a node: printed, of w1, bound
  const auto compare_pair = [&](std::size_t i, double share) {
    const pair_reading& at = told_.pairs[i];
    const double k = p.pairs[i].stiffness;
    const std::size_t dof = std::size_t{2} * line_.mesh->at(p.pairs[i].node);
    const double w = line_.u[dof].hi;
    const double deep = p.pairs[i].surface * (w - at.face);
    const double rounding = 0x1p-48 * (std::abs(w) + std::abs(at.face));
    const double moved = reach(dof) * rho_ + rounding;
    const double force = k * std::max(deep, 0.0);
    e.take(name_of(quantity::gap), at.gap, std::max(-deep, 0.0), moved);
    e.take(name_of(quantity::force), at.force, force,
           share > 0.0 ? k * moved : std::min(k * moved, std::sqrt(k) * rho_ + k * rounding));
    if (share == 0.0) return;
    e.take(pressure_name, at.force / share, force / share, k / share * moved);
    std::array<double, 3>& sum = pressures[p.pairs[i].node];
    sum = {sum[0] + at.force / share, sum[1] + force / share, sum[2] + k / share * moved};
  };
  for (std::size_t i = 0; i < contacts_of(p); ++i) compare_pair(i, 0.0);
  for (const bed& b : p.beds)
    for (std::size_t i = 0; i < b.share.size(); ++i) compare_pair(b.first_pair + i, b.share[i]);
  for (const auto& [node, sum] : pressures) e.take(pressure_name, sum[0], sum[1], sum[2]);
}

bed_under_line mesh_prover::find_bed(std::size_t bed) const {
  bed_under_line sum;
  double_double stiffness;
  for (const line_element& on : line_.elements)
    for (const line_part& part : on.parts)
      for (const bed_along& b : part.beds) {
        if (b.bed != bed) continue;
        const poly d = part.depth(b);
        const double h = part.load.h.hi;
        const double k = b.modulus.hi;
        const double moved = reach_in(on) * rho_ + part.slack;
        sum.pressure = k * most_of(sum.pressure / k, d);
        sum.least_pressure = std::min(sum.least_pressure, k * -most_of(-sum.least_pressure / k, negative(d)));
        sum.pressure_bound = std::max(sum.pressure_bound, k * moved);
        if (b.pressed.length() > 0.0) sum.force += k * h * mean_of(d);
        sum.force_bound += k * h * (wrong_in(part, b, d) + part.slack + 0x1p-48 * sum_of_sizes(d));
        stiffness += k * h;
        sum.least_contact += h * share_beyond(d, moved);
        sum.most_contact += h * (1.0 - share_beyond(negative(d), moved));
      }
  sum.force_bound += std::sqrt(stiffness.hi) * rho_;
  return sum;
}

void mesh_prover::compare_beds(mesh_error& e) const {
  const std::vector<bed_reading> printed = beds_in(told_);
  for (std::size_t bed = 0; bed < printed.size(); ++bed) {
    const bed_under_line now = find_bed(bed);
    e.take(pressure_name, printed[bed].pressure.most.value, now.pressure,
           now.pressure_bound + close * now.pressure);
    e.take(pressure_name, printed[bed].pressure.least.value, std::max(0.0, now.least_pressure),
           now.pressure_bound + close * now.pressure);
    e.take(bed_force_name, printed[bed].force, now.force.hi, now.force_bound);
    const double half = (now.most_contact - now.least_contact).hi / 2;
    e.take(bed_contact_name, printed[bed].contact, now.least_contact.hi + half, half);
  }
}

void mesh_prover::compare_extremes(mesh_error& e) const {
  const std::array all = {&line_part::w, &line_part::moment, &line_part::shear};
  constexpr std::array kinds = {quantity::w, quantity::moment, quantity::shear};
  bool is_close = true;  // w1 is
  for (std::size_t i = 0; i < all.size(); ++i) {
    const value_range& printed = told_.ranges()[i];
    true_extremes& now = e.extremes.emplace_back(
        true_extremes{name_of(kinds[i]).key, printed.least.value, printed.most.value,
                      std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
    double bound = 0.0;
    double size = 0.0;
    for (const line_element& on : line_.elements) {
      const double square = i == 1 ? moment_square(on, true) : shear_square(on, true);
      const double slack = i == 0 ? on.parts.front().slack : on.slack / (i == 1 ? 1.0 : on.h.hi);
      bound = std::max(bound, (i == 0 ? reach_in(on) * rho_ : std::sqrt(square) * forces_) + slack);
      for (const line_part& part : on.parts) {
        const poly& p = part.*all[i];
        now.least = -most_of(-now.least, negative(p));
        now.most = most_of(now.most, p);
        size = std::max(size, sum_of_sizes(p));
      }
    }
    e.take(name_of(kinds[i]), now.told_least, now.least, bound + close * size);
    e.take(name_of(kinds[i]), now.told_most, now.most, bound + close * size);
    is_close = is_close && bound <= allowed_[kinds[i]].value_or(0.0);
  }
  if (!is_close) e.extremes.clear();
}

void mesh_prover::compare(mesh_error& e) const {
  compare_extremes(e);
  compare_nodes(e);
  compare_elements(e);
  compare_supports(e);
  compare_pairs(e);
  compare_beds(e);
}

}  // namespace

void mesh_error::take(const quantity_name& kind, double printed, double exact, double bound) {
  auto at = std::ranges::find(numbers, kind.key, &mesh_number::key);
  if (at == numbers.end()) at = numbers.insert(at, {kind.key});
  const double error =
      (std::abs(printed - exact) + bound) * (1 + summation_slack) + 0x1p-48 * std::abs(exact);
  at->error = std::isnan(error) ? std::numeric_limits<double>::infinity() : std::max(at->error, error);
  at->of = std::max(at->of, std::abs(printed));
}

bool mesh_error::is_within(double share) const {
  return not_proved.empty() && std::ranges::all_of(numbers, [share](const mesh_number& n) {
           return n.key == name_of(quantity::gap).key || n.error <= share * n.of;
         });
}

mesh_error largest_of(std::span<const mesh_error> all) {
  mesh_error largest;
  for (const mesh_error& e : all) {
    if (!e.not_proved.empty()) return {e.not_proved};
    for (const mesh_number& n : e.numbers) {
      auto most = std::ranges::find(largest.numbers, n.key, &mesh_number::key);
      if (most == largest.numbers.end()) most = largest.numbers.insert(most, n);
      most->error = std::max(most->error, n.error);
      most->of = std::max(most->of, n.of);
    }
    if (&e == &all.front() || e.extremes.empty()) largest.extremes = e.extremes;
    for (std::size_t i = 0; i < largest.extremes.size(); ++i) {
      true_extremes& most = largest.extremes[i];
      most.told_least = std::min(most.told_least, e.extremes[i].told_least);
      most.told_most = std::max(most.told_most, e.extremes[i].told_most);
      most.least = std::min(most.least, e.extremes[i].least);
      most.most = std::max(most.most, e.extremes[i].most);
    }
  }
  return largest;
}

fine_mesh finely_divided(const problem& p) {
  fine_mesh mesh{p};
  const auto bends = [&mesh](double most) {  // k h^4 / EI of an element
    const auto& b = std::get<beam>(mesh.fine.geometry.kind);
    const auto modulus_on = [&](int e) {
      double sum = 0.0;
      for (const bed& on : mesh.fine.beds)
        for (const bed_part& part : on.parts)
          if (part.from[0].x < b.x[e + 1] && b.x[e] < part.to[0].x) sum += part.modulus;
      return sum;
    };
    for (int e = 0; e < b.elements(); ++e)
      if (modulus_on(e) * std::pow(b.length_of(e), 4) > most * b.EI[e]) return true;
    return false;
  };
  const std::vector<double>& x = std::get<beam>(p.geometry.kind).x;
  std::array<line_place, 2> ends = {x.front(), x.back()};
  ends[0].point = 0;
  ends[1].point = elements(p.geometry);
  for (bed& b : mesh.fine.beds)
    if (b.parts.empty() && b.nodes.size() == x.size()) {
      b.parts = {{{ends[0]}, {ends[1]}, b.modulus}};
      b.nodes.clear();
    }
  if (std::ranges::any_of(mesh.fine.beds, [](const bed& b) { return b.parts.empty(); }))
    mesh = {refined(p), 1};  // ends of beds are then nodes
  constexpr int most_elements = 1 << 16;
  while (mesh.halvings < 6 && elements(mesh.fine.geometry) < most_elements && bends(1.0))
    mesh = {refined(mesh.fine), mesh.halvings + 1};
  mesh.coarse = bends(10.0);  // so that P lacks 50 times less after each pass
  return mesh;
}

mesh_error mesh_error_of(const problem& p, const std::shared_ptr<const fine_mesh>& mesh,
                         const solved_step& s) {
  mesh_error e;
  if (!std::get<beam>(p.geometry.kind).GA.empty())
    e.not_proved = "with shear flexibility, nothing is proved about beds";
  else if (mesh->coarse)
    e.not_proved = "the elements are too long for the beds; use a finer mesh (element_size)";
  else if (!s.judged || !s.judged->certified)
    e.not_proved = "the state is not certified";
  if (!e.not_proved.empty()) return e;
  const auto line = std::make_shared<bed_line>(p, mesh, s);
  e.not_proved = line->settle();
  if (!e.not_proved.empty()) return e;
  const step_results told(p, s);
  mesh_prover prover(told, s.judged->allowed, *line);
  e.not_proved = prover.find_rho();
  if (e.not_proved.empty()) prover.compare(e);
  if (e.not_proved.empty() && !line->settled && !e.is_within(1.0))
    return {"contact and pressure do not settle; use a finer mesh (element_size)"};
  e.line = line;
  return e;
}

}  // namespace contct
