#include "contct/proof/bed_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace contct {
namespace {

using poly = line_polynomial<double>;

constexpr stretch all_of_it = {0.0, 1.0};

std::size_t dof_of(int node) {
  return std::size_t{beam::dofs_per_node} * node;
}

/// w_I, the part of w that Hermite's functions and the displacements of the nodes make.
poly between_nodes(const line_element& e, const line_part& part, std::span<const double_double> u) {
  poly w(4);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) w[k] += part.hermite->shapes[i][k].hi * u[e.dofs[i]].hi;
  return w;
}

const line_part& part_at(const line_element& e, const double_double& place) {
  auto part = e.parts.begin();
  while (part + 1 != e.parts.end() && (part + 1)->from < place) ++part;
  return *part;
}

}  // namespace

bed_line::bed_line(const problem& p, std::shared_ptr<const fine_mesh> fine, const structure_state& told)
    : mesh(std::move(fine)),
      on_(std::get<beam>(mesh->fine.geometry.kind)),
      acting_(mesh->fine.steps[told.step - 1]),
      points_(on_.x, on_.runs) {
  for (int node = 0, row = 0; node < on_.nodes(); ++node, row = rows_.back() + 1)
    rows_.insert(rows_.end(), {row, row + (on_.has_hinge(node) ? 2 : 1)});
  for (const int node : on_.hinges) rows_.push_back(rows_[dof_of(node)] + 1);
  const auto moved = sums_at_dofs<double_double>(p.steps[told.step - 1].moves, dofs(p.geometry), 2);
  for (const bed& b : p.beds) {
    powers_ = std::max(powers_, b.face.size());
    auto& at = nodes_.emplace_back(nodes(p.geometry));
    const auto put = [&](const contact_pair& c, bool presses) {
      const auto own = b.face.empty() ? number_of<double_double>(c.face) : double_double();
      at[c.node] = {own + moved[dof_of(c.node)], presses};
    };
    for (std::size_t i = b.first_pair; i < b.first_pair + b.share.size(); ++i)
      put(p.pairs[i], told.closed(i));
    for (const contact_pair& c : b.held)  // its displacement is prescribed
      put(c, depth_of(c, told.displacement[dof_of(c.node)] - moved[dof_of(c.node)].hi) > 0.0);
  }
  pairs_ = pairs_in<double_double>(std::span(mesh->fine.pairs).first(p.beds.front().first_pair), 2);
  for (long_pair& c : pairs_) c.face += moved[c.dof >> mesh->halvings];
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    if (told.closed(i)) pressed.push_back(static_cast<int>(i));
  const beam_elements<double_double> all(on_);
  for (int e = 0; e < on_.elements(); ++e) {
    const auto hinge = static_cast<int>(std::ranges::lower_bound(on_.hinges, e + 1) - on_.hinges.begin());
    elements.push_back(
        {{2 * e, 2 * e + 1, 2 * e + 2, on_.has_hinge(e + 1) ? 2 * on_.nodes() + hinge : 2 * e + 3},
         all.lengths()[e],
         all.EI(e),
         {}});
  }
  for_each_exact_work<double_double>(on_, acting_,
                                     [this](int e, const auto& work) { elements[e].work = work; });
  u.resize(rows_.size());
}

