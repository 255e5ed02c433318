#include "contct/proof/long_system.hpp"

#include <algorithm>
#include <limits>

namespace contct {
namespace {

/// A prescribed displacement is an exact sum, rounded once to 32 digits: this share of its magnitude, added
/// to element_value::size, widens the noise by more than this rounding. A large settlement may have more
/// digits than the difference of displacements that bends a short element.
constexpr double settled_share = 0x1p-17;

/// Shears and moments at the ends of a beam's elements. The error of each is at most sqrt(K_jj) rho, where K
/// is the stiffness of the element.
std::vector<element_value> values_of(const beam_elements<double_double>& beam, const load& l,
                                     std::span<const double_double> u, std::span<const char> fixed) {
  std::vector<element_value> all;
  const auto forces = beam.end_forces(l, u);
  all.reserve(4 * forces.size());
  for (int e = 0; e < beam.count(); ++e) {
    const auto own = u.subspan(std::size_t{2} * e).first<4>();
    const double h = beam.lengths()[e].hi;
    const double stiffness = 2 * beam.EI(e).hi / h;
    double tilt = std::abs((own[2] - own[0]).hi);
    for (const std::size_t i : {0, 2})
      if (fixed[std::size_t{2} * e + i] != 0) tilt += settled_share * std::abs(own[i].hi);
    const double moment = 3 * stiffness * (std::abs(own[1].hi) + std::abs(own[3].hi) + 2 * tilt / h);
    for (std::size_t i = 0; i < 4; ++i) {
      const bool shears = i < 2;
      all.push_back({forces[e][i], shears ? 2 * moment / h : moment,
                     shears ? std::sqrt(6 * stiffness) / h : std::sqrt(2 * stiffness), !shears});
    }
  }
  beam.for_each_work(l, [&](int e, const auto& work) {
    constexpr std::array<std::size_t, 4> loaded = {0, 2, 1, 3};
    for (std::size_t i = 0; i < 4; ++i) all[std::size_t{4} * e + i].size += work.size[loaded[i]];
  });
  return all;
}

/// Sums of the magnitudes from which w_xx and w_yy (bends) and w_xy (twists) at a corner are computed.
struct curvature_size {
  double bends = 0.0, twists = 0.0;
};

/// The size of each entry includes the slope of the plane that plate_elements::deformation subtracts.
std::array<curvature_size, 4> curvature_sizes(const plate_elements<double_double>& plate, int e,
                                              std::span<const double_double> u, std::span<const char> fixed) {
  const double a = plate.halves_of(e).a.hi;
  const double b = plate.halves_of(e).b.hi;
  const std::array<double_double, 12> own = plate.displacement(e, u);
  const std::array<double_double, 12> v = plate.deformation(e, u);
  double tilt = std::abs((own[3] - own[0]).hi) + std::abs((own[9] - own[0]).hi);
  for (std::size_t i = 0; i < 12; i += 3)
    if (fixed[plate.dofs_of(e)[i]] != 0) tilt += settled_share * std::abs(own[i].hi);
  std::array<curvature_size, 4> sizes;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto& c = formulas::corner_curvatures<double>()[k];
    for (std::size_t i = 0; i < 12; ++i) {
      const double size = std::abs(v[i].hi) + tilt;
      sizes[k].bends += size * (std::abs(c.xx[i]) / (a * a) + std::abs(c.yy[i]) / (b * b));
      sizes[k].twists += size * std::abs(c.xy[i]) / (a * b);
    }
  }
  return sizes;
}

/// Moments at the corners of elements. The energy bounds the root mean squares of the curvatures over an
/// element. The corner values of w_xx and w_yy, which are bilinear, are at most 4 times their root mean
/// square; those of w_xy, which has five terms, sqrt(17) times.
std::vector<element_value> values_of(const plate_elements<double_double>& plate, const load& /*l*/,
                                     std::span<const double_double> u, std::span<const char> fixed) {
  std::vector<element_value> all;
  const double D = plate.D().hi;
  for (int e = 0; e < plate.count(); ++e) {
    const auto [a, b] = plate.halves_of(e);
    const double area = 4 * a.hi * b.hi;
    const double bends = 4 * std::sqrt(D / area);
    const double twists = std::sqrt(17 * D * (1 - plate.nu().hi) / (2 * area));
    const std::array<std::array<double_double, 4>, 3> moments = plate.moments(e, u);
    const std::array<curvature_size, 4> sizes = curvature_sizes(plate, e, u, fixed);
    for (std::size_t name = 0; name < 3; ++name) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double size = name < 2 ? sizes[k].bends : 2 * sizes[k].twists;
        all.push_back({moments[name][k], D * size, name < 2 ? bends : twists, true});
      }
    }
  }
  return all;
}

