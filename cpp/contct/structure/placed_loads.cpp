#include "contct/structure/placed_loads.hpp"

#include <algorithm>
#include <cmath>

#include "contct/structure/acting.hpp"

namespace contct {
namespace {

loaded_part part_between(const line<rational>& points, const line_place& from, const line_place& to) {
  const auto interval_at = [&points](const rational& at, double near) {
    return std::min(static_cast<int>(points.point_before(at, near)), points.intervals() - 1);
  };
  const auto share_at = [&points](const rational& at, int i) {
    return rational((at - points.at(i)) / points.length(i));
  };
  const rational begin = points.place(from);
  const rational end = points.place(to);
  loaded_part p{interval_at(begin, from.x), interval_at(end, to.x)};
  p.from = share_at(begin, p.first);
  p.to = share_at(end, p.last);
  if (p.to != 0 || p.last == p.first) return p;
  --p.last;
  p.to = 1;
  return p;
}

/// The action of a load on one element, in t = (x - left) / h from 0 to 1.
struct element_load {
  load_kind what;
  std::array<rational, 2> part;
  rational_vector values;
};

/// All loads on a beam, element by element.
class beam_sources {
 public:
  beam_sources(const beam& b, const load& l)
      : beam_(b), points_(b.x, b.runs), all_(acting_on(points_, nullptr, l)) {
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const loaded_part& part = all_[i].x;
      const bool is_on_all = part.first == 0 && part.last == b.elements() - 1;
      if (is_on_all && part.covers(part.first) && part.covers(part.last)) {
        on_all_.push_back(i);
        continue;
      }
      on_.resize(b.elements());
      for (int e = part.first; e <= part.last; ++e) on_[e].push_back(i);
    }
  }

  [[nodiscard]] bool acts_on(int e) const { return !on_all_.empty() || (!on_.empty() && !on_[e].empty()); }
  [[nodiscard]] rational h(int e) const { return points_.length(e); }
  [[nodiscard]] rational EI(int e) const { return stiffness_of<rational>(beam_, e); }
  [[nodiscard]] rational flexibility(int e) const { return shear_flexibility_of<rational>(beam_, e); }
  [[nodiscard]] rational x_at(int e, const rational& t) const { return points_.at(e) + t * h(e); }

  [[nodiscard]] std::vector<element_load> on(int e) const {
    std::vector<element_load> all;
    for (const std::size_t i : sources_on(e)) {
      const acting& s = all_[i];
      all.push_back({s.what, s.x.in(e), s.values});
      if (s.what == load_kind::force && s.values.size() > 1)
        all.back().values = formulas::in_element<rational>(s.values, points_.at(e), h(e));
    }
    return all;
  }

  /// True if the elements are equal, and the same constant loads cover both elements, so that each is one
  /// piece. Not every such case is recognised.
  [[nodiscard]] bool are_alike(int e, int other) const {
    const auto is_same_on_both = [&](std::size_t i) {
      return all_[i].values.size() == 1 && all_[i].x.covers(e) && all_[i].x.covers(other);
    };
    const bool have_own = !on_.empty();
    return (!have_own || on_[e] == on_[other]) && beam_.is_alike(e, other) && points_.are_equal(e, other) &&
           std::all_of(on_all_.begin(), on_all_.end(), is_same_on_both) &&
           (!have_own || std::all_of(on_[e].begin(), on_[e].end(), is_same_on_both));
  }

 private:
  [[nodiscard]] std::vector<std::size_t> sources_on(int e) const {
    std::vector<std::size_t> some = on_all_;
    if (!on_.empty()) some.insert(some.end(), on_[e].begin(), on_[e].end());
    return some;
  }

