#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace contct {

progress::progress(long all, std::string what)
    : shown_(isatty(STDERR_FILENO) != 0), all_(all), what_(std::move(what)) {}

progress::~progress() {
  if (shown_) (void)std::fputs("\r\033[K", stderr);
}

void progress::reached(long done) {
  done_ = done;
  if (!shown_) return;
  const auto now = clock::now();
  if (now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  const std::string line = fmt::format("\r{:3} % of {} {}", 100 * done_ / std::max(all_, 1L), all_, what_);
  (void)std::fputs(line.c_str(), stderr);
}

}  // namespace contct
