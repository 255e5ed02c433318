// Progress along a path: two observers, one before and one behind whoever prints.
#pragma once

#include <fmt/format.h>

#include "app/progress.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// Shows step and increment under way. `before` takes the line away when something may be printed; `behind`
/// puts it back.
class path_progress {
 public:
  path_progress(std::size_t steps, bool quiet)
      : shown_(static_cast<long>(steps), "steps", quiet), before_(shown_), behind_(shown_, steps) {}

  [[nodiscard]] observer* before() { return &before_; }
  [[nodiscard]] observer* behind() { return &behind_; }
  void erase() { shown_.erase(); }

 private:
  class eraser final : public observer {
   public:
    explicit eraser(progress& shown) : shown_(shown) {}
    void incremented(const increment& /*i*/) override { shown_.erase(); }
    void step_ended(const step_state& /*s*/) override { shown_.erase(); }

   private:
    progress& shown_;
  };

  class teller final : public observer {
   public:
    teller(progress& shown, std::size_t steps) : shown_(shown), steps_(steps) {}
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

  progress shown_;
  eraser before_;
  teller behind_;
};

}  // namespace contct
