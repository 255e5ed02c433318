#include "contct/results/mesh_error.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "contct/proof/bed_bound.hpp"
#include "contct/proof/polynomial_bounds.hpp"
#include "contct/results/step_results.hpp"

namespace contct {
namespace {

using poly = line_polynomial<double>;

/// The pressure, the force and the length in contact of a bed under w1.
struct bed_under_line {
  double pressure = 0.0, pressure_bound = 0.0;
  double least_pressure = std::numeric_limits<double>::infinity();
  double_double force = {};
  double force_bound = 0.0;
  double_double least_contact = {}, most_contact = {};
};

class mesh_comparison {
 public:
  /// All arguments must outlive this object.
  mesh_comparison(const step_results& told, const by_quantity& allowed, const bed_line& line,
                  const bed_bound& bound)
      : told_(told), allowed_(allowed), line_(line), bound_(bound), system_(*line.with_pressed) {}

  /// Sets the errors of the printed numbers.
  void compare(mesh_error& e) const {
    compare_extremes(e);
    compare_nodes(e);
    compare_elements(e);
    compare_supports(e);
    compare_pairs(e);
    compare_beds(e);
  }

 private:
  void compare_nodes(mesh_error& e) const {
    for (int node = 0; node < nodes(told_.what.geometry); ++node)
      for (const int dof : {0, 1}) {
        const std::size_t at = std::size_t{2} * line_.mesh->at(node) + dof;
        e.take(name_of(dof == 0 ? quantity::w : quantity::slope), told_.state.displacement[2 * node + dof],
               line_.u[at].hi, bound_.reach(at) * bound_.rho());
      }
  }

  void compare_elements(mesh_error& e) const {
    for (int i = 0; i < elements(told_.what.geometry); ++i) {
      const line_element& left = line_.elements[line_.mesh->at(i)];
      const line_element& right = line_.elements[line_.mesh->at(i + 1) - 1];
      const line_part& first = left.parts.front();  // a load at its left end does not act there yet
      const line_part& last = right.parts.back();
      const auto take = [&](quantity kind, std::size_t name, double at_left, double at_right, auto bound) {
        const auto printed = told_.elements.at(i, name);
        const double over = kind == quantity::shear ? left.h.hi : 1.0;
        e.take(name_of(kind), printed[0], at_left, (bound_.*bound)(left, false) + left.slack / over);
        e.take(name_of(kind), printed[1], at_right, (bound_.*bound)(right, false) + right.slack / over);
      };
      take(quantity::shear, 0, first.shear[0] - first.load.force.hi, polynomial_at(last.shear, 1.0),
           &bed_bound::of_shear);
      take(quantity::moment, 1, first.moment[0] + first.load.moment.hi, polynomial_at(last.moment, 1.0),
           &bed_bound::of_moment);
    }
  }

  void compare_supports(mesh_error& e) const {
    for (std::size_t i = 0; i < system_.supports.size(); ++i) {
      const auto& s = system_.supports[i];
      const std::size_t node = s.dof / 2;
      const double_double force = s.force(line_.u, [this](int dof) { return bound_.left().needed[dof]; });
      double bound = std::min(std::sqrt(s.spring.hi), s.spring.hi * bound_.reach(s.dof)) * bound_.rho();
      if (s.fixed) {
        double squares = 0.0;
        for (std::size_t on = node == 0 ? 0 : node - 1; on <= node && on < line_.elements.size(); ++on)
          squares += std::pow(s.dof % 2 == 0 ? bound_.of_shear(line_.elements[on], false)
                                             : bound_.of_moment(line_.elements[on], false),
                              2);
        bound = std::sqrt(squares) + bound_.left().slack[s.dof];
      }
      e.take(name_of(s.dof % 2 == 0 ? quantity::reaction : quantity::moment), told_.reactions[i], force.hi,
             bound);
    }
  }