std::vector<element_value> values_of(const no_elements<double_double>& /*none*/, const load& /*l*/,
                                     std::span<const double_double> /*u*/, std::span<const char> /*fixed*/) {
  return {};
}

double least_cube(std::span<const double> x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < x.size(); ++i) least = std::min(least, std::pow(x[i + 1] - x[i], 3));
  return least;
}

double least_product_of(const beam& b) {
  const double cube = least_cube(b.x);
  const double bent = std::min(cube, std::ranges::min(b.EI));
  // With shear: GA h^2 too, which is at least the product of the least GA and the least h^2.
  return b.GA.empty()
             ? bent
             : std::min({bent, std::ranges::min(b.GA), std::ranges::min(b.GA) * std::pow(cube, 2.0 / 3)});
}
double least_product_of(const plate& p) {
  return std::min({least_cube(p.x), least_cube(p.y), p.D});
}
double least_product_of(const assembled& /*a*/) {
  return 1.0;
}

}  // namespace

void long_system::add_product(std::span<const double_double> u, std::span<double_double> sum,
                              std::span<double> sizes) const {
  std::vector<double> scaled(sizes.size());
  for (std::size_t dof = 0; dof < sizes.size(); ++dof) scaled[dof] = root[dof] * std::abs(u[dof].hi);
  for (std::size_t dof = 0; dof < dofs(); ++dof) {
    double size = 0.0;
    sum[dof] = add_row(dof, u, sum[dof], [&](int column, const double_double& /*entry*/) {
      if (!sizes.empty()) size += scaled[column];
    });
    if (!sizes.empty()) sizes[dof] += root[dof] * size;
  }
}

const long_loads& long_system::at_end_of(int step) {
  if (loads_.step == step) return loads_;
  loads_ = {loads_of(what->steps[step - 1]), step};
  pairs = with_moved_faces(unmoved_, loads_.moved);
  for (std::size_t i = 0; i < pairs.size(); ++i)
    face_size[i] = std::abs(unmoved_[i].face.hi) + std::abs(loads_.moved[pairs[i].dof].hi);
  return loads_;
}

double long_system::doubt(std::size_t pair, std::span<const double_double> u) const {
  const double size = size_of_depth(pair, u);
  return size == 0.0 ? 0.0 : 2 * long_rounding * size + 0x1p-1000;  // for underflow
}

bool long_system::is_below_range(const long_loads& l) const {
  constexpr double least = 1e-280;  // the low half of a 32-digit number must be at least 1e-308
  const auto too_small = [](const double_double& x) { return x.hi != 0.0 && std::abs(x.hi) < least; };
  const auto has_small_pair = [&](const long_pair& p) { return too_small(p.face) || too_small(p.stiffness); };
  const auto has_small_entry = [&](const auto& row) {
    return std::ranges::any_of(row, [&](const auto& entry) { return too_small(entry.second); });
  };
  return least_product < least || std::ranges::any_of(stiffness, has_small_entry) ||
         std::ranges::any_of(pairs, has_small_pair) || std::ranges::any_of(l.force, too_small) ||
         std::ranges::any_of(l.settlement, too_small) || std::ranges::any_of(l.moved, too_small);
}

void long_system::put_forces(long_residual& r) const {
  for (std::size_t dof = 0; dof < dofs(); ++dof) {
    if (r.slack[dof] > 0.0) r.slack[dof] = 2 * long_rounding * r.slack[dof] + 0x1p-1000;  // for underflow
    if (fixed[dof] == 0) r.force[dof] = -r.needed[dof];
  }
}

