// How a path ended, and what to be warned of, in words.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

#include "contct/path/path.hpp"
#include "contct/structure/problem.hpp"
#include "contct/write/exit_status.hpp"
#include "contct/write/step_results.hpp"

namespace contct::write {

/// Why a path did not reach its end: step, share of its load, and the pairs that had to do with
/// it. Empty for a path that did.
[[nodiscard]] std::string end_words(const problem& p, const path_end& end);

/// What the program ends with after such a path, where the kernels agree.
[[nodiscard]] exit_status status_of(path_status status);

/// "8 calls, 64 values compared, 0 mismatches", of what compares the calls of a path.
template <class Comparing>
[[nodiscard]] std::string counts_of(const Comparing& c) {
  return fmt::format("{} calls, {} values compared, {} mismatches", c.calls(), c.compared().values,
                     c.compared().mismatches);
}

/// Observes a path of a beam and remembers where, at the end of a step, it passes deepest through a face
/// between pairs.
struct passage_watch final : observer {
  /// `p` must outlive this object.
  explicit passage_watch(const problem& p) : what(p), loads(p) {}
  void step_ended(const step_state& s) override;

  /// A warning that names the remedy; empty where there is no such place.
  [[nodiscard]] std::string warning() const;

  const problem& what;
  load_path loads;
  std::optional<passage> worst;
  int step = 0;
};

/// Observes a path and remembers the step whose answer kept the fewest digits.
struct digit_watch final : observer {
  void step_ended(const step_state& s) override;

  /// A warning where too few digits are left to rely on; empty otherwise.
  [[nodiscard]] std::string warning() const;

  int fewest = 16;
  int step = 0;
  double rcond = 1.0;
};

}  // namespace contct::write
