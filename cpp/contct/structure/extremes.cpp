#include "contct/structure/extremes.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "contct/structure/elements.hpp"
#include "contct/structure/line.hpp"

namespace contct {
namespace {

using poly = line_polynomial<double>;

/// A zero of p between a and b; p(a) and p(b) have different signs.
double zero_between(const poly& p, double a, double b) {
  const bool rises = polynomial_at(p, a) < 0.0;
  for (int i = 0; i < 200; ++i) {
    const double middle = a + (b - a) / 2;
    if (middle <= a || middle >= b) break;
    (polynomial_at(p, middle) < 0.0) == rises ? a = middle : b = middle;
  }
  return a;
}

}  // namespace

std::vector<double> zeros_of(const poly& p) {
  if (p.size() < 2) return {};
  std::vector<double> borders = zeros_of(derivative(p));
  borders.insert(borders.begin(), 0.0);
  borders.push_back(1.0);
  std::vector<double> zeros;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i)
    if ((polynomial_at(p, borders[i]) < 0.0) != (polynomial_at(p, borders[i + 1]) < 0.0))
      zeros.push_back(zero_between(p, borders[i], borders[i + 1]));
  return zeros;
}

namespace {

/// Finds the least and the largest of the values of one quantity, taken in the order of their places. The
/// place of an extreme is the first with a value equal to it: see tie_of.
class extremes {
 public:
  explicit extremes(std::string_view name) : name_(name) {}

  /// `varies`: v is on one polynomial with the value before it, and the polynomial is not constant.
  void take(const placed_value& v, bool varies = false) {
    varies = varies && follows_;
    const bool is_between = least_ <= v.value && v.value <= most_;  // values before it are as extreme
    follows_ = !is_between || (varies && (equals(v.value, -1) || equals(v.value, 1)));
    if (is_between) return;
    if (all_.size() == room_) forget();
    all_.push_back({v, varies});
    least_ = std::min(least_, v.value);
    most_ = std::max(most_, v.value);
  }

  /// Takes the quantity `of` / `over` along element `e` of a beam. `left_value` and `right_value`, the values
  /// of the quantity at the ends of the element, are more accurate than the polynomials. Of an element that
  /// is partly `within`, only polynomials are known.
  void take_element(const std::vector<element_line>& pieces, int e, poly element_line::*of, double left_value,
                    double right_value, double over = 1.0, const watched_part* within = nullptr) {
    if (within != nullptr &&
        !(within->has(pieces.front().left, 0.0) && within->has(pieces.back().right, 0.0)))
      return take_parts(pieces, of, over, *within);
    for (const element_line& line : pieces) {
      poly p = line.*of;
      if (over != 1.0)
        for (double& coefficient : p) coefficient /= over;
      const bool first = &line == &pieces.front();
      const bool last = &line == &pieces.back();
      const placed_value right{last ? right_value : polynomial_at(p, 1.0), line.right, 0.0,
                               last ? e + 1 : -1};
      take({first ? left_value : p.front(), line.left, 0.0, first ? e : -1});
      const poly hull = bernstein_of(p);
      const auto [least, most] = std::ranges::minmax(hull);
      const bool varies = most - least > tie_of(std::max(std::abs(least), std::abs(most)), 0.0);
      if (least < std::min(least_, right.value) || most > std::max(most_, right.value))
        for (const double t : zeros_of(derivative(p)))
          take({polynomial_at(p, t), line.left + t * line.h, 0.0, -1}, varies);
      take(right, varies);
    }
  }

  [[nodiscard]] value_range range() const { return {name_, first_at(-1), first_at(1)}; }

 private:
  struct candidate {
    placed_value at;
    bool varies;
  };

  /// Takes the parts of pieces between two places.
  void take_parts(const std::vector<element_line>& pieces, poly element_line::*of, double over,
                  const watched_part& within) {
    for (const element_line& line : pieces) {
      const double begin = std::max(line.left, within.from[0]);
      const double end = std::min(line.right, within.to[0]);
      if (begin >= end) continue;
      const auto value_at = [&](double x) {
        return placed_value{polynomial_at(line.*of, (x - line.left) / line.h) / over, x, 0.0, -1};
      };
      take(value_at(begin));
      for (const double t : zeros_of(derivative(line.*of)))
        if (const double x = line.left + t * line.h; begin < x && x < end) take(value_at(x), true);
      take(value_at(end), (line.*of).size() > 1);
    }
  }

