// The exact path of the 1989 rule beside a kernel's own, call by call.
#pragma once

#include <optional>
#include <string>

#include "contct/exact/path_1989.hpp"
#include "contct/path/observer.hpp"

namespace contct::exact {

/// A place on a path: a step and an increment in it, from 1.
struct path_place {
  int step, increment;
};

/// Observes the path of a kernel with the listing's rule and asks the exact path one call for each of its
/// calls. Both are comparable as long as they had the same events: then the call of the same number is the
/// same one but for rounding.
class exact_companion final : public path::observer {
 public:
  /// `p` must outlive this object. Nothing is computed behind `last`, where that is given; an increment 0 in
  /// it means all of the step.
  explicit exact_companion(const exact_problem& p, std::optional<path_place> last = {})
      : path_(p), last_(last) {}

  void incremented(const path::increment& i) override;

  /// The exact call with the number of the kernel's last one. Null after the paths have parted, and where
  /// the exact one cannot be followed.
  [[nodiscard]] const exact_call* call() const { return has_call_ ? &path_.call() : nullptr; }
  /// The first increment of which the events differ.
  [[nodiscard]] const std::optional<path_place>& parted() const { return parted_; }
  /// Why the exact path was not followed up to here, or ended before; empty where neither is so.
  [[nodiscard]] const std::string& stopped() const { return stopped_; }

 private:
  [[nodiscard]] bool is_behind_last(const path::increment& i) const;

  path_1989 path_;
  std::optional<path_place> last_, parted_;
  std::string stopped_;
  bool has_call_ = false;
};

}  // namespace contct::exact
