// A scope in which no signal ends the process.
#pragma once

#include <csignal>

#include "contct/rooms.hpp"

namespace contct::text {

/// Blocks every signal to this thread but SIGKILL while this object lives, so that a file with a temporary
/// name is not left behind.
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

}  // namespace contct::text
