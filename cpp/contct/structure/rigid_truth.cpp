#include "contct/structure/rigid_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "contct/numeric/rational.hpp"
#include "contct/numeric/rational_cone.hpp"
#include "contct/structure/exact_numbers.hpp"
#include "contct/structure/rigid_shape.hpp"

namespace contct::structure {

using numeric::decimal_of;
using numeric::rational;

/// One for each motion: up, about the middle of x, about the middle of y.
struct rigid_work::numbers {
  std::array<rational, 3> all;
};

namespace {

using motion_numbers = rigid_shape<rational>::row;

rational dot(const motion_numbers& a, const motion_numbers& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void subtract(motion_numbers& from, const motion_numbers& part, const rational& share) {
  for (std::size_t i = 0; i < from.size(); ++i) from[i] -= share * part[i];
}

/// What is left of `row` beside all of `orthogonal`.
motion_numbers rest_of(motion_numbers row, std::span<const motion_numbers> orthogonal) {
  for (const motion_numbers& b : orthogonal) subtract(row, b, dot(row, b) / dot(b, b));
  return row;
}

bool is_zero(const motion_numbers& row) {
  return row[0] == 0 && row[1] == 0 && row[2] == 0;
}

/// sum of coefficients[i] (b^(i+1) - a^(i+1)) / (i+1) and the same of x times the polynomial.
struct integrals {
  rational plain, by_x;
};
integrals integrate(std::span<const rational> coefficients, const rational& a, const rational& b) {
  integrals sum;
  rational power_a = a;
  rational power_b = b;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const int next = static_cast<int>(i) + 1;
    sum.plain += coefficients[i] * (power_b - power_a) / next;
    power_a *= a;
    power_b *= b;
    sum.by_x += coefficients[i] * (power_b - power_a) / (next + 1);
  }
  return sum;
}

/// Call visit(first, last) for each run of elements that follow each other, from 0.
template <class Visit>
void for_each_run(const std::vector<int>& elements, int all, const Visit& visit) {
  if (elements.empty()) return visit(0, all - 1);
  for (std::size_t i = 0; i < elements.size();) {
    std::size_t j = i;
    while (j + 1 < elements.size() && elements[j + 1] == elements[j] + 1) ++j;
    visit(elements[i], elements[j]);
    i = j + 1;
  }
}

}  // namespace

namespace {

/// What rounding can make of `across` at any point.
double rounding_along(const centred_line<rational>& l) {
  const std::span<const double> x = l.points().rounded();
  const double largest = std::max(std::abs(x.front()), std::abs(x.back()));
  return 8 * std::numeric_limits<double>::epsilon() * (1 + largest / (x.back() / 2 - x.front() / 2));
}

}  // namespace

/// A line for each direction in which it extends.
struct rigid_truth::shape : rigid_shape<rational> {
  using rigid_shape<rational>::rigid_shape;

  [[nodiscard]] double rounding() const {
    return std::max(rounding_along(along_x), along_y ? rounding_along(*along_y) : 0.0);
  }

  /// is_independent, where that needs no arithmetic.
  [[nodiscard]] std::optional<bool> seen_at_once(std::span<const int> held, int dof) const {
    if (held.empty()) return true;
    const auto same = [&](auto what) {
      return std::ranges::all_of(held, [&](int other) { return what(other) == what(dof); });
    };
    const bool all_deflections = kind_of(dof) == 0 && same([this](int d) { return kind_of(d); });
    if (kind_of(dof) != 0)
      for (const int other : held)
        if (kind_of(other) == kind_of(dof)) return false;
    if (!all_deflections) return std::nullopt;
    if (held.size() == 1) return held.front() != dof;
    if (held.size() == 2 && (!along_y || same([this](int d) { return line_of(d); }) ||
                             same([this](int d) { return column_of(d); })))
      return false;
    return std::nullopt;
  }

  void add_distributed(const distributed_load& d, motion_numbers& work) const {
    const std::vector<rational> q = coefficients_of<rational>(d);
    const int columns = along_x.points().intervals();
    if (!along_y) {
      for_each_run(d.elements, columns, [&](int first, int last) { add_strip(q, first, last, work); });
      return;
    }
    const int lines = along_y->points().intervals();
    if (d.elements.empty()) return add_rectangle(q[0], 0, columns - 1, 0, lines - 1, work);
    for_each_run(d.elements, columns * lines, [&](int first, int last) {
      for (int line = first / columns; line <= last / columns; ++line)
        add_rectangle(q[0], std::max(first - line * columns, 0), std::min(last - line * columns, columns - 1),
                      line, line, work);
    });
  }

 private:
  void add_strip(std::span<const rational> q, int first, int last, motion_numbers& work) const {
    const integrals over = integrate(q, along_x.points().at(first), along_x.points().at(last + 1));
    work[0] += over.plain;
    work[1] += over.by_x / along_x.half() + over.plain * along_x.across(0);
  }