  const beam& beam_;
  line<rational> points_;
  std::vector<acting> all_;
  std::vector<std::size_t> on_all_;           // indices in all_ of loads on every element
  std::vector<std::vector<std::size_t>> on_;  // [elements] indices of the other loads; empty: there are none
};

/// A shape function of a beam's element: the deflection, and the rotation of the section times h, in t. For
/// dofs that are rotations both are divided by h.
struct shape_function {
  rational_vector w, turn;
};

/// The shape functions of formulas::beam_stiffness: Hermite's for phi = 0.
std::array<shape_function, 4> shapes_of(const rational& phi) {
  static const rational half(1, 2);
  static const std::array<rational_vector, 4> bent = {
      {{1, 0, -3, 2}, {0, 1, -2, 1}, {0, 0, 3, -2}, {0, 0, -1, 1}}};
  static const std::array<rational_vector, 4> sheared = {
      {{1, -1}, {0, half, -half}, {0, 1}, {0, -half, half}}};
  static const std::array<rational_vector, 4> turned = {{{}, {1, -1}, {}, {0, 1}}};
  std::array<shape_function, 4> all;
  const rational share = 1 / (1 + phi);
  for (std::size_t i = 0; i < 4; ++i) {
    rational_vector turn = derivative(bent[i]);
    all[i].w = bent[i];
    for (std::size_t k = 0; k < sheared[i].size(); ++k) all[i].w[k] += phi * sheared[i][k];
    for (std::size_t k = 0; k < turned[i].size(); ++k) turn[k] += phi * turned[i][k];
    for (rational& c : all[i].w) c *= share;
    for (rational& c : turn) c *= share;
    all[i].turn = std::move(turn);
  }
  return all;
}

/// Adds to `force` the work of `a` on `shapes`. An imposed curvature acts as the moment EI times this
/// curvature on the derivatives of the rotations.
void add_work(const element_load& a, const rational& h, const rational& EI,
              const std::array<shape_function, 4>& shapes, std::array<rational, 4>& force) {
  const auto& [from, to] = a.part;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& [w, turn] = shapes[i];
    rational work;
    if (a.what == load_kind::force) work = h * integral_of(a.values, w, from, to);
    if (a.what == load_kind::point) work = a.values[0] * polynomial_at(w, from);
    if (a.what == load_kind::moment) work = a.values[0] * polynomial_at(turn, from) / h;
    if (a.what == load_kind::curvature)
      work = EI * a.values[0] * (polynomial_at(turn, to) - polynomial_at(turn, from)) / h;
    force[i] += i % 2 == 0 ? work : work * h;
  }
}

/// The piece between two places of an element, with the point loads at its left end.
element_piece piece_between(const std::vector<element_load>& all, const rational& from, const rational& to,
                            const rational& h, const rational& EI) {
  rational_vector q(1);
  rational curvature;
  rational force;
  rational moment;
  for (const element_load& a : all) {
    const bool covers = a.part[0] <= from && to <= a.part[1];
    if (a.what == load_kind::force && covers) {
      q.resize(std::max(q.size(), a.values.size()));
      for (std::size_t i = 0; i < a.values.size(); ++i) q[i] += a.values[i];
    }
    if (a.what == load_kind::curvature && covers) curvature += a.values[0];
    if (a.what == load_kind::point && a.part[0] == from) force += a.values[0];
    if (a.what == load_kind::moment && a.part[0] == from) moment += a.values[0];
  }
  element_piece p{0.0, 0.0, long_rounded(h * (to - from)), long_rounded(EI), {}, long_rounded(curvature)};
  p.force = long_rounded(force);
  p.moment = long_rounded(moment);
  for (const rational& c : formulas::in_element<rational>(q, from, to - from)) {
    p.q.push_back(long_rounded(c));
    p.size += std::abs(p.q.back().hi);
  }
  const double length = contct::rounded(h);
  p.size += std::abs(p.force.hi) / length + std::abs(p.moment.hi) / (length * length);
  return p;
}

