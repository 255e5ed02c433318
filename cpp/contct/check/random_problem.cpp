#include "contct/check/random_problem.hpp"

#include <algorithm>
#include <cmath>

#include "contct/kernel/call.hpp"
#include "contct/numeric/random.hpp"
#include "contct/structure/cholesky.hpp"

namespace contct {
namespace {

/// Draws one problem, in units of its own: length and force are scaled at the places they enter.
class drawing {
 public:
  drawing(std::uint64_t seed, std::uint64_t number, const random_problem_kind& kind)
      : random_(seed * 0x9e3779b97f4a7c15U + number), kind_(kind) {}

  random_problem draw() {
    problem_.unit = power_between(std::log10(kind_.least_unit), std::log10(kind_.most_unit));
    force_ = power_between(-6, 6);
    problem_.held = !random_.chance(kind_.free_share);
    problem_.layout = static_cast<face_layout>(random_.whole(0, face_layouts - 1));
    draw_geometry();
    if (problem_.held) draw_supports();
    draw_steps();
    draw_pairs();
    return std::move(problem_);
  }

 private:
  double between(double least, double most) { return least + (most - least) * random_.unit(); }
  double power_between(double least, double most) { return std::pow(10.0, between(least, most)); }
  [[nodiscard]] int nodes() const { return problem_.geometry.nodes(); }
  [[nodiscard]] bool mirrored() const {
    return problem_.layout == face_layout::symmetric || problem_.layout == face_layout::antisymmetric;
  }

  void draw_geometry() {
    const int elements =
        mirrored() ? 2 * random_.whole(2, kind_.most_elements / 2) : random_.whole(3, kind_.most_elements);
    const bool even = mirrored() || random_.chance(0.6);
    std::vector<double> x{0.0};
    for (int e = 0; e < elements; ++e) x.push_back(x.back() + (even ? 1.0 : between(0.3, 1.7)));
    const double length = x.back();
    for (double& at : x) at *= problem_.unit / length;
    problem_.geometry.x = x;
    problem_.geometry.EI.assign(static_cast<std::size_t>(elements), force_ * problem_.unit * problem_.unit);
  }

  void draw_supports() {
    const int last = nodes() - 1;
    const int middle = random_.whole(1, last - 1);
    switch (mirrored() ? 2 * random_.whole(0, 1) : random_.whole(0, 5)) {
      case 0:
        return fix({{0, 0}, {last, 0}});
      case 1:
        return fix({{0, 0}, {0, 1}});
      case 2:
        return fix({{0, 0}, {0, 1}, {last, 0}, {last, 1}});
      case 3:
        return fix({{0, 0}, {0, 1}, {last, 0}});
      case 4:
        return fix({{0, 0}, {middle, 0}});
      default: {
        const double k = force_ / problem_.unit * power_between(0, 4);
        problem_.supports.push_back({0, 0, false, k});
        problem_.supports.push_back({last, 0, false, k});
      }
    }
  }

  void fix(std::initializer_list<std::pair<int, int>> dofs) {
    for (const auto& [node, dof] : dofs) problem_.supports.push_back({node, dof, true, 0.0});
  }

  [[nodiscard]] bool fixed_in_w(int node) const {
    return std::any_of(problem_.supports.begin(), problem_.supports.end(),
                       [node](const support& s) { return s.fixed && s.node == node && s.dof == 0; });
  }

  /// One to five steps: anew, off, back, or a share of the one before.
  void draw_steps() {
    const int steps = random_.whole(1, 5);
    for (int step = 0; step < steps; ++step) {
      const double what = random_.unit();
      if (step == 0 || what < 0.5) {
        problem_.steps.push_back(new_load());
      } else {
        const double factor = what < 0.7 ? 0.0 : what < 0.85 ? -1.0 : between(0.1, 3.0);
        problem_.steps.push_back(times(factor, problem_.steps.back()));
      }
    }
  }

  load new_load() {
    load l;
    const double sign = !problem_.held || random_.chance(0.6) ? -1.0 : 1.0;
    const bool spread = !problem_.held || random_.chance(0.6) || mirrored();
    if (spread) l.distributed.push_back({{sign * force_ / problem_.unit * between(0.1, 2.0)}, {}});
    if (problem_.layout == face_layout::antisymmetric) {
      l.distributed.clear();
      add_mirrored_points(l, -1.0);
    } else if (problem_.layout == face_layout::symmetric) {
      if (random_.chance(0.5)) add_mirrored_points(l, 1.0);
    } else {
      const int points = spread ? random_.whole(0, 3) : random_.whole(1, 3);
      for (int i = 0; i < points; ++i) l.points.push_back(point());
    }
    return l;
  }

  point_load point() {
    const int node = random_.whole(0, nodes() - 1);
    if (random_.chance(0.25)) return {node, 1, force_ * problem_.unit * between(-0.3, 0.3)};
    return {node, 0, force_ * (problem_.held ? between(-1.0, 1.0) : between(-1.0, 0.3))};
  }

