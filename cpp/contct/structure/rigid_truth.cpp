// The rigid-body motions of beams and plates.
#include <algorithm>

#include "contct/structure/acting.hpp"

namespace contct {

/// [motions] the work, in the order of the rows of rigid_shape.
struct rigid_numbers : rational_vector {
  using rational_vector::rational_vector;
};

/// A line with the coordinate `across`, which is 0 at its middle.
template <class Number>
class centred_line {
 public:
  centred_line(std::span<const double> x, std::span<const even_run> runs)
      : points_(x, runs), first_(points_.at(0)), half_((points_.at(x.size() - 1) - first_) / 2) {}

  [[nodiscard]] const line<Number>& points() const { return points_; }
  [[nodiscard]] const Number& half() const { return half_; }
  [[nodiscard]] Number middle() const { return first_ + half_; }
  /// From -1 at the first point to 1 at the last one.
  [[nodiscard]] Number across(const Number& x) const { return (x - first_) / half_ - 1; }

 private:
  line<Number> points_;
  Number first_, half_;
};

/// The rigid-body motions that rigid_truth describes. A beam stays straight between its ends and hinges.
template <class Number>
struct rigid_shape {
  using row = std::vector<Number>;

  explicit rigid_shape(const beam& b) : along_x(b.x, b.runs) {
    if (b.corners().size() == 2) return;
    corners = b.corners();
    for (const int node : corners) corner_x.push_back(along_x.points().at(node));
  }
  explicit rigid_shape(const plate& p) : along_x(p.x, p.x_runs), along_y(std::in_place, p.y, p.y_runs) {}

  centred_line<Number> along_x;
  std::optional<centred_line<Number>> along_y;
  std::vector<int> corners;      // nodes of the ends and hinges, ascending; empty without hinges
  std::vector<Number> corner_x;  // [corners]

  [[nodiscard]] int motions() const {
    return corners.empty() ? dofs_per_node() : static_cast<int>(corners.size());
  }
  /// The straight part that begins at `node` or contains it; the last part for the last node.
  [[nodiscard]] std::size_t part_of(int node) const {
    if (corners.empty()) return 0;
    const auto right = std::upper_bound(corners.begin(), corners.end() - 1, node);
    return std::min<std::size_t>(right - corners.begin(), corners.size() - 1) - 1;
  }
  [[nodiscard]] int dofs_per_node() const { return along_y ? plate::dofs_per_node : beam::dofs_per_node; }
  [[nodiscard]] std::size_t column_of(int dof) const {
    return (dof / dofs_per_node()) % along_x.points().size();
  }
  [[nodiscard]] std::size_t line_of(int dof) const {
    return (dof / dofs_per_node()) / along_x.points().size();
  }
  /// 0: a deflection; otherwise the slope along x (1) or y (2).
  [[nodiscard]] int kind_of(int dof) const { return dof % dofs_per_node(); }

  /// The deflection at x by each motion of a beam, or the slope if `turns`. `part`: the straight part that
  /// contains x.
  [[nodiscard]] row along_beam(const Number& x, std::size_t part, bool turns) const {
    row all(motions());
    const Number one(1);
    if (corners.empty()) {
      all[turns ? 1 : 0] = turns ? one / along_x.half() : one;
      if (!turns) all[1] = along_x.across(x);
      return all;
    }
    all[part + 1] = one / (corner_x[part + 1] - corner_x[part]);
    if (!turns) all[part + 1] *= x - corner_x[part];
    all[part] = (turns ? Number(0) : one) - all[part + 1];
    return all;
  }

