#include "contct/results/random_problem.hpp"

#include <algorithm>
#include <cmath>

#include "contct/linear/cholesky.hpp"
#include "contct/number/random.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/exact_means.hpp"

namespace contct {
namespace {

/// Draws one problem in random units of length and force.
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
    if (problem_.held && !is_plate()) draw_beam_supports();
    if (problem_.held && is_plate()) draw_plate_supports(std::get<plate>(problem_.geometry.kind));
    draw_steps();
    draw_pairs();
    return std::move(problem_);
  }

 private:
  double between(double least, double most) { return least + (most - least) * random_.unit(); }
  double power_between(double least, double most) { return std::pow(10.0, between(least, most)); }
  [[nodiscard]] int node_count() const { return nodes(problem_.geometry); }
  [[nodiscard]] bool is_plate() const { return std::holds_alternative<plate>(problem_.geometry.kind); }

  /// The mirror image of a node about the middle in x.
  [[nodiscard]] int mirror_of(int node) const {
    if (const auto* p = std::get_if<plate>(&problem_.geometry.kind))
      return p->node_at(p->columns() - 1 - node % p->columns(), node / p->columns());
    return node_count() - 1 - node;
  }
  [[nodiscard]] bool mirrored() const {
    return problem_.layout == face_layout::symmetric || problem_.layout == face_layout::antisymmetric;
  }

  void draw_geometry() {
    if (random_.chance(kind_.plate_share)) {
      plate p;
      p.x = lines(kind_.most_lines, problem_.unit);
      p.y = lines(kind_.most_lines, problem_.unit * power_between(-0.5, 0.5));
      p.D = force_ * problem_.unit;
      p.nu = between(-0.2, 0.45);
      problem_.geometry.kind = std::move(p);
    } else {
      beam b;
      b.x = lines(kind_.most_elements, problem_.unit);
      b.EI.assign(b.x.size() - 1, force_ * problem_.unit * problem_.unit);
      problem_.geometry.kind = std::move(b);
    }
  }

  std::vector<double> lines(int most_elements, double length) {
    const int elements = mirrored() ? 2 * random_.whole(1 + most_elements / 12, most_elements / 2)
                                    : random_.whole(std::min(3, most_elements), most_elements);
    const bool even = mirrored() || random_.chance(0.6);
    std::vector<double> x{0.0};
    for (int e = 0; e < elements; ++e) x.push_back(x.back() + (even ? 1.0 : between(0.3, 1.7)));
    const double last = x.back();
    for (double& at : x) at *= length / last;
    return x;
  }

  void draw_beam_supports() {
    const int last = node_count() - 1;
    const int middle = random_.whole(1, last - 1);
    const int how = mirrored() ? 2 * random_.whole(0, 1) : random_.whole(0, 5);
    if (how == 0) fix({{0, 0}, {last, 0}});
    if (how == 1) fix({{0, 0}, {0, 1}});
    if (how == 2) fix({{0, 0}, {0, 1}, {last, 0}, {last, 1}});
    if (how == 3) fix({{0, 0}, {0, 1}, {last, 0}});
    if (how == 4) fix({{0, 0}, {middle, 0}});
    if (how != 5) return;
    const double k = force_ / problem_.unit * power_between(0, 4);
    problem_.supports.push_back({0, 0, false, k});
    problem_.supports.push_back({last, 0, false, k});
  }

