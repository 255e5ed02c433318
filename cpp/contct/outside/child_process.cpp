#include "contct/outside/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <thread>
#include <utility>

namespace contct::outside {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// Close the parent's files but for the channel, drop its unprinted text, and reset its signal handlers: a
/// crash of the child must end it. No core dumps.
void detach_from_parent(int channel) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  __fpurge(stdout);
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  for (const int signal :
       {SIGINT, SIGTERM, SIGPIPE, SIGHUP, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS})
    (void)std::signal(signal, SIG_DFL);
  const auto kept = static_cast<unsigned>(channel);
  if (kept > 3) close_range(3, kept - 1, 0);
  close_range(kept + 1, ~0U, 0);
}

/// Wait until the channel is ready for `events`. False when the deadline comes first.
bool ready(int channel, short events, child_process::clock::time_point deadline) {
  while (true) {
    using namespace std::chrono;
    const std::int64_t left = ceil<milliseconds>(deadline - child_process::clock::now()).count();
    pollfd p{channel, events, 0};
    const int found = poll(&p, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000'000)));
    if (found > 0) return true;
    if (found == 0 || errno != EINTR) return false;
  }
}

}  // namespace

child_process::child_process(const std::function<void(int channel)>& body) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail("no channel to an external kernel");
  pid_ = fork();
  if (pid_ < 0) {
    close(ends[0]);
    close(ends[1]);
    fail("no process for an external kernel");
  }
  if (pid_ == 0) {
    detach_from_parent(ends[1]);
    body(ends[1]);
    _exit(0);
  }
  close(ends[1]);
  channel_ = ends[0];
}

child_process::~child_process() {
  (void)end();
}

child_process::sent child_process::send(std::string_view message, clock::time_point deadline) const {
  while (!message.empty()) {
    if (!ready(channel_, POLLOUT, deadline)) return sent::late;
    const ssize_t n = ::send(channel_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (n <= 0) return sent::gone;
    message.remove_prefix(n);
  }
  return sent::whole;
}

child_process::sent child_process::receive(std::string& message, clock::time_point deadline) const {
  char block[1 << 14];
  while (true) {
    if (!ready(channel_, POLLIN, deadline)) return sent::late;
    const ssize_t n = recv(channel_, block, sizeof block, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return sent::gone;
    message.append(block, n);
    return sent::whole;
  }
}

std::string child_process::end() {
  if (pid_ < 0) return was_stopped;
  if (channel_ >= 0) close(channel_);
  channel_ = -1;
  // A child that is ending has a moment to do so: its status says how.
  int status = 0;
  pid_t waited = 0;
  for (int i = 0; i < 50 && (waited = waitpid(pid_, &status, WNOHANG)) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(i < 10 ? 1 : 4));
  const pid_t child = std::exchange(pid_, -1);
  if (waited == 0) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    return was_stopped;
  }
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return "was ended by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  }
  return "ended with status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace contct::outside