std::vector<rational> cuts_of(const std::vector<element_load>& all) {
  std::vector<rational> cuts = {0, 1};
  for (const element_load& a : all) cuts.insert(cuts.end(), a.part.begin(), a.part.end());
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

/// Adds the pressure of a rectangle, or the moment on it, to the elements that it covers: a pressure on a
/// whole element to `whole`; otherwise the work on the shape functions of the element to `part`.
void add_rectangle(const acting& a, const line<rational>& along_x, const line<rational>& along_y,
                   std::vector<rational>& whole, std::map<int, std::array<rational, 12>>& part) {
  const auto from_middle = [](const std::array<rational, 2>& shares) {
    return std::array<rational, 2>{2 * shares[0] - 1, 2 * shares[1] - 1};
  };
  const bool turns = a.what == load_kind::moment;
  const auto [x, y] = std::array{a.x.ends(along_x), a.y.ends(along_y)};
  const rational area = turns ? (x[1] - x[0]) * (y[1] - y[0]) : rational(1);
  for (int j = a.y.first; j <= a.y.last; ++j) {
    for (int i = a.x.first; i <= a.x.last; ++i) {
      const int e = j * along_x.intervals() + i;
      if (!turns && a.x.covers(i) && a.y.covers(j)) {
        whole[e] += a.values[0];
        continue;
      }
      std::array<rational, 12>& sum = part[e];
      for (std::size_t n = 0; n < a.values.size(); ++n) {
        if (a.values[n] == 0) continue;
        const auto unit = formulas::plate_unit_load_on<rational>(
            along_x.length(i) / 2, along_y.length(j) / 2, from_middle(a.x.in(i)), from_middle(a.y.in(j)),
            turns ? static_cast<int>(n) + 1 : 0);
        for (std::size_t k = 0; k < 12; ++k) sum[k] += a.values[n] / area * unit[k];
      }
    }
  }
}

/// What of each point's half intervals lies between two places.
rational_vector shares_between(const line<rational>& points, const line_place& from, const line_place& to) {
  rational_vector all(points.size());
  const loaded_part part = part_between(points, from, to);
  const rational half(1, 2);
  for (int i = part.first; i <= part.last; ++i) {
    const auto [a, b] = part.in(i);
    const rational h = points.length(i);
    all[i] += h * (std::min(b, half) - std::min(a, half));
    all[i + 1] += h * (std::max(b, half) - std::max(a, half));
  }
  return all;
}

}  // namespace

std::vector<acting> acting_on(const line<rational>& x, const line<rational>* y, const load& l) {
  std::vector<acting> all;
  const int columns = x.intervals();
  for (const distributed_load& d : l.distributed) {
    const rational_vector values = coefficients_of(d);
    if (d.elements.empty())
      all.push_back({load_kind::force, {0, columns - 1}, {0, y == nullptr ? 0 : y->intervals() - 1}, values});
    for (std::size_t i = 0; i < d.elements.size(); ++i) {
      const int e = d.elements[i];
      if (i > 0 && e == d.elements[i - 1] + 1 && e % columns != 0)
        ++all.back().x.last;
      else
        all.push_back({load_kind::force, {e % columns, e % columns}, {e / columns, e / columns}, values});
    }
  }
  for (const placed_load& p : l.placed)
    all.push_back({p.what, part_between(x, p.from, p.to),
                   y == nullptr ? loaded_part() : part_between(*y, p.across[0], p.across[1]),
                   coefficients_of(p)});
  return all;
}

bed_springs springs_of(const model& m, const std::vector<bed_part>& parts) {
  if (parts.empty()) return {};
  bed_springs all{rational_vector(nodes(m)), rational_vector(nodes(m))};
  const auto* const p = std::get_if<plate>(&m.kind);
  for (const bed_part& part : parts) {
    const auto along = [&part](const auto& points, const auto& runs, std::size_t axis) {
      return shares_between(line<rational>(points, runs), part.from.at(axis), part.to.at(axis));
    };
    const auto* const b = std::get_if<beam>(&m.kind);
    const rational_vector x = p == nullptr ? along(b->x, b->runs, 0) : along(p->x, p->x_runs, 0);
    const rational_vector y = p == nullptr ? rational_vector{1} : along(p->y, p->y_runs, 1);
    const rational modulus = decimal_of(part.modulus);
    for (std::size_t j = 0; j < y.size(); ++j)
      for (std::size_t i = 0; i < x.size() && y[j] != 0; ++i) {
        if (x[i] == 0) continue;  // most nodes, if there are many parts
        const rational share = x[i] * y[j];
        all.share[j * x.size() + i] += share;
        all.stiffness[j * x.size() + i] += modulus * share;
      }
  }
  return all;
}

std::vector<std::array<double, 2>> intervals_of(const bed& b, const beam& on) {
  std::vector<std::array<double, 2>> all;
  for (const bed_part& part : b.parts) all.push_back({part.from[0].x, part.to[0].x});
  const auto middle = [&on](int i, int k) {
    return on.x[i] + (on.x[std::clamp(k, 0, on.nodes() - 1)] - on.x[i]) / 2;
  };
  for (std::size_t n = 0; n < b.nodes.size(); ++n) {
    const int node = b.nodes[n];
    if (n == 0 || b.nodes[n - 1] + 1 != node) all.push_back({middle(node, node - 1), 0.0});
    all.back()[1] = middle(node, node + 1);
  }
  return all;
}