  /// Holds all edges, clamps one edge or two opposite edges, or holds the corners, rigidly or by springs.
  void draw_plate_supports(const plate& p) {
    const int how = random_.whole(0, 3);
    const double k = force_ / problem_.unit * power_between(0, 4);
    for (int j = 0; j < p.rows(); ++j) {
      for (int i = 0; i < p.columns(); ++i) {
        const bool left = i == 0;
        const bool right = i == p.columns() - 1;
        const bool across = j == 0 || j == p.rows() - 1;
        const int node = p.node_at(i, j);
        if (how == 0 && (left || right || across)) fix({{node, 0}});
        if (how == 1 && (left || (right && mirrored()))) fix({{node, 0}, {node, 1}, {node, 2}});
        if (how == 2 && (left || right) && across) fix({{node, 0}});
        if (how == 3 && (left || right) && across) problem_.supports.push_back({node, 0, false, k});
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

  /// Draws one to five steps, with a new load, no load, the reversed last load, or a multiple of the last
  /// load.
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
    const double extent = is_plate() ? problem_.unit * problem_.unit : problem_.unit;
    if (spread) l.distributed.push_back({{sign * force_ / extent * between(0.1, 2.0)}, {}});
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
    const int node = random_.whole(0, node_count() - 1);
    if (random_.chance(0.25))
      return {node, random_.whole(1, is_plate() ? 2 : 1), force_ * problem_.unit * between(-0.3, 0.3)};
    return {node, 0, force_ * (problem_.held ? between(-1.0, 1.0) : between(-1.0, 0.3))};
  }

  void add_mirrored_points(load& l, double sign) {
    const int node = random_.whole(0, node_count() - 1);
    if (mirror_of(node) == node) return;
    const double value = force_ * between(-1.0, 1.0);
    l.points.push_back({node, 0, value});
    l.points.push_back({mirror_of(node), 0, sign * value});
  }

  static load times(double factor, load l) {
    for (point_load& p : l.points) p.value *= factor;
    for (distributed_load& d : l.distributed) {
      for (double& a : d.polynomial) a *= factor;
    }
    return l;
  }

  /// Deflections [nodes] under the first load without pairs, which give the size of useful gaps; 0.01 units
  /// if the structure cannot be solved without pairs.
  [[nodiscard]] std::vector<double> free_deflection() const {
    const linear_structure s = build(problem_.geometry, problem_.supports, {});
    const std::vector<double> f = nodal_loads(problem_.geometry, problem_.steps.front()).force;
    const int stride = s.dofs_per_node;
    std::vector<double> w(f.size() / stride, 0.01 * problem_.unit);
    stiffness_factor k(s.stiffness);
    if (!problem_.held || !k.factor({})) return w;
    std::vector<double> u(f.size());
    for (int dof = 0; dof < s.dofs(); ++dof) u[s.row_of(dof)] = s.fixed[dof] != 0 ? 0.0 : f[dof];
    k.solve(u);
    for (std::size_t node = 0; node < w.size(); ++node) w[node] = u[s.row_of(node * stride)];
    return w;
  }

  void draw_pairs() {
    const std::vector<double> w = free_deflection();
    for (const double at : w) largest_ = std::max(largest_, std::abs(at));
    if (largest_ == 0.0) largest_ = 0.01 * problem_.unit;  // all loads act on supports
    common_stiffness_ = random_.chance(0.5) ? power_between(0, 8) : 0.0;
    common_gap_ = largest_ * power_between(-2, 0);
    const double density = problem_.held ? between(0.2, 1.0) : between(0.6, 1.0);
    for (int node = 0; node < node_count(); ++node) {
      if (fixed_in_w(node) || (mirrored() && mirror_of(node) < node)) continue;
      const bool end = node == 0 || node == node_count() - 1;
      if (random_.chance(density) || (!problem_.held && end)) place(node, w[node]);
    }
    if (problem_.pairs.empty()) place(node_count() / 2, w[w.size() / 2]);
  }

  void place(int node, double w) {
    contact_pair p{};
    p.node = node;
    p.surface = side(w);
    p.stiffness =
        force_ / problem_.unit * (common_stiffness_ > 0.0 ? common_stiffness_ : power_between(0, 8));
    const auto add = [&] {
      p.face = p.surface * gap();
      p.closed = p.face == 0.0;
      problem_.pairs.push_back(p);
    };
    add();
    if (problem_.layout == face_layout::two_sided) {
      p.surface = -p.surface;
      add();
    }
    if (!mirrored()) return;
    const int other = mirror_of(node);
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
    if (problem_.layout == face_layout::zero) return 0.0;
    if (problem_.layout == face_layout::equal_gaps) return common_gap_;
    if (problem_.layout == face_layout::near_ties)
      return common_gap_ * (1.0 + between(-1.0, 1.0) * power_between(-15, -3));
    const bool none = problem_.layout != face_layout::gaps && random_.chance(0.4);
    return none ? 0.0 : largest_ * power_between(-2, 0.2);
  }

  random_numbers random_;
  random_problem_kind kind_;
  random_problem problem_;
  double force_ = 1.0;
  double largest_ = 0.0;
  double common_stiffness_ = 0.0;
  double common_gap_ = 0.0;
};

verdict judge(const solved_path& p) {
  const path_end& end = p.end;
  if (end.status == path_status::solved) return p.all_certified() ? verdict::certified : verdict::wrong;
  if (end.status == path_status::mechanism) return verdict::no_equilibrium;
  return end.status == path_status::path_ended ? verdict::false_mechanism : verdict::no_end;
}

random_problem small_problem(std::uint64_t seed, std::int64_t number) {
  random_problem_kind kind;
  kind.most_elements = 16;
  kind.most_lines = 4;
  return make_random_problem(seed, number, kind);
}

struct calls_to final : observer {
  explicit calls_to(const std::function<void(const answered_call&)>& f) : to(f) {}
  void called(const answered_call& c) override { to(c); }
  const std::function<void(const answered_call&)>& to;
};

/// The verdict on the path of a new kernel; no_end if the kernel gives no answer.
verdict verdict_of(const problem& p, const fresh_kernel& make) {
  try {
    return try_problem(p, *make()).came_to;
  } catch (const kernel_failure&) {
    return verdict::no_end;
  }
}

}  // namespace

random_problem make_random_problem(std::uint64_t seed, std::uint64_t number,
                                   const random_problem_kind& kind) {
  return drawing(seed, number, kind).draw();
}

problem_result try_problem(const problem& p, kernel& leader, std::string_view engine) {
  return try_structure(p, structure_of(p), leader, engine);
}

problem_result try_structure(const problem& p, const linear_structure& s, kernel& leader,
                             std::string_view engine, const std::vector<observer*>& watching) {
  problem_result t;
  certifier proof(p, s, exact_means_of(p));
  t.followed = follow(p, s, engine, leader, watching, &proof);
  t.came_to = judge(t.followed);
  return t;
}

void small_problems::follow(std::int64_t number, kernel& leader,
                            const std::function<void(const answered_call&)>& called) const {
  const random_problem p = small_problem(seed_, number);
  calls_to calls(called);
  (void)contct::follow(p, structure_of(p), "refactor", leader, {&calls});
}

bool small_problems::has_verdict_of(std::int64_t number, const fresh_kernel& leader,
                                    const fresh_kernel& follower) const {
  const random_problem p = small_problem(seed_, number);
  const verdict leads = verdict_of(p, leader);
  const bool obliges = leads == verdict::certified || leads == verdict::no_equilibrium;
  return !obliges || verdict_of(p, follower) == leads;
}

}  // namespace contct
