// A moment in which no signal ends the process.
#pragma once

#include <csignal>

namespace contct {

/// Signals sent to this thread wait while this object lives: for the moment in which a file has a
/// passing name, which nobody would take away again. (SIGKILL does not wait.)
class signals_wait {
 public:
  signals_wait() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~signals_wait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  signals_wait(const signals_wait&) = delete;
  signals_wait& operator=(const signals_wait&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace contct
