// How a run ended, in words for people.
#pragma once

#include <string>

#include "app/commands.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"

namespace contct::app {

/// Why a path did not reach its end: step, share of its load, and the pairs that had to do with
/// it. Empty for a path that did.
[[nodiscard]] std::string end_words(const problem& p, const path_end& end);

/// What the program ends with after such a path, where the kernels agree.
[[nodiscard]] exit_status status_of(path_status status);

/// Observes a path and remembers the step whose answer kept the fewest digits.
class digit_watch final : public observer {
 public:
  void step_ended(const step_state& s) override;

  /// A warning where too few digits are left to rely on; empty otherwise.
  [[nodiscard]] std::string warning() const;

 private:
  int fewest_ = 16;
  int step_ = 0;
  double rcond_ = 1.0;
};

}  // namespace contct::app