  [[nodiscard]] row row_of(int dof) const {
    const Number x = along_x.points().at(column_of(dof));
    if (!along_y) return along_beam(x, part_of(static_cast<int>(column_of(dof))), kind_of(dof) != 0);
    row all(motions());
    const Number one(1);
    if (kind_of(dof) != 0) {
      all[kind_of(dof)] = one / (kind_of(dof) == 1 ? along_x : *along_y).half();
      return all;
    }
    all[0] = one;
    all[1] = along_x.across(x);
    all[2] = along_y->across(along_y->points().at(line_of(dof)));
    return all;
  }
};

namespace {

/// The part of `row` that is orthogonal to all rows of `orthogonal`, which are orthogonal to each other.
rational_vector rest_of(rational_vector row, std::span<const rational_vector> orthogonal) {
  for (const rational_vector& b : orthogonal) add(row, b, -dot(row, b) / dot(b, b));
  return row;
}

/// Orthogonal rows with the same span as `rows`.
std::vector<rational_vector> orthogonal_of(std::span<const rational_vector> rows) {
  std::vector<rational_vector> all;
  for (const rational_vector& row : rows)
    if (rational_vector rest = rest_of(row, all); !is_zero(rest)) all.push_back(std::move(rest));
  return all;
}

/// True if the projection of `sum` onto the span of `parts` is a sum of the parts with nonnegative factors.
/// False if the parts are not independent.
bool has_positive_shares(const rational_vector& sum, std::span<const rational_vector> parts) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<rational_vector> others(parts.begin(), parts.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const rational_vector own = rest_of(parts[i], orthogonal_of(others));
    if (is_zero(own) || dot(sum, own) < 0) return false;
  }
  return true;
}

/// The subset of `parts` whose sum with nonnegative factors comes nearest to `sum`. Tries all subsets.
std::vector<rational_vector> nearest_of(const rational_vector& sum, std::span<const rational_vector> parts) {
  std::vector<rational_vector> nearest;
  rational least = dot(sum, sum);
  for (unsigned chosen = 1; chosen < 1U << parts.size(); ++chosen) {
    std::vector<rational_vector> some;
    for (std::size_t i = 0; i < parts.size(); ++i)
      if ((chosen >> i & 1U) != 0) some.push_back(parts[i]);
    const rational_vector rest = rest_of(sum, orthogonal_of(some));
    if (const rational far = dot(rest, rest); far < least && has_positive_shares(sum, some)) {
      nearest = some;
      least = far;
    }
  }
  return nearest;
}

/// True if `sum` is a sum of `parts` with nonnegative factors. The nearest of these sums needs no more parts
/// than there are motions. Each round adds the part that reduces the distance from `sum` fastest and drops
/// parts that are not needed. The search ends because every round reduces the distance.
bool is_in_cone(const rational_vector& sum, std::span<const rational_vector> parts) {
  std::vector<rational_vector> carrying;
  for (;;) {
    const rational_vector rest = rest_of(sum, orthogonal_of(carrying));
    if (is_zero(rest)) return true;
    const rational_vector* leads_nearer = nullptr;
    rational most = 0;
    for (const rational_vector& part : parts) {
      if (rational gain = dot(part, rest); gain > most) {
        most = std::move(gain);
        leads_nearer = &part;
      }
    }
    if (leads_nearer == nullptr) return false;
    carrying.push_back(*leads_nearer);
    carrying = nearest_of(sum, carrying);
  }
}

}  // namespace

struct rigid_truth::shape : rigid_shape<rational> {
  using rigid_shape<rational>::rigid_shape;

  /// An orthogonal basis of the span of the rows of `dofs`.
  [[nodiscard]] std::vector<rational_vector> orthogonal_rows(std::span<const int> dofs) const {
    std::vector<rational_vector> rows;
    for (const int dof : dofs) rows.push_back(row_of(dof));
    return orthogonal_of(rows);
  }

