// What a run was, increment by increment and call by call, as far as its page shows it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contct/compare/lockstep.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// One increment of the path.
struct increment_record {
  int step, number;
  double s, fraction;
  bool snaps;
  std::vector<event> events;
};

/// One call of the leader, and how the followers answered it.
struct call_record {
  int step = 0, number = 0;  ///< of the increment it led to; 0 and 0 when it led to none
  double smin = 0.0;
  std::vector<double> ss;                  ///< of the first pairs
  std::vector<follower_answer> followers;  ///< none when nothing was compared
};

/// Observes a path and keeps what a page can show: the first increments and calls, and the beginning
/// of the unit-26 text. What is beyond is counted.
class run_record final : public observer {
 public:
  static constexpr std::size_t most_increments = 1200;
  static constexpr std::size_t most_calls = 1200;
  static constexpr std::size_t most_ss = 8;
  static constexpr std::size_t most_log = 200'000;  ///< bytes

  /// `compared` is null for a kernel alone; it must outlive this object, and observe before it.
  explicit run_record(const lockstep* compared) : compared_(compared) {}

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  std::vector<increment_record> increments;
  std::vector<call_record> calls;
  std::string log;
  std::size_t all_increments = 0, all_calls = 0, all_log = 0;  ///< kept or not

 private:
  const lockstep* compared_;
  bool answers_ = false;  // the last call kept has not led to an increment yet
};

}  // namespace contct
