// How far a long piece of work has come, for whoever waits at a terminal.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "contct/rooms.hpp"

namespace contct::app {

/// Seconds before anything is shown: what CONTCT_PROGRESS_AFTER in the environment says, or 1. Throws
/// std::invalid_argument when that is no time.
[[nodiscard]] double wait_before_progress();

/// Does anybody wait at a terminal?
[[nodiscard]] bool waits_at_terminal(bool quiet);

/// One line on standard error, written over and over and gone in the end. Nothing at all in the first second,
/// where standard error is not a terminal, or where it is to be quiet.
class progress {
 public:
  /// `what` is counted: "problems". Throws std::invalid_argument when CONTCT_PROGRESS_AFTER is no time.
  progress(long all, std::string what, bool quiet = false);
  ~progress();
  progress(const progress&) = delete;
  progress& operator=(const progress&) = delete;

  void one_more() { reached(done_ + 1); }
  void reached(long done);

  /// Say something else than a count.
  void say(std::string_view words);

  /// Take the line away, for something else to be printed; it comes back.
  void erase();

 private:
  using clock = std::chrono::steady_clock;
  using seconds = std::chrono::duration<double>;
  [[nodiscard]] bool is_due() const;
  void draw(std::string_view words);

  bool wanted_;
  seconds after_, between_;
  bool shown_ = false;
  long done_ = 0, all_;
  std::string what_;
  clock::time_point begun_ = clock::now(), last_ = begun_;
};

}  // namespace contct::app
