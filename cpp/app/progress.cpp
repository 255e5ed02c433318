#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace contct {

progress::progress(long all, std::string what, bool quiet)
    : wanted_(!quiet && isatty(STDERR_FILENO) != 0), all_(all), what_(std::move(what)) {}

progress::~progress() {
  erase();
}

bool progress::is_due() const {
  const auto now = clock::now();
  return wanted_ && now - begun_ >= std::chrono::seconds(1) && now - last_ >= std::chrono::milliseconds(200);
}

void progress::draw(std::string_view words) {
  last_ = clock::now();
  shown_ = true;
  const std::string line = fmt::format("\r{}\033[K", words);
  (void)std::fputs(line.c_str(), stderr);
}

void progress::reached(long done) {
  done_ = done;
  if (is_due()) draw(fmt::format("{:3} % of {} {}", 100 * done_ / std::max(all_, 1L), all_, what_));
}

void progress::say(std::string_view words) {
  if (is_due()) draw(words);
}

void progress::erase() {
  if (std::exchange(shown_, false)) (void)std::fputs("\r\033[K", stderr);
}

}  // namespace contct
