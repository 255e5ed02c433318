#include "app/limits.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>
#include <string_view>
#include <system_error>

#include "contct/text/output_file.hpp"

namespace contct::app {
namespace {

/// A message that is made before it is needed: where memory ends, or in a handler of signals, none can be
/// made.
struct ready_message {
  std::array<char, 128> text{};
  std::size_t size = 0;

  void set(std::string_view words) {
    size = std::min(words.size(), text.size());
    std::memcpy(text.data(), words.data(), size);
  }
};

ready_message out_of_time;
ready_message out_of_memory;
exit_status status_out_of_memory = exit_status::bad_input;

/// Neither destructors nor buffers: what is unfinished is left as it is.
[[noreturn]] void end(const ready_message& m, exit_status status) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, m.text.data(), m.size);
  _exit(static_cast<int>(status));
}

/// Comes again until it ends the process: a file with a temporary name gets its own first.
void end_for_time(int /*signal*/) {
  if (temporary_names == 0) end(out_of_time, exit_status::iteration_limit);
}

[[noreturn]] void refused_by_system(const char* option) {
  throw std::system_error(errno, std::generic_category(), option);
}

void start_clock(double seconds) {
  struct sigaction action {};
  action.sa_handler = end_for_time;
  action.sa_flags = SA_RESTART;
  sigset_t clock;
  sigemptyset(&clock);
  sigaddset(&clock, SIGALRM);
  constexpr suseconds_t often = 10'000;
  const double whole = std::floor(seconds);
  const itimerval timer{{0, often},
                        {static_cast<time_t>(whole), static_cast<suseconds_t>((seconds - whole) * 1e6)}};
  if (sigaction(SIGALRM, &action, nullptr) != 0 || pthread_sigmask(SIG_UNBLOCK, &clock, nullptr) != 0 ||
      setitimer(ITIMER_REAL, &timer, nullptr) != 0)
    refused_by_system("--max-seconds");
}

/// That can be written; 0 where the system does not tell.
rlim_t bytes_of_data() {
  std::ifstream told("/proc/self/statm");
  rlim_t pages = 0;
  constexpr int place = 6;
  for (int i = 0; i < place; ++i) told >> pages;
  return told ? pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) : 0;
}

/// Memory that is written, not what is only mapped, as files are; nor what libraries have taken by now.
void limit_memory(std::int64_t mib) {
  rlimit now{};
  if (getrlimit(RLIMIT_DATA, &now) != 0) refused_by_system("--max-memory");
  now.rlim_cur = std::min(now.rlim_max, bytes_of_data() + (static_cast<rlim_t>(mib) << 20U));
  if (setrlimit(RLIMIT_DATA, &now) != 0) refused_by_system("--max-memory");
}

}  // namespace

void end_for_memory() {
  end(out_of_memory, status_out_of_memory);
}

void end_where_memory_ends() {
  out_of_memory.set("contct: memory does not suffice; the command is stopped\n");
  std::set_new_handler(end_for_memory);
}

void start_limits(const problem_limits& limits) {
  if (limits.max_memory > 0) {
    out_of_memory.set(fmt::format("contct: --max-memory {}: more memory is needed; the command is stopped\n",
                                  limits.max_memory));
    status_out_of_memory = exit_status::iteration_limit;
    limit_memory(limits.max_memory);
  }
  if (limits.max_seconds > 0) {
    out_of_time.set(fmt::format("contct: --max-seconds {}: the time is over; the command is stopped\n",
                                limits.max_seconds));
    start_clock(limits.max_seconds);
  }
}

}  // namespace contct::app