/// Adds to a part of element `e` the beds along it. Their faces are the polynomials of the file, or linear
/// between the nodes of the problem, as moves are; beyond the bed's last node as at this node.
void bed_line::add_beds(line_part& part, int e) const {
  const double middle = part.load.left + (part.load.right - part.load.left) / 2;
  const std::vector<bed>& beds = mesh->fine.beds;
  for (std::size_t i = 0; i < beds.size(); ++i)
    for (const bed_part& b : beds[i].parts) {
      if (!(b.from[0].x < middle && middle < b.to[0].x)) continue;
      const int wide = e >> mesh->halvings;
      const double share = 1.0 / mesh->at(1);
      const std::optional<bed_node>& right = nodes_[i][wide + 1];
      const bed_node first = nodes_[i][wide].value_or(right.value_or(bed_node()));
      const bed_node last = right.value_or(first);
      const double_double rise = (last.face - first.face) * share;
      long_vector face = {first.face + rise * (part.from + (e - mesh->at(wide))), rise * part.share};
      long_vector polynomial;
      for (const double c : beds[i].face) polynomial.push_back(number_of<double_double>(c));
      const double_double& h = elements[e].h;
      face = sum_of(
          face,
          formulas::in_element<double_double>(polynomial, points_.at(e) + part.from * h, part.share * h),
          1.0);
      const auto of_face = part.hermite->products(face);
      part.beds.push_back({i, mesh->fine.pairs[beds[i].first_pair].surface,
                           number_of<double_double>(b.modulus), std::move(face), of_face,
                           first.presses || last.presses ? all_of_it : stretch()});
    }
}

bool bed_line::has_end_in(const std::vector<double>& places, int e) const {
  const auto first = std::ranges::lower_bound(places, on_.x[e]);
  return first != places.end() && *first <= on_.x[e + 1];
}

/// Divides the elements at the places where a load or a bed begins or ends, or has another modulus, and at
/// the ends of contact. False if such places are too close for their order to be certain.
bool bed_line::divide() {
  load cut = acting_;
  const auto add_cut = [&cut](const line_place& from, const line_place& to) {
    cut.placed.push_back({from == to ? load_kind::point : load_kind::force, from, to, {0.0}});
  };
  for (const bed& b : mesh->fine.beds)
    for (const bed_part& part : b.parts) add_cut(part.from[0], part.to[0]);
  for (const double x : ends) add_cut(x, x);
  const auto all = pieces_of(on_, cut);
  const double near = 0x1p-40 * std::max(std::abs(on_.x.front()), std::abs(on_.x.back()));
  std::shared_ptr<const hermite_part> last;
  for (int e = 0; e < on_.elements(); ++e) {
    if (!elements[e].parts.empty() && !has_end_in(ends, e) && !has_end_in(divided_at_, e)) {
      carry_over(elements[e], elements[e]);
      continue;
    }
    line_element now = elements[e];
    now.parts.clear();
    const auto* const on = pieces_at(all, e);
    std::vector<element_piece> pieces = {{on_.x[e], on_.x[e + 1], now.h, now.EI, {0.0}, 0.0}};
    if (on != nullptr) pieces = *on;
    pieces.front().left = on_.x[e];  // equal elements share their pieces
    pieces.back().right = on_.x[e + 1];
    double_double from;
    for (element_piece& piece : pieces) {
      if (!(piece.right - piece.left > near)) return false;
      const double_double share = pieces.size() == 1 ? double_double(1.0) : piece.h / now.h;
      if (!last || !(last->of_h == now.h && last->at == from && last->along == share))
        last = std::make_shared<hermite_part>(now.h, from, share, powers_);
      add_beds(now.parts.emplace_back(line_part{std::move(piece), from, share, last}), e);
      from += share;
    }
    if (!elements[e].parts.empty()) carry_over(elements[e], now);
    elements[e] = std::move(now);
  }
  divided_at_ = ends;
  return true;
}