  /// True if v equals the largest value so far (side = 1) or the least (-1).
  [[nodiscard]] bool equals(double v, int side) const {
    const double extreme = side > 0 ? most_ : least_;
    return side * (extreme - v) <= tie_of(std::abs(extreme), std::max(std::abs(least_), std::abs(most_)));
  }

  /// Forgets the values that equal no extreme so far, so that long beams need no memory for them.
  void forget() {
    std::vector<candidate> kept;
    bool follows = true;  // the value before is kept too
    for (candidate& c : all_) {
      c.varies = c.varies && follows;
      follows = equals(c.at.value, -1) || equals(c.at.value, 1);
      if (follows) kept.push_back(c);
    }
    all_ = std::move(kept);
    room_ = std::max(room_, 2 * all_.size());
  }

  /// The first place of the largest value (side = 1) or of the least (-1). Between neighbours on one
  /// polynomial there is no further extreme, so that of neighbours equal to the extreme the best is taken.
  [[nodiscard]] placed_value first_at(int side) const {
    const double extreme = side > 0 ? most_ : least_;
    const auto is_extreme = [&](const candidate& c) { return equals(c.at.value, side); };
    auto found = std::ranges::find_if(all_, is_extreme);
    if (found == all_.end()) return all_.front().at;  // no value is finite
    for (auto next = found + 1; next != all_.end() && next->varies && is_extreme(*next); ++next)
      if (side * (next->at.value - found->at.value) > tie_of(0.0, std::abs(extreme))) found = next;
    placed_value at = found->at;
    at.value = extreme;
    return at;
  }

  std::string_view name_;
  std::vector<candidate> all_;
  bool follows_ = false;  // the next value may be on one polynomial with the last of all_
  std::size_t room_ = 4096;
  double least_ = std::numeric_limits<double>::infinity(), most_ = -least_;
};

double w_at(std::span<const double> u, std::size_t node) {
  return u[beam::dofs_per_node * node];
}

element_results stresses(const beam& b, const element_results& forces) {
  if (b.sections.empty() || b.sections.front().W == 0.0) return {};
  element_results r{beam_elements<double>::stress_names(), 2, {}};
  for (std::size_t e = 0; e < forces.elements(); ++e)
    for (const double moment : forces.at(e, 1)) r.values.push_back(moment / b.sections[e].W);
  return r;
}

element_results stresses(const plate& p, const element_results& forces) {
  if (p.thickness == 0.0) return {};
  element_results r{plate_elements<double>::stress_names(), 4, {}};
  const double of_moment = 6 / p.thickness / p.thickness;
  for (std::size_t e = 0; e < forces.elements(); ++e) {
    std::array<std::array<double, 4>, 6> all{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = of_moment * forces.at(e, 0)[k];
      const double y = of_moment * forces.at(e, 1)[k];
      const double xy = of_moment * forces.at(e, 2)[k];
      const double middle = x / 2 + y / 2;
      const double radius = std::hypot(x / 2 - y / 2, xy);
      const std::array<double, 6> at = {
          x, y, xy, middle + radius, middle - radius, std::hypot(middle, std::sqrt(3.0) * radius)};
      for (std::size_t name = 0; name < at.size(); ++name) all[name][k] = at[name];
    }
    for (const auto& of_name : all) r.values.insert(r.values.end(), of_name.begin(), of_name.end());
  }
  return r;
}

std::vector<value_range> ranges_in(const plate& p, std::span<const double> u,
                                   std::span<const double> element_values, const watched_part* within) {
  const auto at = [&](int node, double value) {
    return placed_value{value, p.x[node % p.columns()], p.y[node / p.columns()], node};
  };
  const auto is_in = [within](const placed_value& v) { return within == nullptr || within->has(v.x, v.y); };
  const auto take = [&is_in](extremes& of, const placed_value& v) {
    if (is_in(v)) of.take(v);
  };
  std::vector<value_range> all;
  extremes w("w");
  for (int node = 0; node < p.nodes(); ++node) take(w, at(node, u[std::size_t{plate::dofs_per_node} * node]));
  all.push_back(w.range());
  element_results moments = results_in_elements(model{p}, {}, u);
  if (!element_values.empty()) moments.values.assign(element_values.begin(), element_values.end());
  const auto add = [&](const element_results& of, std::size_t first_name) {
    for (std::size_t name = first_name; name < of.names.size(); ++name) {
      extremes found(of.names[name]);
      for (int e = 0; e < p.elements(); ++e)
        for (std::size_t k = 0; k < 4; ++k) take(found, at(p.corners_of(e)[k], of.at(e, name)[k]));
      all.push_back(found.range());
    }
  };
  constexpr std::size_t principal = 3;  // after sx, sy and txy
  add(moments, 0);
  add(stresses_of({p}, moments), principal);
  return all;
}

}  // namespace

