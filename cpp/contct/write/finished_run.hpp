// All that pictures and the page of a run are made from: what is recorded while it goes on, and how it ended.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "contct/certify/certificate.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/path/frames.hpp"
#include "contct/path/observer.hpp"
#include "contct/structure/problem.hpp"

namespace contct::write {

/// One increment of the path.
struct increment_record {
  explicit increment_record(const increment& i)
      : step(i.step),
        number(i.number),
        s(i.s),
        fraction(i.fraction),
        snaps(i.snaps),
        events(i.events.begin(), i.events.end()) {}

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

struct finished_run {
  const problem& what;
  const frame_keeper& kept;
  const run_record& record;
  const certifier& judged;
  const early_toggles& early;
  std::string file;                  ///< the problem's, as it was named
  std::vector<std::string> kernels;  ///< the leader first
  std::string engine;
  std::string status;              ///< as results have it: "solved", ...
  std::string end;                 ///< why the path did not reach its end, in words; empty when it did
  bool in_lockstep = false;        ///< every call was put to the other kernels
  bool equal = true;               ///< and they agreed (in lockstep or on paths of their own)
  std::string comparison;          ///< how they did, in words; empty for a kernel alone
  std::vector<std::string> facts;  ///< version, listing, floating point
};

/// A title for people: the problem's, or its file's name.
[[nodiscard]] std::string title_of(const finished_run& r);

/// `text` with its line ends replaced by blanks.
[[nodiscard]] std::string on_one_line(std::string text);

}  // namespace contct::write