/// Gives the parts of an element what the line before has at their places.
void bed_line::carry_over(const line_element& old, line_element& now) const {
  for (line_part& part : now.parts) {
    const double_double middle = part.from + part.share * 0.5;
    const line_part& at = part_at(old, middle);
    const auto in_old = [&at](const double_double& t) { return (t.hi - at.from.hi) / at.share.hi; };
    if (part.from == at.from && part.share == at.share) {
      part.before = at.beyond;
    } else {
      const auto here =
          formulas::in_element<double>(std::span<const double>(at.beyond.data(), at.beyond.size()),
                                       in_old(part.from), part.share.hi / at.share.hi);
      part.before.assign(here.begin(), here.end());
    }
    if (part.before.size() > powers_) part.before.resize(powers_);  // any polynomial will do
    const double size = 0x1p-52 * sum_of_sizes(at.beyond);
    while (part.before.size() > 4 && std::abs(part.before.back()) <= size) part.before.pop_back();
    for (bed_along& b : part.beds) {
      const auto was = std::ranges::find(at.beds, b.bed, &bed_along::bed);
      b.pressed = {};
      if (was != at.beds.end() && polynomial_at(at.depth(*was), in_old(middle)) > 0.0) b.pressed = all_of_it;
    }
  }
}

long_system bed_line::system_with(stretch bed_along::*where) const {
  equations<double_double> e;
  e.fixed.assign(rows_.size(), 0);
  e.stiffness.resize(rows_.size());
  for (auto& row : e.stiffness) row.reserve(7);  // the dofs of two elements, and of a hinge
  const line_element* alike = nullptr;
  std::array<std::array<double_double, 4>, 4> bending;
  for (const line_element& on : elements) {
    if (alike == nullptr || !(alike->EI == on.EI && alike->h == on.h))
      bending = formulas::beam_stiffness<double_double>(on.EI, on.h, 0.0);
    alike = &on;
    auto own = bending;
    for (const line_part& part : on.parts)
      for (const bed_along& b : part.beds) {
        const stretch& at = b.*where;
        if (at.length() == 0.0) continue;
        std::shared_ptr<const hermite_part> shapes = part.hermite;
        if (at.length() < 1.0)
          shapes = std::make_shared<hermite_part>(on.h, part.from + part.share * at.from,
                                                  part.share * at.length(), 4);
        const double_double k = b.modulus * (part.load.h * at.length());
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j) own[i][j] += k * shapes->stiffness[i][j];
      }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) e.stiffness[on.dofs[i]][on.dofs[j]] += own[i][j];
  }
  for (std::size_t i = 0; i < on_.hinges.size(); ++i) {
    const auto s = number_of<double_double>(on_.stiffness_of_hinge(on_.hinges[i]));
    const std::array<int, 2> turns = {2 * on_.hinges[i] + 1, static_cast<int>(dof_of(on_.nodes()) + i)};
    for (const int row : turns)
      for (const int column : turns) e.stiffness[row][column] += row == column ? s : -s;
  }
  put_on_supports(mesh->fine, e);
  e.pairs = pairs_;
  long_system system(std::move(e));
  system.find_roots();
  return system;
}

long_loads bed_line::loads() const {
  long_loads l;
  l.force = sums_at_dofs<double_double>(acting_.points, rows_.size(), 2);
  l.settlement = sums_at_dofs<double_double>(acting_.settlements, rows_.size(), 2);
  l.size.resize(rows_.size());
  for (std::size_t dof = 0; dof < rows_.size(); ++dof) l.size[dof] = std::abs(l.force[dof].hi);
  const auto add = [&l](int dof, const double_double& work, double size) {
    l.force[dof] += work;
    l.size[dof] += size;
  };
  for (const line_element& on : elements) {
    for (std::size_t i = 0; i < 4; ++i) add(on.dofs[i], on.work[i], std::abs(on.work[i].hi));
    for (const line_part& part : on.parts) {
      const auto of_before = part.hermite->products(part.before);
      for (const bed_along& b : part.beds) {  // P at w_I = 0
        if (b.pressed.length() == 0.0) continue;
        const double_double k = b.modulus * part.load.h;
        for (std::size_t i = 0; i < 4; ++i)
          add(on.dofs[i], k * (b.of_face[i] - of_before[i]),
              k.hi * (std::abs(b.of_face[i].hi) + std::abs(of_before[i].hi)));
      }
    }
  }
  return l;
}

