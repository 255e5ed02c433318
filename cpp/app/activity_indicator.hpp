// What is being waited for, where a long piece of work cannot say how far it has come.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace contct {

/// While it lives, a terminal is told what for and since when: "reading model.toml, 3 s". As quiet as
/// `progress` otherwise. Nothing else may be printed meanwhile, and no process begun: a thread of its own
/// does it.
class activity_indicator {
 public:
  /// Throws std::invalid_argument when CONTCT_PROGRESS_AFTER is no time.
  explicit activity_indicator(std::string what, bool quiet = false);
  ~activity_indicator();
  activity_indicator(const activity_indicator&) = delete;
  activity_indicator& operator=(const activity_indicator&) = delete;
  activity_indicator(activity_indicator&&) = delete;
  activity_indicator& operator=(activity_indicator&&) = delete;

 private:
  void tell(double after);
  void draw(double seconds);

  std::string what_;
  std::mutex guard_;
  std::condition_variable ended_;
  bool over_ = false, shown_ = false;
  std::thread teller_;
};

}  // namespace contct
