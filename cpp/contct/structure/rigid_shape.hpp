// What the rigid motions of a beam or plate do at its dofs, in numbers of any kind.
#pragma once

#include <array>
#include <optional>
#include <utility>

#include "contct/structure/line.hpp"

namespace contct::structure {

/// A line seen from its middle.
template <class Number>
class centred_line {
 public:
  centred_line(std::span<const double> x, std::span<const even_run> runs)
      : points_(x, runs), first_(points_.at(0)), half_((points_.at(x.size() - 1) - first_) / 2) {}

  [[nodiscard]] const line<Number>& points() const { return points_; }
  [[nodiscard]] const Number& half() const { return half_; }
  [[nodiscard]] Number middle() const { return first_ + half_; }
  /// From -1 to 1 over the line.
  [[nodiscard]] Number across(const Number& x) const { return (x - first_) / half_ - 1; }

 private:
  line<Number> points_;
  Number first_, half_;
};

/// A line for each direction in which a structure extends. Its motions are up by 1, and turns about the
/// middle that lift the end at the largest x, or y, by 1.
template <class Number>
struct rigid_shape {
  using row = std::array<Number, 3>;

  explicit rigid_shape(const beam& b) : along_x(b.x, b.runs) {}
  explicit rigid_shape(const plate& p) : along_x(p.x, p.x_runs), along_y(std::in_place, p.y, p.y_runs) {}

  centred_line<Number> along_x;
  std::optional<centred_line<Number>> along_y;

  [[nodiscard]] int dofs_per_node() const { return along_y ? plate::dofs_per_node : beam::dofs_per_node; }
  [[nodiscard]] std::size_t column_of(int dof) const {
    return (dof / dofs_per_node()) % along_x.points().size();
  }
  [[nodiscard]] std::size_t line_of(int dof) const {
    return (dof / dofs_per_node()) / along_x.points().size();
  }
  /// 0: a deflection; otherwise the slope along x (1) or y (2).
  [[nodiscard]] int kind_of(int dof) const { return dof % dofs_per_node(); }

  [[nodiscard]] row row_of(int dof) const {
    if (kind_of(dof) == 1) return {Number(0), 1 / along_x.half(), Number(0)};
    if (kind_of(dof) == 2) return {Number(0), Number(0), 1 / along_y->half()};
    const Number x = along_x.across(along_x.points().at(column_of(dof)));
    return {Number(1), x, along_y ? along_y->across(along_y->points().at(line_of(dof))) : Number(0)};
  }
};

}  // namespace contct::structure
