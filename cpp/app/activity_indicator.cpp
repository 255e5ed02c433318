#include "app/activity_indicator.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <utility>

#include "app/progress.hpp"

namespace contct {

activity_indicator::activity_indicator(std::string what, bool quiet) : what_(std::move(what)) {
  const double after = wait_before_progress();
  if (!waits_at_terminal(quiet)) return;
  if (after <= 0.0) draw(0.0);
  teller_ = std::thread([this, after] { tell(after); });
}

activity_indicator::~activity_indicator() {
  if (!teller_.joinable()) return;
  {
    const std::scoped_lock lock(guard_);
    over_ = true;
  }
  ended_.notify_all();
  teller_.join();
}

void activity_indicator::tell(double after) {
  using seconds = std::chrono::duration<double>;
  const auto begun = std::chrono::steady_clock::now();
  std::unique_lock lock(guard_);
  for (seconds next(after > 0.0 ? after : 1.0); !ended_.wait_for(lock, next, [this] { return over_; });
       next = seconds(1.0)) {
    const seconds since = std::chrono::steady_clock::now() - begun;
    draw(since.count());
  }
  if (shown_) (void)std::fputs("\r\033[K", stderr);
}

void activity_indicator::draw(double seconds) {
  shown_ = true;
  const std::string line = fmt::format("\r{}, {:.0f} s\033[K", what_, seconds);
  (void)std::fputs(line.c_str(), stderr);
}

}  // namespace contct