/// Solves for u with the pressed stretches and pairs as springs in both directions.
bool bed_line::solve() {
  with_pressed = std::make_unique<long_system>(system_with(&bed_along::pressed));
  const long_loads l = loads();
  scaled_stiffness stiffness = scaled(*with_pressed);
  if (!stiffness.factor(pressed)) return false;
  for (std::size_t dof = 0; dof < u.size(); ++dof)
    if (with_pressed->fixed[dof] != 0) u[dof] = l.settlement[dof];
  constexpr int most = 8;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most; ++i) {
    const long_vector force = with_pressed->linear_residual(with_pressed->residual(u, l), u, pressed);
    std::vector<double> correction;
    for (const double_double& f : force) correction.push_back(f.hi);
    stiffness.solve(correction);
    double work = 0.0;
    for (std::size_t dof = 0; dof < u.size(); ++dof) {
      work += correction[dof] * force[dof].hi;
      u[dof] += correction[dof];
    }
    energy_ = std::max(energy_, work);
    if (!(work < before / 4) || work < 0x1p-76 * energy_) break;
    before = work;
  }
  return true;
}

/// Sets the pressure of the beds on a part of `on`. Returns the sum of the sizes of the polynomials that it
/// is made of.
double bed_line::press(line_part& part, const line_element& on) const {
  const poly w = sum_of(between_nodes(on, part, u), part.before, 1.0);
  double sizes = sum_of_sizes(part.before);
  part.pressure = {0.0};
  for (const bed_along& b : part.beds) {
    const poly face = rounded(b.face);
    sizes += sum_of_sizes(face);
    if (b.pressed.length() > 0.0) part.pressure = sum_of(part.pressure, sum_of(w, face, -1.0), -b.modulus.hi);
  }
  return sizes;
}

/// Sets pressure, b and line of all parts from u. The end forces of w_I are differences, in 32 digits; in a
/// part each number has fewer than 2^5 roundings, of 2^-53 each.
void bed_line::evaluate() {
  for (line_element& on : elements) {
    std::array<double_double, 4> own;
    for (std::size_t i = 0; i < 4; ++i) own[i] = u[on.dofs[i]];
    const double h = on.h.hi;
    const double bends = h * h / on.EI.hi;
    double sizes =
        std::abs(own[0].hi) + std::abs(own[2].hi) + h * (std::abs(own[1].hi) + std::abs(own[3].hi));
    std::array<double, 2> work = {on.work[0].hi, on.work[1].hi};
    double clamped = h * std::abs(work[0]) + std::abs(work[1]);  // moments of b
    for (line_part& part : on.parts) {
      sizes += press(part, on);
      for (std::size_t i = 0; i < 2; ++i) {
        const double more = part.load.h.hi * part.hermite->product(i, part.pressure);
        work[i] += more;
        clamped += (i == 0 ? h : 1.0) * std::abs(more);
      }
    }
    const auto forces = formulas::beam_end_forces<double_double>(on.EI, on.h, 0.0, own);
    line_start<double> at{0.0, 0.0, work[1], -work[0]};
    for (line_part& part : on.parts) {
      const element_piece& load = part.load;
      at.shear += load.force.hi;
      at.moment -= load.moment.hi;
      line_of<double> b;
      const poly q = sum_of(rounded(load.q), part.pressure, 1.0);
      put_along(b, at, q, load.h.hi, on.EI.hi, load.curvature.hi, 0.0);
      clamped += h * h * (sum_of_sizes(q) + load.size) + on.EI.hi * std::abs(load.curvature.hi) +
                 h * std::abs(load.force.hi) + std::abs(load.moment.hi);
      at = b.right_end();
      part.beyond = std::move(b.w);
      part.w = sum_of(between_nodes(on, part, u), part.beyond, 1.0);
      part.shear = std::move(b.shear);
      part.shear[0] += forces[0].hi;
      part.moment = std::move(b.moment);
      part.moment[0] += (forces[2] + forces[0] * on.h * part.from).hi;
      part.moment[1] += (forces[0] * load.h).hi;
    }
    const double rounding = 0x1p-47 * static_cast<double>(on.parts.size());
    const double of_P = h * h * on.modulus() * sizes;
    on.slack = rounding * (std::abs(forces[2].hi) + h * std::abs(forces[0].hi) + clamped + of_P);
    for (line_part& part : on.parts) {
      part.slack = rounding * (sizes + bends * clamped);
      part.slack_of_b = rounding * bends * (clamped + of_P / 64) + 0x1p-88 * sizes;
    }
  }
}