long_residual long_system::residual_of_rounded(long_vector needed) const {
  long_residual r{long_vector(dofs()), std::vector<double>(dofs()), std::move(needed)};
  for (std::size_t dof = 0; dof < dofs(); ++dof)  // an underflowed residual does not count as 0
    r.slack[dof] = std::max(std::abs(r.needed[dof].hi), std::numeric_limits<double>::min());
  put_forces(r);
  return r;
}

long_residual long_system::residual(std::span<const double_double> u, const long_loads& l) const {
  long_residual r{long_vector(dofs()), l.size, long_vector(dofs())};
  for (std::size_t dof = 0; dof < dofs(); ++dof) r.needed[dof] = -l.force[dof];
  add_product(u, r.needed, r.slack);
  if (std::ranges::any_of(u, [](const double_double& x) { return x.hi != 0.0; }))
    for (double& size : r.slack)
      size = std::max(size, std::numeric_limits<double>::min());  // K u may underflow
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const long_pair& p = pairs[i];
    const double size = size_of_depth(i, u);
    if (depth(i, u).hi > -long_rounding * size) {
      r.slack[p.dof] += p.stiffness.hi * size;
      if (p.other >= 0) r.slack[p.other] += p.stiffness.hi * size;
    }
    add_pressing(p, u, r.needed);
  }
  for (const long_pair& p : with_moved_faces(held, l.moved)) {
    const double size = std::abs(u[p.dof].hi) + std::abs(p.face.hi) + std::abs(l.moved[p.dof].hi);
    if (depth_of(p, p.seen_in(u)).hi > -long_rounding * size) r.slack[p.dof] += p.stiffness.hi * size;
    add_pressing(p, u, r.needed);
  }
  put_forces(r);
  return r;
}

long_vector long_system::linear_residual(const long_residual& r, std::span<const double_double> u,
                                         const std::vector<int>& closed) const {
  long_vector force = r.force;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const long_pair& p = pairs[i];
    const double_double deep = depth(i, u);
    const bool is_closed = std::ranges::binary_search(closed, static_cast<int>(i));
    if (fixed[p.dof] != 0 || is_closed == (deep.hi > 0.0)) continue;
    const double_double spring = p.stiffness * deep * p.surface;
    p.add_to(force, is_closed ? -spring : spring);
  }
  return force;
}

void long_system::find_roots() {
  for (int dof = 0; dof < static_cast<int>(dofs()); ++dof)
    root.push_back(std::sqrt(stiffness[dof].at(dof).hi) * (1 + 0x1p-50));
}

bool long_system::is_at_rest(const long_loads& l) const {
  const auto none = [](const double_double& x) { return x == 0.0; };
  const std::vector<long_pair> at_supports = with_moved_faces(held, l.moved);
  const auto is_outside = [](const long_pair& p) { return p.face.hi * p.surface >= 0.0; };
  return std::ranges::all_of(l.size, [](double x) { return x == 0.0; }) &&
         std::ranges::all_of(l.settlement, none) && std::ranges::all_of(pairs, is_outside) &&
         std::ranges::all_of(at_supports, is_outside);
}

double extent_of(const model& m) {
  if (const auto* const b = std::get_if<beam>(&m.kind)) return b->x.back() - b->x.front();
  const auto* const p = std::get_if<plate>(&m.kind);
  return p == nullptr ? 0.0 : std::max(p->x.back() - p->x.front(), p->y.back() - p->y.front());
}

long_system long_system_of(const problem& p) {
  long_system t(equations_of<double_double>(p));
  t.what = &p;
  t.find_roots();
  for (int dof = 0; dof < static_cast<int>(t.dofs()); ++dof)
    t.deflects.push_back(dof % dofs_per_node(p.geometry) == 0 ? 1 : 0);
  std::visit(
      [&](const auto& kind) {
        t.least_product = least_product_of(kind);
        t.element_values = [&p, elements = elements_of<double_double>(kind), fixed = t.fixed](
                               int step, std::span<const double_double> u) {
          return values_of(elements, p.steps[step - 1], u, fixed);
        };
      },
      p.geometry.kind);
  return t;
}

}  // namespace contct