  void add_mirrored_points(load& l, double sign) {
    const int node = random_.whole(0, nodes() / 2 - 1);
    const double value = force_ * between(-1.0, 1.0);
    l.points.push_back({node, 0, value});
    l.points.push_back({nodes() - 1 - node, 0, sign * value});
  }

  static load times(double factor, load l) {
    for (point_load& p : l.points) p.value *= factor;
    for (distributed_load& d : l.distributed) {
      for (double& a : d.polynomial) a *= factor;
    }
    return l;
  }

  /// Deflections of the structure without pairs under the first load: the size of useful gaps.
  [[nodiscard]] std::vector<double> free_deflection() const {
    linear_structure s = build(problem_.geometry, problem_.supports, {});
    std::vector<double> f(static_cast<std::size_t>(s.dofs()), 0.0);
    add_consistent_loads(problem_.geometry, problem_.steps.front(), f);
    for (std::size_t i = 0; i < f.size(); ++i) f[i] = s.fixed[i] != 0 ? 0.0 : f[i];
    if (problem_.held && factor(s.stiffness)) {
      solve_with(s.stiffness, f);
    } else {
      std::fill(f.begin(), f.end(), 0.01 * problem_.unit);
    }
    return f;
  }

  void draw_pairs() {
    const std::vector<double> w = free_deflection();
    for (std::size_t i = 0; i < w.size(); i += 2) largest_ = std::max(largest_, std::abs(w[i]));
    common_stiffness_ = random_.chance(0.5) ? power_between(0, 8) : 0.0;
    common_gap_ = largest_ * power_between(-2, 0);
    const double density = problem_.held ? between(0.2, 1.0) : between(0.6, 1.0);
    const int last = mirrored() ? (nodes() - 1) / 2 : nodes() - 1;
    for (int node = 0; node <= last; ++node) {
      if (fixed_in_w(node)) continue;
      if (random_.chance(density) || (!problem_.held && (node == 0 || node == nodes() - 1)))
        place(node, w[2 * static_cast<std::size_t>(node)]);
    }
    if (problem_.pairs.empty()) place(nodes() / 2, w[2 * static_cast<std::size_t>(nodes() / 2)]);
  }

  void place(int node, double w) {
    contact_pair p{};
    p.node = node;
    p.surface = side(w);
    p.stiffness =
        force_ / problem_.unit * (common_stiffness_ > 0.0 ? common_stiffness_ : power_between(0, 8));
    p.face = p.surface * gap();
    p.closed = p.face == 0.0;
    problem_.pairs.push_back(p);
    if (problem_.layout == face_layout::two_sided) {
      p.surface = -p.surface;
      p.face = p.surface * gap();
      p.closed = p.face == 0.0;
      problem_.pairs.push_back(p);
    }
    if (!mirrored()) return;
    const int other = nodes() - 1 - node;
    if (other == node || fixed_in_w(other)) return;
    if (problem_.layout == face_layout::antisymmetric) {
      p.surface = -p.surface;
      p.face = -p.face;
    }
    p.node = other;
    problem_.pairs.push_back(p);
  }

  int side(double w) {
    if (!problem_.held) return face_below;
    if (random_.chance(0.3)) return random_.chance(0.5) ? face_above : face_below;
    return w > 0 ? face_above : face_below;
  }

  double gap() {
    if (!problem_.held && random_.chance(0.7)) return 0.0;
    switch (problem_.layout) {
      case face_layout::zero:
        return 0.0;
      case face_layout::mixed:
      case face_layout::two_sided:
      case face_layout::symmetric:
      case face_layout::antisymmetric:
        return random_.chance(0.4) ? 0.0 : largest_ * power_between(-2, 0.2);
      case face_layout::equal_gaps:
        return common_gap_;
      case face_layout::near_ties:
        return common_gap_ * (1.0 + between(-1.0, 1.0) * power_between(-15, -3));
      case face_layout::gaps:
        break;
    }
    return largest_ * power_between(-2, 0.2);
  }

  random_numbers random_;
  random_problem_kind kind_;
  random_problem problem_;
  double force_ = 1.0;
  double largest_ = 0.0;
  double common_stiffness_ = 0.0;
  double common_gap_ = 0.0;
};

}  // namespace

std::string_view name_of(face_layout f) {
  constexpr std::string_view names[] = {"gaps",      "zero gaps", "mixed",         "equal gaps",
                                        "near ties", "symmetric", "antisymmetric", "two-sided"};
  return names[static_cast<int>(f)];
}

random_problem make_random_problem(std::uint64_t seed, std::uint64_t number,
                                   const random_problem_kind& kind) {
  return drawing(seed, number, kind).draw();
}

}  // namespace contct
