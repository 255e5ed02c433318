#include "app/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace contct::app {
namespace {

/// Seconds before anything is shown.
double seconds_from(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0.0))
    throw std::invalid_argument("CONTCT_PROGRESS_AFTER: found \"" + std::string(text) +
                                "\"; allowed: seconds, 0 or more");
  return value;
}

}  // namespace

double wait_before_progress() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables
  const char* const said = std::getenv("CONTCT_PROGRESS_AFTER");
  return said == nullptr ? 1.0 : seconds_from(said);
}

bool waits_at_terminal(bool quiet) {
  return !quiet && isatty(STDERR_FILENO) != 0;
}

progress::progress(long all, std::string what, bool quiet)
    : wanted_(waits_at_terminal(quiet)),
      after_(wait_before_progress()),
      between_(std::min(0.2, after_.count())),
      all_(all),
      what_(std::move(what)) {}

progress::~progress() {
  erase();
}

bool progress::is_due() const {
  const auto now = clock::now();
  return wanted_ && now - begun_ >= after_ && now - last_ >= between_;
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

}  // namespace contct::app