/// The places where the depth of a bed is 0. One that is nearly where it was before stays there, and none is
/// set close beside a place that divides the element anyway.
std::vector<double> bed_line::ends_found() const {
  std::vector<double> all;
  for (const line_element& on : elements)
    for (const line_part& part : on.parts)
      for (const bed_along& b : part.beds) {
        const double left = part.load.left;
        const double right = part.load.right;
        const poly d = part.depth(b);
        const double varies = sum_of_sizes(d) - std::abs(d[0]);
        if (std::abs(d[0]) > varies * 2 * on.h.hi / part.load.h.hi) continue;  // far away
        const double rise = std::abs(polynomial_at(derivative(d), 0.5)) * on.h.hi / part.load.h.hi;
        const auto ends_at = [&](double x, double depth) {
          const bool again = std::ranges::binary_search(ends, x);
          const bool is_end = std::abs(depth) <= (again ? 1e-9 : 1e-6) * rise;
          if (is_end && again) all.push_back(x);
          return is_end;
        };
        const double first = ends_at(left, polynomial_at(d, 0.0)) ? 1e-4 : 0.0;
        const double last = ends_at(right, polynomial_at(d, 1.0)) ? 1 - 1e-4 : 1.0;
        for (const double s : zeros_of(d))
          if (first < s && s < last) all.push_back(left + s * (right - left));
      }
  std::ranges::sort(all);
  const double near = 1e-12 * (on_.x.back() - on_.x.front());
  all.erase(std::unique(all.begin(), all.end(), [near](double a, double b) { return b - a <= near; }),
            all.end());
  return all;
}

std::string bed_line::settle() {
  constexpr int most = 50;
  for (int i = 0; i < most; ++i) {
    if (!divide()) return "places are too close to each other";
    if (!solve()) return "nothing holds the beam";
    evaluate();
    std::vector<int> pressing;
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair)
      if (depth_of(pairs_[pair], u[pairs_[pair].dof]).hi > 0.0) pressing.push_back(static_cast<int>(pair));
    const bool pairs_stay = std::exchange(pressed, pressing) == pressing;
    std::vector<double> next = ends_found();
    if (i > 0 && pairs_stay && is_settled(next)) {
      settled = true;
      break;
    }
    if (i + 1 < most) ends = std::move(next);
  }
  return "";
}

/// Is the pressure that P lacks negligible, and the distance of the ends of contact from `next`?
bool bed_line::is_settled(const std::vector<double>& next) const {
  constexpr double of_pressure = 1e-8;
  constexpr double of_length = 1e-8;
  double off = 0.0;
  double all = 0.0;
  double shortest = on_.x.back() - on_.x.front();
  for (const line_element& on : elements)
    for (const line_part& part : on.parts) {
      const double lacks = sum_of_sizes(part.late());
      for (const bed_along& b : part.beds) off = std::max(off, b.modulus.hi * b.pressed.length() * lacks);
      all = std::max(all, sum_of_sizes(part.pressure));
      shortest = std::min(shortest, on.h.hi);
    }
  const auto is_near = [&](double a, double b) { return std::abs(a - b) <= of_length * shortest; };
  return off <= of_pressure * all && std::ranges::equal(next, ends, is_near);
}

}  // namespace contct
