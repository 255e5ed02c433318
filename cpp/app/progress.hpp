// How far a long piece of work has come, for whoever waits at a terminal.
#pragma once

#include <chrono>
#include <string>

namespace contct {

/// One line on standard error, written over and over and gone in the end; nothing at all where
/// standard error is not a terminal.
class progress {
 public:
  /// `what` is counted: "problems".
  progress(long all, std::string what);
  ~progress();
  progress(const progress&) = delete;
  progress& operator=(const progress&) = delete;

  void one_more() { reached(done_ + 1); }
  void reached(long done);

 private:
  using clock = std::chrono::steady_clock;
  bool shown_;
  long done_ = 0, all_;
  std::string what_;
  clock::time_point last_ = clock::now();
};

}  // namespace contct