  /// A uniform pressure acts at the middle of the rectangle.
  void add_rectangle(const rational& pressure, int left, int right, int below, int above,
                     motion_numbers& work) const {
    const auto ends = [](const centred_line<rational>& l, int first, int last) {
      return std::pair(l.points().at(first), l.points().at(last + 1));
    };
    const auto [x1, x2] = ends(along_x, left, right);
    const auto [y1, y2] = ends(*along_y, below, above);
    const rational force = pressure * (x2 - x1) * (y2 - y1);
    work[0] += force;
    work[1] += force * along_x.across((x1 + x2) / 2);
    work[2] += force * along_y->across((y1 + y2) / 2);
  }
};

bool rigid_rank::is_independent(int dof) const {
  return truth_->is_independent(dofs(), dof);
}

rigid_work rigid_work::less(const rigid_work& other) const {
  if (!is_known() || !other.is_known()) return {};
  auto difference = std::make_shared<numbers>(*exactly_);
  subtract(difference->all, other.exactly_->all, 1);
  return rigid_work(std::move(difference));
}

double free_motion::at(int dof, const rigid_row& row) const {
  const double rounded = along(parts_, row);
  if (std::abs(rounded) >= still_ * largest_of(row)) return rounded;
  return truth_ ? numeric::rounded(dot(exactly_->all, truth_->shape_->row_of(dof))) : 0.0;
}

rigid_truth::rigid_truth(const beam& b) : shape_(std::make_unique<shape>(b)) {}
rigid_truth::rigid_truth(const plate& p) : shape_(std::make_unique<shape>(p)) {}
rigid_truth::~rigid_truth() = default;

bool rigid_truth::is_independent(std::span<const int> held, int dof) const {
  if (const std::optional<bool> known = shape_->seen_at_once(held, dof)) return *known;
  std::vector<motion_numbers> orthogonal;
  for (const int other : held) orthogonal.push_back(rest_of(shape_->row_of(other), orthogonal));
  return !is_zero(rest_of(shape_->row_of(dof), orthogonal));
}

rigid_work rigid_truth::work_of(const load& l) const {
  auto work = std::make_shared<rigid_work::numbers>();
  for (const point_load& p : l.points)
    subtract(work->all, shape_->row_of(p.node * shape_->dofs_per_node() + p.dof), -decimal_of(p.value));
  for (const distributed_load& d : l.distributed) shape_->add_distributed(d, work->all);
  return rigid_work(std::move(work));
}

resultant rigid_truth::resultant_of(const load& l) const {
  const motion_numbers work = work_of(l).exactly().all;
  const auto about_origin = [&work](const centred_line<rational>& line, const rational& about_middle) {
    return numeric::rounded(about_middle * line.half() + work[0] * line.middle());
  };
  resultant r{numeric::rounded(work[0]), {about_origin(shape_->along_x, work[1])}};
  if (shape_->along_y) r.moments.push_back(about_origin(*shape_->along_y, work[2]));
  return r;
}

bool rigid_truth::is_carried(const rigid_work& work, std::span<const int> supported,
                             std::span<const contact_pair> pairs) const {
  std::vector<motion_numbers> stopped;
  for (const int dof : supported)
    if (motion_numbers rest = rest_of(shape_->row_of(dof), stopped); !is_zero(rest))
      stopped.push_back(std::move(rest));
  const std::size_t motions = shape_->along_y ? 3 : 2;
  if (stopped.size() == motions) return true;
  // What supports leave, in the directions in which they leave something.
  std::vector<motion_numbers> free = stopped;
  for (std::size_t m = 0; m < motions && free.size() < motions; ++m) {
    motion_numbers unit{};
    unit[m] = 1;
    if (motion_numbers rest = rest_of(unit, free); !is_zero(rest)) free.push_back(std::move(rest));
  }
  free.erase(free.begin(), free.begin() + static_cast<std::ptrdiff_t>(stopped.size()));
  const auto along_free = [&free](const motion_numbers& row, int times) {
    std::vector<rational> parts;
    parts.reserve(free.size());
    for (const motion_numbers& f : free) parts.emplace_back(dot(row, f) * times);
    return parts;
  };
  std::vector<std::vector<rational>> presses;
  for (const contact_pair& p : pairs)
    presses.push_back(along_free(shape_->row_of(p.node * shape_->dofs_per_node()), p.surface));
  return numeric::is_in_cone(along_free(work.exactly().all, 1), presses);
}

std::optional<free_motion> rigid_truth::driven_by(const rigid_work& work, std::span<const int> held) const {
  std::vector<motion_numbers> orthogonal;
  for (const int dof : held) orthogonal.push_back(rest_of(shape_->row_of(dof), orthogonal));
  motion_numbers steepest = rest_of(work.exactly().all, orthogonal);
  if (is_zero(steepest)) return std::nullopt;
  rational largest;
  for (const rational& part : steepest) largest = std::max(largest, rational(abs(part)));
  rigid_row parts{};
  for (std::size_t i = 0; i < steepest.size(); ++i) {
    steepest[i] /= largest;
    parts[i] = numeric::rounded(steepest[i]);
  }
  constexpr double safely = 16;
  free_motion motion(parts, safely * shape_->rounding(), numeric::rounded(dot(work.exactly().all, steepest)));
  motion.exactly_ = std::make_shared<rigid_work::numbers>(rigid_work::numbers{std::move(steepest)});
  motion.truth_ = shared_from_this();
  return motion;
}

}  // namespace contct::structure
