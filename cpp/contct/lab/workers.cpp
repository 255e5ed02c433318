#include "contct/lab/workers.hpp"

#include <poll.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <list>
#include <map>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "contct/kernel/kernel.hpp"

namespace contct::lab {
namespace {

/// The exit status of a worker that gets no memory, as of the whole program; the parent says so.
constexpr int out_of_memory = 2;

enum class came_to : char { result, kernel_failed, failed };

/// Stands before every result in the channel.
struct answer_head {
  std::int64_t task = 0;
  std::size_t size = 0;
  came_to what = came_to::result;
};

struct task_result {
  came_to what = came_to::result;
  std::string bytes;  ///< or the words of what was thrown
};

/// False where the other end is gone.
bool send_all(int channel, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t n = send(channel, at, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool receive_task(int channel, std::int64_t& task) {
  ssize_t n = 0;
  while ((n = recv(channel, &task, sizeof task, MSG_WAITALL)) < 0 && errno == EINTR) {
  }
  return n == sizeof task;
}

task_result result_of(const task_work& work, std::int64_t task) {
  try {
    return {came_to::result, work(task)};
  } catch (const kernel_failure& e) {
    return {came_to::kernel_failed, e.what()};
  } catch (const std::bad_alloc&) {
    _exit(out_of_memory);
  } catch (const std::exception& e) {
    return {came_to::failed, e.what()};
  }
}

/// What a worker does: tasks as they come, until there are no more.
[[noreturn]] void serve(int channel, pid_t parent, const task_work& work) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // it was gone before
  std::set_new_handler([] { _exit(out_of_memory); });
  __fpurge(stdout);  // the parent prints that
  for (std::int64_t task = 0; receive_task(channel, task);) {
    const task_result r = result_of(work, task);
    const answer_head h{task, r.bytes.size(), r.what};
    if (!send_all(channel, &h, sizeof h) || !send_all(channel, r.bytes.data(), r.bytes.size())) break;
  }
  _exit(0);
}

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A forked process, ended with this object.
class worker {
 public:
  worker(const task_work& work, const std::list<worker>& others) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) fail("no channel to a worker process");
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) {
      for (const worker& other : others)
        if (other.channel_ >= 0) close(other.channel_);
      close(ends[0]);
      serve(ends[1], parent, work);
    }
    close(ends[1]);
    channel_ = ends[0];
    if (pid_ > 0) return;
    close(channel_);
    fail("no worker process");
  }
  ~worker() {
    close(channel_);
    if (pid_ < 0) return;
    kill(pid_, SIGKILL);
    (void)status();
  }
  worker(const worker&) = delete;
  worker& operator=(const worker&) = delete;

  [[nodiscard]] int channel() const { return channel_; }
  [[nodiscard]] bool has_task() const { return has_task_; }

  void give(std::int64_t task) {
    has_task_ = true;
    if (!send_all(channel_, &task, sizeof task)) tell_end();
  }

  /// Read what is there; true, with the result, where that is whole.
  bool read(std::int64_t& task, task_result& result) {
    char block[1 << 16];
    const ssize_t n = recv(channel_, block, sizeof block, 0);
    if (n < 0 && errno == EINTR) return false;
    if (n <= 0) tell_end();
    read_.append(block, static_cast<std::size_t>(n));
    answer_head h;
    if (read_.size() < sizeof h) return false;
    std::memcpy(&h, read_.data(), sizeof h);
    if (read_.size() < sizeof h + h.size) return false;
    task = h.task;
    result = {h.what, read_.substr(sizeof h)};
    read_.clear();
    has_task_ = false;
    return true;
  }

 private:
  int status() {
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    pid_ = -1;
    return status;
  }

  /// Says how a worker ended that should not have.
  [[noreturn]] void tell_end() {
    const int s = status();
    if (WIFEXITED(s) && WEXITSTATUS(s) == out_of_memory) throw std::bad_alloc();
    const std::string how = WIFSIGNALED(s) ? "was ended by signal " + std::to_string(WTERMSIG(s)) + " (" +
                                                 strsignal(WTERMSIG(s)) + ")"  // NOLINT: no other thread asks
                                           : "ended with status " + std::to_string(WEXITSTATUS(s));
    throw std::runtime_error("a worker process " + how +
                             " before its task was done; nothing is written; --jobs 1 has no such processes");
  }

  pid_t pid_ = -1;
  int channel_ = -1;
  bool has_task_ = false;
  std::string read_;
};

void take_result(const task_taker& take, std::int64_t number, const task_result& r) {
  if (r.what == came_to::kernel_failed) throw kernel_failure(r.bytes);
  if (r.what == came_to::failed) throw std::runtime_error(r.bytes);
  take(number, r.bytes);
}

/// Hands tasks out to whoever has none, and takes results in the order of tasks.
class crew {
 public:
  crew(int jobs, std::int64_t tasks, const task_work& work)
      : tasks_(tasks), most_ahead_(std::int64_t{16} * jobs) {
    for (int j = 0; j < jobs; ++j) workers_.emplace_back(work, workers_);
  }

  void run(const task_taker& take) {
    while (taken_ < tasks_) {
      for (worker& w : workers_)
        if (!w.has_task() && given_ < std::min(tasks_, taken_ + most_ahead_)) w.give(given_++);
      read_results();
      for (auto first = done_.begin(); first != done_.end() && first->first == taken_;
           first = done_.erase(first))
        take_result(take, taken_++, first->second);
    }
  }

 private:
  void read_results() {
    std::vector<pollfd> waiting;
    for (const worker& w : workers_) waiting.push_back({w.channel(), POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) fail("waiting for worker processes");
    auto polled = waiting.begin();
    for (worker& w : workers_) {
      std::int64_t task = 0;
      task_result result;
      if (polled++->revents != 0 && w.read(task, result)) done_.emplace(task, std::move(result));
    }
  }

  std::list<worker> workers_;
  std::int64_t tasks_;
  std::int64_t most_ahead_;  // results that may wait for an earlier one
  std::int64_t given_ = 0, taken_ = 0;
  std::map<std::int64_t, task_result> done_;
};

}  // namespace

void do_tasks(int jobs, std::int64_t tasks, const task_work& work, const task_taker& take) {
  if (jobs == 0) jobs = static_cast<int>(std::thread::hardware_concurrency());  // 0 where that is not known
  const int workers = static_cast<int>(std::min<std::int64_t>(jobs, tasks));
  if (workers > 1) return crew(workers, tasks, work).run(take);
  for (std::int64_t task = 0; task < tasks; ++task) take(task, work(task));
}

}  // namespace contct::lab
