// When to check a response that updates have changed, and what to make of the drift that a check finds.
#pragma once

#include <algorithm>
#include <cmath>

#include "contct/rooms.hpp"

namespace contct::solve {

/// What a check finds at the pairs: the largest response, and the largest correction to one.
struct drift {
  double size = 0.0;
  double correction = 0.0;

  void include(double response, double corrected_by) {
    size = std::max(size, std::abs(response));
    correction = std::max(correction, std::abs(corrected_by));
  }
  [[nodiscard]] double relative() const { return size > 0.0 ? correction / size : 0.0; }
};

/// Checks every so many responses. The interval halves when the drift is more than allowed, and doubles when
/// it is negligible.
class drift_monitor {
 public:
  struct limits {
    int first_check;    ///< responses until the first check, and between the next
    int longest;        ///< the most responses between two checks
    double allowed;     ///< correction relative to the response
    double negligible;  ///< the same; less than `allowed`
  };

  explicit drift_monitor(const limits& l)
      : limits_(l), until_check_(l.first_check), check_every_(l.first_check) {}

  /// Count a response. True when it is to be checked.
  [[nodiscard]] bool is_due() { return --until_check_ <= 0; }
  void check_next() { until_check_ = 1; }
  void start_interval() { until_check_ = check_every_; }

  /// False when the drift is more than is allowed, or than `rounding`, where that is more.
  [[nodiscard]] bool accepts(const drift& found, double rounding = 0.0) {
    const bool good = found.correction <= std::max(limits_.allowed, rounding) * found.size;
    if (!good) check_every_ = std::max(check_every_ / 2, shortest);
    if (found.correction < limits_.negligible * found.size)
      check_every_ = std::min(2 * check_every_, limits_.longest);
    start_interval();
    return good;
  }

 private:
  static constexpr int shortest = 4;
  limits limits_;
  int until_check_;
  int check_every_;
};

}  // namespace contct::solve