std::vector<value_range> ranges_of(const beam& b, const beam_lines& lines, std::span<const double> u,
                                   const watched_part* within) {
  extremes w("w");
  extremes shear(beam_elements<double>::names()[0]);
  extremes moment(beam_elements<double>::names()[1]);
  extremes stress(beam_elements<double>::stress_names()[0]);
  const bool has_stress = !b.sections.empty() && b.sections.front().W > 0.0;
  for (int e = 0; e < b.elements(); ++e) {
    if (within != nullptr && (b.x[e + 1] <= within->from[0] || within->to[0] <= b.x[e])) continue;
    const std::vector<element_line> pieces = lines.pieces(e);
    const auto shears = lines.ends().at(e, 0);
    const auto moments = lines.ends().at(e, 1);
    w.take_element(pieces, e, &element_line::w, w_at(u, e), w_at(u, e + 1), 1.0, within);
    moment.take_element(pieces, e, &element_line::moment, moments[0], moments[1], 1.0, within);
    shear.take_element(pieces, e, &element_line::shear, shears[0], shears[1], 1.0, within);
    if (!has_stress) continue;
    const double W = b.sections[e].W;
    stress.take_element(pieces, e, &element_line::moment, moments[0] / W, moments[1] / W, W, within);
  }
  std::vector<value_range> all = {w.range(), moment.range(), shear.range()};
  if (has_stress) all.push_back(stress.range());
  return all;
}

std::vector<value_range> ranges_of(const model& m, const load& l, std::span<const double> u,
                                   std::span<const int> deflecting, std::span<const double> element_values,
                                   const watched_part* within) {
  if (const auto* const b = std::get_if<beam>(&m.kind))
    return ranges_of(*b, beam_lines(*b, l, u, element_values), u, within);
  if (const auto* const p = std::get_if<plate>(&m.kind)) return ranges_in(*p, u, element_values, within);
  if (deflecting.empty()) return {};
  extremes w("w");
  for (const int dof : deflecting) w.take({u[dof], 0.0, 0.0, dof});
  return {w.range()};
}

line_polynomial<double> bernstein_of(const line_polynomial<double>& p) {
  const std::size_t degree = p.size() - 1;
  poly b = p;  // b_j = sum over i <= j of C(j, i) / C(degree, i) p_i
  double choose = 1.0;
  for (std::size_t i = 1; i <= degree; ++i) {
    choose *= static_cast<double>(degree - i + 1) / static_cast<double>(i);
    b[i] = p[i] / choose;
  }
  for (std::size_t round = 0; round < degree; ++round)
    for (std::size_t j = degree; j > round; --j) b[j] += b[j - 1];
  return b;
}

double sum_of_sizes(const poly& p) {
  double sum = 0.0;
  for (const double x : p) sum += std::abs(x);
  return sum;
}

std::vector<double> extreme_places(const element_line& line) {
  constexpr double rounding = 1e-9;  // an extreme closer to an end is at the end
  std::set<double> places;
  for (const poly* p : {&line.w, &line.moment, &line.shear})
    for (const double t : zeros_of(derivative(*p)))
      if (t > rounding && t < 1.0 - rounding) places.insert(t);
  return {places.begin(), places.end()};
}

value_range deflections_between(const beam_lines& lines, std::span<const double> u, int first, int last) {
  extremes w("w");
  for (int e = first; e < last; ++e)
    w.take_element(lines.pieces(e), e, &element_line::w, w_at(u, e), w_at(u, e + 1));
  return w.range();
}

beam_lines::beam_lines(const beam& b, const load& l, std::span<const double> u,
                       std::span<const double> element_values)
    : beam_(b), u_(u), pieces_(pieces_of(b, l)) {
  using elements = beam_elements<double>;
  ends_ = {elements::names(), elements::places, {element_values.begin(), element_values.end()}};
  if (element_values.empty()) ends_.values = elements(b).values(l, u);
  for (const auto& h : line<double_double>(b.x, b.runs).lengths()) h_.push_back(h.hi);
}