  /// The result of is_independent, if it needs no arithmetic.
  [[nodiscard]] std::optional<bool> seen_at_once(std::span<const int> held, int dof) const {
    if (held.empty()) return true;
    if (!corners.empty()) return std::nullopt;
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

  /// Adds the work of the loads on elements. An imposed curvature does no work on a rigid-body motion.
  void add_loads(const load& l, rational_vector& work) const {
    const line<rational>& x = along_x.points();
    for (const acting& a : acting_on(x, along_y ? &along_y->points() : nullptr, l)) {
      const auto [from, to] = a.x.ends(x);
      if (along_y && a.what == load_kind::moment) {
        for (std::size_t i = 0; i < a.values.size(); ++i)
          add(work, row_of(static_cast<int>(i) + 1), a.values[i]);  // a motion has the same slopes everywhere
      } else if (along_y) {
        add_rectangle(a.values[0], {from, to}, a.y.ends(along_y->points()), work);
      } else if (a.what == load_kind::force) {
        add_strip(a.values, from, to, work);
      } else if (a.what != load_kind::curvature) {
        std::size_t part = 0;
        while (part + 2 < corner_x.size() && corner_x[part + 1] <= from) ++part;
        add(work, along_beam(from, part, a.what == load_kind::moment), a.values[0]);
      }
    }
  }

 private:
  /// Adds the work of the load `q` from `from` to `to`. In each straight part a motion is linear, so that the
  /// load on this part does the work of two forces at the ends of the load.
  void add_strip(const rational_vector& q, const rational& from, const rational& to,
                 rational_vector& work) const {
    const std::size_t parts = corners.empty() ? 1 : corners.size() - 1;
    for (std::size_t part = 0; part < parts; ++part) {
      const rational left = corners.empty() ? from : std::max(from, corner_x[part]);
      const rational right = corners.empty() ? to : std::min(to, corner_x[part + 1]);
      if (left >= right) continue;
      const rational at_right = integral_of<rational>({-left, 1}, q, left, right) / (right - left);
      add(work, along_beam(left, part, false), integral_of<rational>({1}, q, left, right) - at_right);
      add(work, along_beam(right, part, false), at_right);
    }
  }

  using ends = std::array<rational, 2>;

  /// A uniform pressure does the work of its resultant at the middle of the rectangle.
  void add_rectangle(const rational& pressure, const ends& x, const ends& y, rational_vector& work) const {
    const rational force = pressure * (x[1] - x[0]) * (y[1] - y[0]);
    work[0] += force;
    work[1] += force * along_x.across((x[0] + x[1]) / 2);
    work[2] += force * along_y->across((y[0] + y[1]) / 2);
  }
};

template <class Kind>
std::vector<rigid_row> rigid_rows_of(const Kind& kind) {
  const rigid_shape<double> shape(kind);
  std::vector<rigid_row> rows;
  rows.reserve(kind.dofs());
  for (int dof = 0; dof < kind.dofs(); ++dof) {
    const std::vector<double> all = shape.row_of(dof);
    rigid_row& row = rows.emplace_back();
    std::copy_n(all.begin(), std::min(all.size(), row.size()), row.begin());
  }
  return rows;
}
template std::vector<rigid_row> rigid_rows_of(const beam& b);
template std::vector<rigid_row> rigid_rows_of(const plate& p);

rigid_work difference_of(const rigid_work& work, const rigid_work& other) {
  if (!work || !other) return {};
  auto difference = std::make_shared<rigid_numbers>(*work);
  add(*difference, *other, -1);
  return difference;
}

rigid_truth::rigid_truth(const beam& b) : shape_(std::make_shared<shape>(b)) {}
rigid_truth::rigid_truth(const plate& p) : shape_(std::make_shared<shape>(p)) {}

int rigid_truth::motions() const {
  return shape_->motions();
}

bool rigid_truth::is_independent(std::span<const int> held, int dof) const {
  if (const std::optional<bool> known = shape_->seen_at_once(held, dof)) return *known;
  return !is_zero(rest_of(shape_->row_of(dof), shape_->orthogonal_rows(held)));
}

rigid_work rigid_truth::work_of(const load& l) const {
  auto work = std::make_shared<rigid_numbers>(motions());
  for (const point_load& p : l.points)
    add(*work, shape_->row_of(p.node * shape_->dofs_per_node() + p.dof),
        product_of<rational>(p.value, p.factor));
  shape_->add_loads(l, *work);
  return work;
}

resultant rigid_truth::resultant_of(const load& l) const {
  const rational_vector work = *work_of(l);
  if (!shape_->corners.empty()) {
    rational force;
    rational moment;
    for (std::size_t i = 0; i < work.size(); ++i) {
      force += work[i];
      moment += work[i] * shape_->corner_x[i];
    }
    return {contct::rounded(force), {contct::rounded(moment)}};
  }
  const auto about_origin = [&work](const centred_line<rational>& line, const rational& about_middle) {
    return contct::rounded(about_middle * line.half() + work[0] * line.middle());
  };
  resultant r{contct::rounded(work[0]), {about_origin(shape_->along_x, work[1])}};
  if (shape_->along_y) r.moments.push_back(about_origin(*shape_->along_y, work[2]));
  return r;
}

bool rigid_truth::is_carried(const rigid_work& work, std::span<const int> supported,
                             std::span<const pair_in<double>> pairs) const {
  std::vector<rational_vector> stopped;
  for (const int dof : supported) {
    if (rational_vector rest = rest_of(shape_->row_of(dof), stopped); !is_zero(rest))
      stopped.push_back(std::move(rest));
    if (static_cast<int>(stopped.size()) == motions()) return true;
  }
  // From here on, only motions that the supports leave free count. A face above carries upward loads.
  std::vector<rational_vector> presses;
  for (const pair_in<double>& p : pairs) {
    rational_vector& part = presses.emplace_back(shape_->row_of(p.dof));
    for (rational& x : part) x *= p.surface;
    part = rest_of(part, stopped);
  }
  return is_in_cone(rest_of(*work, stopped), presses);
}

std::optional<free_motion> rigid_truth::driven_by(const rigid_work& work, std::span<const int> held,
                                                  std::span<const rigid_row> rows) const {
  rational_vector steepest = rest_of(*work, shape_->orthogonal_rows(held));
  if (is_zero(steepest)) return std::nullopt;
  rational largest;
  for (const rational& part : steepest) largest = std::max(largest, rational(abs(part)));
  rigid_row parts{};
  for (std::size_t i = 0; i < steepest.size(); ++i) {
    steepest[i] /= largest;
    if (i < parts.size()) parts[i] = contct::rounded(steepest[i]);
  }
  const bool is_all = steepest.size() <= parts.size();
  const double done = contct::rounded(dot(*work, steepest));
  return free_motion{[parts, rows, steepest, is_all, shape = shape_](int dof) {
                       constexpr double surely_moves = 1e-3;  // relative to the largest entry of the row
                       const double moved = along(parts, rows[dof]);
                       if (is_all && std::abs(moved) >= surely_moves * largest_of(rows[dof])) return moved;
                       return contct::rounded(dot(steepest, shape->row_of(dof)));
                     },
                     done};
}

}  // namespace contct