  void compare_pairs(mesh_error& e) const {
    const problem& p = told_.what;
    std::map<int, std::array<double, 3>> pressures;  // of all beds at a node: printed, of w1, bound
    const auto compare_pair = [&](std::size_t i, double share) {
      const pair_reading& at = told_.pairs[i];
      const double k = p.pairs[i].stiffness;
      const std::size_t dof = std::size_t{2} * line_.mesh->at(p.pairs[i].node);
      const double w = line_.u[dof].hi;
      const double deep = p.pairs[i].surface * (w - at.face);
      const double rounding = 0x1p-48 * (std::abs(w) + std::abs(at.face));
      const double moved = bound_.reach(dof) * bound_.rho() + rounding;
      const double force = k * std::max(deep, 0.0);
      e.take(name_of(quantity::gap), at.gap, std::max(-deep, 0.0), moved);
      e.take(name_of(quantity::force), at.force, force,
             share > 0.0 ? k * moved : std::min(k * moved, std::sqrt(k) * bound_.rho() + k * rounding));
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

  [[nodiscard]] bed_under_line find_bed(std::size_t bed) const {
    bed_under_line sum;
    double_double stiffness;
    for (const line_element& on : line_.elements)
      for (const line_part& part : on.parts)
        for (const bed_along& b : part.beds) {
          if (b.bed != bed) continue;
          const poly d = part.depth(b);
          const double h = part.load.h.hi;
          const double k = b.modulus.hi;
          const double moved = bound_.reach_in(on) * bound_.rho() + part.slack;
          sum.pressure = k * most_of(sum.pressure / k, d);
          sum.least_pressure =
              std::min(sum.least_pressure, k * -most_of(-sum.least_pressure / k, negative(d)));
          sum.pressure_bound = std::max(sum.pressure_bound, k * (moved + close_to_most * sum_of_sizes(d)));
          if (b.pressed.length() > 0.0) sum.force += k * h * mean_of(d);
          sum.force_bound += k * h * (wrong_in(part, b, d) + part.slack + 0x1p-48 * sum_of_sizes(d));
          stiffness += k * h;
          sum.least_contact += h * share_beyond(d, moved);
          sum.most_contact += h * (1.0 - share_beyond(negative(d), moved));
        }
    sum.force_bound += std::sqrt(stiffness.hi) * bound_.rho();
    return sum;
  }

  void compare_beds(mesh_error& e) const {
    const std::vector<bed_reading> printed = beds_in(told_);
    for (std::size_t bed = 0; bed < printed.size(); ++bed) {
      const bed_under_line now = find_bed(bed);
      e.take(pressure_name, printed[bed].pressure.most.value, now.pressure, now.pressure_bound);
      e.take(pressure_name, printed[bed].pressure.least.value, std::max(0.0, now.least_pressure),
             now.pressure_bound);
      e.take(bed_force_name, printed[bed].force, now.force.hi, now.force_bound);
      const double half = (now.most_contact - now.least_contact).hi / 2;
      e.take(bed_contact_name, printed[bed].contact, now.least_contact.hi + half, half);
    }
  }

  void compare_extremes(mesh_error& e) const {
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
        const double slack = i == 0 ? on.parts.front().slack : on.slack / (i == 1 ? 1.0 : on.h.hi);
        const double off = i == 0   ? bound_.reach_in(on) * bound_.rho()
                           : i == 1 ? bound_.of_moment(on, true)
                                    : bound_.of_shear(on, true);
        bound = std::max(bound, off + slack);
        for (const line_part& part : on.parts) {
          const poly& p = part.*all[i];
          now.least = -most_of(-now.least, negative(p));
          now.most = most_of(now.most, p);
          size = std::max(size, sum_of_sizes(p));
        }
      }
      e.take(name_of(kinds[i]), now.told_least, now.least, bound + close_to_most * size);
      e.take(name_of(kinds[i]), now.told_most, now.most, bound + close_to_most * size);
      is_close = is_close && bound <= allowed_[kinds[i]].value_or(0.0);
    }
    if (!is_close) e.extremes.clear();
  }

  const step_results& told_;
  const by_quantity& allowed_;  // certificate::allowed
  const bed_line& line_;
  const bed_bound& bound_;
  const long_system& system_;
};

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
  for (int step = 1; const mesh_error& e : all) {
    if (!e.not_proved.empty()) return {e.not_proved};
    for (const mesh_number& n : e.numbers) {
      auto most = std::ranges::find(largest.numbers, n.key, &mesh_number::key);
      if (most == largest.numbers.end()) most = largest.numbers.insert(most, n);
      most->error = std::max(most->error, n.error);
      most->of = std::max(most->of, n.of);
    }
    if (step == 1 || e.extremes.empty()) largest.extremes = e.extremes;
    for (std::size_t i = 0; i < largest.extremes.size(); ++i) {
      true_extremes& most = largest.extremes[i];
      const true_extremes& x = e.extremes[i];
      most.told_least = std::min(most.told_least, x.told_least);
      most.told_most = std::max(most.told_most, x.told_most);
      if (step == 1 || x.least < most.least) std::tie(most.least, most.least_step) = std::pair(x.least, step);
      if (step == 1 || x.most > most.most) std::tie(most.most, most.most_step) = std::pair(x.most, step);
    }
    ++step;
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
  bed_bound bound(*line);
  e.not_proved = bound.find();
  if (e.not_proved.empty()) mesh_comparison(told, s.judged->allowed, *line, bound).compare(e);
  if (e.not_proved.empty() && !line->settled && !e.is_within(1.0))
    return {"contact and pressure do not settle; use a finer mesh (element_size)"};
  e.line = line;
  return e;
}

}  // namespace contct
