// The loads of a problem along its path, as numbers and in a few words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contct/model/problem.hpp"

namespace contct {

/// The loads of a problem's steps, and what acts between them. Steps count from 1.
class load_path {
 public:
  /// `p` must outlive this object.
  explicit load_path(const problem& p);

  /// Everything that acts at share `fraction` of step `step`; nothing in step 0, before the first.
  [[nodiscard]] load at(int step, double fraction) const;
  /// Its resultant, 0 where the sum is nothing but rounding; `step` is at least 1.
  [[nodiscard]] resultant resultant_at(int step, double fraction) const;

  /// Has either end of the step more than 32 parts to list? Each element of a scattered list counts.
  [[nodiscard]] bool has_many_parts(int step) const;

  /// A few words: "w -15 at node 3", "uniform -768", or the resultant force of a mixed load; with
  /// as many digits, six at most, as fit into `width` columns. Never cut: the number alone, or
  /// nothing, where the words do not fit.
  [[nodiscard]] std::string words_at(int step, double fraction, int width) const;

 private:
  /// The step whose load stands at the start of this one; 0: none does.
  [[nodiscard]] int step_before(int step) const { return problem_.steps[step - 1].from_zero ? 0 : step - 1; }

  const problem& problem_;
  /// Of all that acts at the end of the step, summed in rational numbers when it is first asked for.
  [[nodiscard]] const resultant& total_of(int step) const;

  mutable std::vector<std::optional<resultant>> totals_;  // at the start, then at the end of each step
  std::vector<std::size_t> parts_;                        // how many things there are to write, likewise
};

/// Do these elements follow one another, each once?
[[nodiscard]] bool is_run(const std::vector<int>& elements);

}  // namespace contct
