#include "app/problem_progress.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

#include "app/streams.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"

namespace contct::app {
namespace {

/// While it lives, a terminal shows what the program is doing and for how long: "reading model.toml, 3 s".
/// Nothing else may be printed meanwhile, and no process forked: it uses a thread of its own.
class activity_indicator {
 public:
  explicit activity_indicator(std::string activity, bool quiet) : activity_(std::move(activity)) {
    const double after = wait_before_progress();
    if (!waits_at_terminal(quiet)) return;
    if (after <= 0.0) draw(0.0);
    drawer_ = std::thread([this, after] { draw_every_second(after); });
  }
  ~activity_indicator() {
    if (!drawer_.joinable()) return;
    {
      const std::scoped_lock lock(guard_);
      over_ = true;
    }
    ended_.notify_all();
    drawer_.join();
  }
  activity_indicator(const activity_indicator&) = delete;
  activity_indicator& operator=(const activity_indicator&) = delete;
  activity_indicator(activity_indicator&&) = delete;
  activity_indicator& operator=(activity_indicator&&) = delete;

 private:
  void draw_every_second(double after) {
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

  void draw(double seconds) {
    shown_ = true;
    const std::string line = fmt::format("\r{}, {:.0f} s\033[K", activity_, seconds);
    (void)std::fputs(line.c_str(), stderr);
  }

  std::string activity_;
  std::mutex guard_;
  std::condition_variable ended_;
  bool over_ = false, shown_ = false;
  std::thread drawer_;
};

class eraser final : public observer {
 public:
  explicit eraser(progress& shown) : shown_(shown) {}
  void incremented(const increment& /*i*/) override { shown_.erase(); }
  void step_ended(const step_state& /*s*/) override { shown_.erase(); }

 private:
  progress& shown_;
};

class increment_counter final : public observer {
 public:
  increment_counter(progress& shown, std::size_t steps) : shown_(shown), steps_(steps) {}
  void called(const answered_call& /*c*/) override {
    shown_.say(fmt::format("step {} of {}, increment {}", step_, steps_, ++increment_));
  }
  void incremented(const increment& i) override {
    shown_.say(fmt::format("step {} of {}, increment {}, {:.0f} % of the step's load", i.step, steps_,
                           i.number + 1, 100.0 * i.fraction));
  }
  void step_ended(const step_state& s) override {
    step_ = s.step + 1;
    increment_ = 0;
  }

 private:
  progress& shown_;
  std::size_t steps_;
  int step_ = 1;
  int increment_ = 0;
};

problem read_shown(const std::string& file, bool quiet) {
  const activity_indicator here(file == "-" ? "reading the problem" : "reading " + file, quiet);
  return read_problem(file);
}

}  // namespace

problem read_with_progress(const std::string& file, bool quiet) {
  problem p = read_shown(file, quiet);
  for (const std::string& w : p.warnings) complain("warning: {}", w);
  return p;
}

linear_structure build_with_progress(const problem& p, bool quiet) {
  const activity_indicator here("building the structure", quiet);
  return structure_of(p);
}

path_progress::path_progress(std::size_t steps, bool quiet)
    : shown_(static_cast<long>(steps), "steps", quiet),
      before_(std::make_unique<eraser>(shown_)),
      behind_(std::make_unique<increment_counter>(shown_, steps)) {}

}  // namespace contct::app
