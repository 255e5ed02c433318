// The record of a path: its increments, the ends of its steps, and its calls.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "contct/harness/lockstep.hpp"
#include "contct/path/observer.hpp"
#include "contct/proof/solved_path.hpp"

namespace contct {

/// One call of the leader, and the answers of the followers.
struct call_record {
  int step = 0, number = 0;  ///< step and increment after the call; 0 and 0: no increment followed
  double smin = 0.0;
  std::vector<double> ss;                  ///< only of the first most_ss pairs
  std::vector<follower_answer> followers;  ///< empty if no kernels are compared
};

/// The parts of a path that are recorded in addition to increments and ends of steps.
struct recorded_parts {
  bool calls = false;   ///< the first calls and the first bytes of unit 26; the others are only counted
  bool states = false;  ///< D, ISEP and pair forces after each increment
};

class run_recorder final : public observer {
 public:
  /// The most calls, pairs of a call, and bytes of unit 26 that are kept.
  static constexpr std::size_t most_calls = 1200, most_ss = 8, most_log = 200'000;

  /// `compared`, null for a single kernel, must outlive this object and observe each call before this object.
  explicit run_recorder(const lockstep* compared = nullptr, recorded_parts parts = {})
      : compared_(compared), parts_(parts) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void take(std::vector<solved_step> ends);

  [[nodiscard]] bool keeps_states() const { return parts_.states; }

  std::vector<solved_step> steps;
  std::vector<call_record> calls;
  std::string log;
  std::size_t all_calls = 0, all_log = 0;  ///< all calls, and all bytes of unit 26, also those not kept

 private:
  void keep_call(const answered_call& c);

  const lockstep* compared_;
  recorded_parts parts_;
  bool answers_ = false;                      // the last call is kept, and no increment followed yet
  std::optional<double> smin_;                // SMIN of the last call
  std::vector<increment_record> increments_;  // of all steps, until the ends of the steps are taken
};

/// A path that was followed, and how it ended.
struct recorded_path {
  run_recorder record;
  path_end end = {};

  /// Takes the ends of the steps of the observed path.
  void take(solved_path followed);
  [[nodiscard]] bool all_certified() const;
};

/// Follows the path with a kernel, and records it. `shown` observes the path, too; it may be null. Others:
/// see engine_for and follow.
[[nodiscard]] recorded_path path_of(const std::string& kernel, const problem& p, const linear_structure& s,
                                    const std::string& engine, observer* shown = nullptr,
                                    int max_increments = 0);

}  // namespace contct