bool beam_lines::is_broken(int e) const {
  const auto* const on = pieces_at(pieces_, e);
  return on != nullptr && (on->size() > 1 || !on->front().is_plain());
}

namespace {

/// With the slope, dw/dx without shear flexibility.
void complete(element_line& line) {
  for (const double d : derivative(line.w)) line.slope.push_back(d / line.h);
}

template <class Coefficients>
poly in_doubles(const Coefficients& p) {
  poly rounded;
  for (const double_double& c : p) rounded.push_back(c.hi);
  return rounded;
}

}  // namespace

element_line beam_lines::at(int e) const {
  element_line line;
  line.left = beam_.x[e];
  line.h = h_[e];
  line.right = beam_.x[e + 1];
  if (const auto* const on = is_broken(e) ? nullptr : pieces_at(pieces_, e)) {
    line.load = in_doubles(on->front().q);
    line.load_size = on->front().size;
  }
  put_along(line, line_start<double>{w_at(u_, e), u_[2 * e + 1], ends_.at(e, 1)[0], ends_.at(e, 0)[0]},
            line.load, line.h, beam_.EI[e], 0.0, shear_flexibility_of<double>(beam_, e));
  return line;
}

/// Computes the pieces from the left end in 32 digits, and then rounds each coefficient once. With the length
/// h of the element, the error before this rounding is below 2^-80 load_size h in the shear and
/// 2^-80 load_size h^2 in the moment; load_size includes the largest shear and moment.
std::vector<element_line> beam_lines::pieces(int e) const {
  std::vector<element_line> all;
  if (!is_broken(e)) {
    all.push_back(at(e));
    return all;
  }
  const auto flexibility = shear_flexibility_of<double_double>(beam_, e);
  line_start<double_double> left{w_at(u_, e), u_[2 * e + 1], ends_.at(e, 1)[0], ends_.at(e, 0)[0]};
  double size = 0.0;
  for (const element_piece& p : *pieces_at(pieces_, e)) {
    left.shear += p.force;
    left.moment -= p.moment;  // of a moment that works on the slope
    line_of<double_double> line;
    put_along(line, left, p.q, p.h, p.EI, p.curvature, flexibility);
    element_line piece{p.left, p.h.hi, p.right, in_doubles(line.w), {}, {}, {}, in_doubles(p.q)};
    if (flexibility == 0.0)
      complete(piece);
    else
      piece.slope = in_doubles(line.slope);
    piece.moment = in_doubles(line.moment);
    piece.shear = in_doubles(line.shear);
    piece.curvature = p.curvature.hi;
    all.push_back(std::move(piece));
    const double h = h_[e];
    size += p.size + sum_of_sizes(all.back().shear) / h + sum_of_sizes(all.back().moment) / (h * h);
    left = line.right_end();
  }
  for (element_line& line : all) line.load_size = size;
  all.front().left = beam_.x[e];
  all.back().right = beam_.x[e + 1];
  return all;
}

element_results stresses_of(const model& m, const element_results& forces) {
  if (const auto* const b = std::get_if<beam>(&m.kind)) return stresses(*b, forces);
  if (const auto* const p = std::get_if<plate>(&m.kind)) return stresses(*p, forces);
  return {};
}

/// Most stresses are linear in the moments; the principal and von Mises stresses are not. Let the moments
/// change by x, y and xy, each at most 1 in magnitude. The von Mises stress, the root of a positive definite
/// quadratic form, changes by at most the root of x^2 - x y + y^2 + 3 xy^2 <= 6. A principal stress, an
/// eigenvalue, changes by at most 2.
std::optional<double> stress_error(const model& m, double moment, double largest) {
  const double rounding = 16 * std::numeric_limits<double>::epsilon() * largest;
  if (const auto* const b = std::get_if<beam>(&m.kind)) {
    if (b->sections.empty() || b->sections.front().W == 0.0) return std::nullopt;
    double least = b->sections.front().W;
    for (const beam_section& s : b->sections) least = std::min(least, s.W);
    return moment / least + rounding;
  }
  const auto* const p = std::get_if<plate>(&m.kind);
  if (p == nullptr || p->thickness == 0.0) return std::nullopt;
  return std::sqrt(6.0) * 6 / p->thickness / p->thickness * moment + rounding;
}

}  // namespace contct
