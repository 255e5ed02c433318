#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct {

/// The load at share `fraction` of step `step`, from 1; empty in step 0, before the first step.
[[nodiscard]] load load_at(const problem& p, int step, double fraction);

/// The loads of a problem at each point of its path, as sums and in words. Steps count from 1.
class load_path {
 public:
  /// `p` must outlive this object.
  explicit load_path(const problem& p) : problem_(p), totals_(p.steps.size() + 1) {}

  /// The resultant of load_at. A sum that is only rounding is 0. `step` is at least 1.
  [[nodiscard]] resultant resultant_at(int step, double fraction) const;

  /// True if the load at either end of the step has over 32 parts. Scattered elements are separate parts.
  [[nodiscard]] bool has_many_parts(int step) const;

  /// The load in words: "w -15 at node 3", "uniform -768", the resultant force of a mixed load, or the
  /// largest curvature of several, with six digits. If this does not fit into `width` characters, it has no
  /// place, three digits, no kind, or nothing.
  [[nodiscard]] std::string words_at(int step, double fraction, int width) const;

 private:
  const problem& problem_;
  /// The resultant at the end of a step; 0 for step 0. It is summed in rational numbers at the first request.
  [[nodiscard]] const resultant& total_of(int step) const;

  mutable std::vector<std::optional<resultant>> totals_;
};

/// True if these elements are consecutive and in ascending order.
[[nodiscard]] bool is_run(const std::vector<int>& elements);

}  // namespace contct
