// The load at any moment of the path, for people and for JSON, in the words of a problem file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct {

/// The loads of a problem's steps, and what acts between them.
class load_path {
 public:
  explicit load_path(const problem& p);

  /// Everything that acts at share `fraction` of step `step` (from 1).
  [[nodiscard]] load at(int step, double fraction) const;

  /// As a problem file's `uniform` and `point`, with the resultant: an event's load in absolute
  /// terms. A beam's resultant has "force" and "moment", a plate's "force", "moment_wx" and
  /// "moment_wy", a matrix's the "sum" of all its loads. The parts are left out when there are more than 32
  /// of them, where each element of a scattered list counts: they would be written again at every event.
  [[nodiscard]] nlohmann::ordered_json json_at(int step, double fraction) const;

  /// A few words: "w -15 at node 3", "uniform -768", or the resultant force of a mixed load; with
  /// as many digits, six at most, as fit into `width` columns. Never cut: the number alone, or
  /// nothing, where the words do not fit.
  [[nodiscard]] std::string words_at(int step, double fraction, int width) const;

 private:
  [[nodiscard]] const load& before(int step) const;
  [[nodiscard]] const load& after(int step) const {
    return problem_.steps[static_cast<std::size_t>(step - 1)];
  }
  [[nodiscard]] resultant resultant_at(int step, double fraction) const;
  /// A load in words, with its one number apart.
  struct words {
    std::string before;
    double value;
    std::string after;
  };
  [[nodiscard]] words words_for(const load& l, const resultant& r) const;
  [[nodiscard]] bool has_many_parts(int step) const;
  [[nodiscard]] bool of_matrix() const { return std::holds_alternative<assembled>(problem_.geometry.kind); }

  const problem& problem_;
  std::vector<resultant> totals_;   // at the start, then at the end of each step
  std::vector<std::size_t> parts_;  // how many things there are to write, likewise
};

}  // namespace contct