template <class Number>
void for_each_exact_work(const beam& b, const load& l,
                         const std::function<void(int, const std::array<Number, 4>&)>& visit) {
  const beam_sources sources(b, l);
  std::array<Number, 4> force{};
  for (int e = 0; e < b.elements(); ++e) {
    if (!sources.acts_on(e)) continue;
    if (e == 0 || !sources.are_alike(e, e - 1)) {
      std::array<rational, 4> sum;
      const rational h = sources.h(e);
      const rational EI = sources.EI(e);
      static const std::array<shape_function, 4> without_shear = shapes_of(0);
      const rational flexibility = sources.flexibility(e);
      const auto shapes = flexibility == 0 ? without_shear : shapes_of(12 * EI * flexibility / h / h);
      for (const element_load& a : sources.on(e)) add_work(a, h, EI, shapes, sum);
      for (std::size_t i = 0; i < 4; ++i) force[i] = nearest<Number>(sum[i]);
    }
    visit(e, force);
  }
}

template <class Number>
std::vector<summed_pressure<Number>> exact_pressures(const plate& p, const load& l) {
  std::vector<rational> whole(p.elements());
  std::map<int, std::array<rational, 12>> part;
  const line<rational> along_x(p.x, p.x_runs);
  const line<rational> along_y(p.y, p.y_runs);
  for (const acting& a : acting_on(along_x, &along_y, l)) add_rectangle(a, along_x, along_y, whole, part);
  std::vector<summed_pressure<Number>> all(p.elements());
  for (int e = 0; e < p.elements(); ++e)
    all[e].value = e > 0 && whole[e] == whole[e - 1] ? all[e - 1].value : nearest<Number>(whole[e]);
  for (const auto& [e, sum] : part) {
    const int columns = p.columns() - 1;
    const auto unit =
        formulas::plate_unit_load<rational>(along_x.length(e % columns) / 2, along_y.length(e / columns) / 2);
    std::array<Number, 12> force{};
    for (std::size_t k = 0; k < 12; ++k) force[k] = nearest<Number>(sum[k] + whole[e] * unit[k]);
    all[e].on_parts = force;
  }
  return all;
}

std::map<int, alike_pieces> pieces_of(const beam& b, const load& l) {
  std::map<int, alike_pieces> all;
  const beam_sources sources(b, l);
  for (int e = 0; e < b.elements(); ++e) {
    if (!sources.acts_on(e)) continue;
    if (e > 0 && sources.are_alike(e, e - 1)) {
      all.rbegin()->second.last = e;
      continue;
    }
    const std::vector<element_load> on = sources.on(e);
    const std::vector<rational> cuts = cuts_of(on);
    std::vector<element_piece>& pieces = all.emplace(e, alike_pieces{e, {}}).first->second.pieces;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      pieces.push_back(piece_between(on, cuts[i], cuts[i + 1], sources.h(e), sources.EI(e)));
      pieces.back().left = contct::rounded(sources.x_at(e, cuts[i]));
      pieces.back().right = contct::rounded(sources.x_at(e, cuts[i + 1]));
    }
  }
  return all;
}

bool acts_inside(const beam& b, const load& l) {
  const auto loaded = [](const element_piece& p) { return p.size != 0.0 || !p.is_plain(); };
  const auto all = pieces_of(b, l);
  return std::any_of(all.begin(), all.end(), [&](const auto& alike) {
    return std::any_of(alike.second.pieces.begin(), alike.second.pieces.end(), loaded);
  });
}

const std::vector<element_piece>* pieces_at(const std::map<int, alike_pieces>& all, int element) {
  const auto next = all.upper_bound(element);
  if (next == all.begin() || std::prev(next)->second.last < element) return nullptr;
  return &std::prev(next)->second.pieces;
}

template void for_each_exact_work(const beam&, const load&,
                                  const std::function<void(int, const std::array<double, 4>&)>&);
template void for_each_exact_work(const beam&, const load&,
                                  const std::function<void(int, const std::array<double_double, 4>&)>&);
template void for_each_exact_work(const beam&, const load&,
                                  const std::function<void(int, const std::array<rational, 4>&)>&);
template std::vector<summed_pressure<double>> exact_pressures(const plate&, const load&);
template std::vector<summed_pressure<double_double>> exact_pressures(const plate&, const load&);
template std::vector<summed_pressure<rational>> exact_pressures(const plate&, const load&);

}  // namespace contct
