#include "contct/kernel/child_kernel.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio_ext.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "contct/kernel/fortran.hpp"
#include "contct/kernel/trace.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

using clock = std::chrono::steady_clock;

#ifdef CONTCT_STATIC
constexpr bool is_static = true;
#else
constexpr bool is_static = false;
#endif

constexpr std::string_view ready_word = "ready";

/// The first word of an answer whose first line describes a forbidden action of the kernel.
constexpr std::string_view fault_word = "fault ";

[[noreturn]] void fail_to_start(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// In the child: closes the parent's files except the channel, discards the parent's unprinted text, disables
/// core dumps, and resets signal handlers, so that a crash ends the child.
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

/// Waits until the channel is ready for `events`. Returns false if the deadline comes first.
bool ready(int channel, short events, clock::time_point deadline) {
  while (true) {
    using namespace std::chrono;
    const std::int64_t left = ceil<milliseconds>(deadline - clock::now()).count();
    pollfd p{channel, events, 0};
    const int found = poll(&p, 1, static_cast<int>(std::clamp<std::int64_t>(left, 0, 1'000'000'000)));
    if (found > 0) return true;
    if (found == 0 || errno != EINTR) return false;
  }
}

/// The result of sending or receiving a message: complete, deadline missed, or channel closed.
enum class sent { whole, late, gone };

/// A child process and a channel to the child. The child ends with this object or with the parent process.
class child_process {
 public:
  /// Forks. The child runs `body` with its end of the channel, and ends when `body` returns. No other file of
  /// the parent is open in the child. The printed output of the child goes to standard error.
  explicit child_process(const std::function<void(int channel)>& body) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      fail_to_start("cannot open a channel to an external kernel");
    pid_ = fork();
    if (pid_ < 0) {
      close(ends[0]);
      close(ends[1]);
      fail_to_start("cannot start a process for an external kernel");
    }
    if (pid_ == 0) {
      detach_from_parent(ends[1]);
      body(ends[1]);
      _exit(0);
    }
    close(ends[1]);
    channel_ = ends[0];
  }

  ~child_process() { (void)end(); }
  child_process(const child_process&) = delete;
  child_process& operator=(const child_process&) = delete;

  [[nodiscard]] sent send(std::string_view message, clock::time_point deadline) const {
    while (!message.empty()) {
      if (!ready(channel_, POLLOUT, deadline)) return sent::late;
      const ssize_t n = ::send(channel_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (n < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (n <= 0) return sent::gone;
      message.remove_prefix(n);
    }
    return sent::whole;
  }

  /// Appends the next bytes, at least one, to `message`.
  [[nodiscard]] sent receive(std::string& message, clock::time_point deadline) const {
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

  /// Ends the child. Returns "was ended by signal 11 (Segmentation fault)", "ended with status 2" or, if the
  /// child did not end by itself, `was_stopped`.
  std::string end() {
    if (pid_ < 0) return was_stopped;
    if (channel_ >= 0) close(channel_);
    channel_ = -1;
    // Waits briefly for a child that is about to end, to get the child's status.
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

  static constexpr const char* was_stopped = "was stopped";

 private:
  pid_t pid_ = -1;
  int channel_ = -1;
};

/// True if the last line of an answer to a call of `pairs` pairs is "end", or another line in its place.
bool is_whole_answer(std::string_view text, std::size_t pairs) {
  if (!text.ends_with('\n')) return false;
  const std::string_view last = text.substr(text.substr(0, text.size() - 1).rfind('\n') + 1);
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  return last == "end\n" || last == "end\r\n" || (lines > pairs + 1 && last.front() != '|');
}

/// True if a CR in an answer is followed by another character than LF. The last CR may be followed later.
bool has_bare_cr(std::string_view text) {
  const std::size_t cr = std::min(text.find('\r'), text.size());
  return cr + 1 < text.size() && text[cr + 1] != '\n';
}

/// A kernel in a child process. Calls and answers are trace text.
class kernel_in_child final : public kernel {
 public:
  /// The child runs `body`. If `loads` is true, `body` first loads a library and sends `ready_word` or an
  /// error message; the constructor then throws the error message as std::invalid_argument.
  kernel_in_child(kernel_facts facts, std::function<void(int channel)> body, bool loads,
                  const outside_limits& limits)
      : kernel(std::move(facts)), body_(std::move(body)), loads_(loads), limits_(limits) {
    if (!loads_) return;
    if (const std::string wrong = start(); !wrong.empty())
      throw std::invalid_argument(this->facts().name + ": " + wrong);
  }

  void answer(call<double>& c) override {
    refuse_when_enough();
    if (child_) refuse_stray_answer();
    if (!child_) {
      if (const std::string wrong = start(); !wrong.empty()) fail(wrong, wrong == too_slow);
    }
    const auto until = deadline();
    asked_.clear();
    append_inputs({c, c.isep, {}, ++calls_}, "", asked_);
    // Longer than any valid answer. A kernel that writes without end must not use all memory.
    const std::size_t most_answer = (std::size_t{1} << 20) + 1024 * c.ss.size();
    answered_.clear();
    sent how = child_->send(asked_, until);
    while (how == sent::whole && !is_whole_answer(answered_, c.ss.size()) &&
           answered_.size() <= most_answer) {
      how = child_->receive(answered_, until);
      if (has_bare_cr(answered_)) fail("ends lines with CR alone; allowed: LF, or CR LF");
    }
    if (how != sent::whole) fail_without_answer(how);
    std::erase(answered_, '\r');
    if (answered_.size() > most_answer) fail("answered more than " + std::to_string(most_answer) + " bytes");
    read_answer(c);
  }

 private:
  static constexpr const char* too_slow = "did not load within the time limit";

  [[nodiscard]] clock::time_point deadline() const { return clock::now() + limits_.patience; }

  /// Starts the child. Returns the error message of loading, or an empty text.
  std::string start() {
    child_.emplace(body_);
    if (!loads_) return "";
    std::string word;
    const sent how = child_->receive(word, deadline());
    if (how == sent::whole && word == ready_word) return "";
    const std::string words = child_->end();
    child_.reset();
    if (how == sent::whole) return word;
    return how == sent::late ? too_slow : words + " while it was loaded";
  }

  /// Throws kernel_failure if the kernel has failed too often to be called again.
  void refuse_when_enough() const {
    if (failures_ < limits_.most_failures && waits_ < limits_.most_waits) return;
    throw kernel_failure("is not called again after " + std::to_string(failures_ + waits_) +
                         " failures; the last: it " + last_);
  }

  /// Ends the child and throws kernel_failure. `waited`: the failure is a timeout.
  [[noreturn]] void fail(const std::string& words, bool waited = false) {
    child_.reset();
    ++(waited ? waits_ : failures_);
    last_ = words;
    throw kernel_failure("it " + words);
  }

  /// Ends the child and throws kernel_failure with the reason why a message was not sent or received
  /// completely.
  [[noreturn]] void fail_without_answer(sent how) {
    const std::string words = child_->end();
    if (how == sent::late)
      fail("did not answer within " + std::to_string(limits_.patience.count()) + " ms: found " +
               (answered_.empty() ? "nothing" : in_quotes(answered_)) +
               "; allowed: an answer that ends with the line \"end\", and a flush after it",
           true);
    if (words == child_process::was_stopped)
      fail("closed its end of the pipe", true);  // counts as a timeout: the child was still running
    fail(words);
  }

  /// Throws kernel_failure if the child wrote before a call. The text would be read as the answer to the
  /// call.
  void refuse_stray_answer() {
    answered_.clear();
    if (child_->receive(answered_, clock::now()) == sent::whole) fail("answered without being called");
  }

  void read_answer(call<double>& c) {
    // fail ends the child, because the fault may have other effects in the child's memory.
    if (answered_.starts_with(fault_word))
      fail(answered_.substr(fault_word.size(), answered_.find('\n') - fault_word.size()));
    out_.ss.resize(c.ss.size());
    out_.isep.resize(c.ss.size());
    try {
      trace_reader reader(answered_, "its answer");
      reader.read_answer(out_);
      if (reader.line() != std::count(answered_.begin(), answered_.end(), '\n'))
        throw input_error("its answer continues after \"end\"");
    } catch (const input_error& e) {
      fail(std::string("gave an invalid answer: ") + e.what());
    }
    c.smin = out_.smin;
    std::copy(out_.ss.begin(), out_.ss.end(), c.ss.begin());
    std::copy(out_.isep.begin(), out_.isep.end(), c.isep.begin());
    text_ += out_.text;
  }

  std::function<void(int channel)> body_;
  bool loads_;
  outside_limits limits_;
  std::optional<child_process> child_;
  int failures_ = 0;
  int waits_ = 0;
  std::string last_;
  std::int64_t calls_ = 0;
  std::string asked_, answered_;
  call_outputs out_;
};

/// Replaces the child by the command, with the channel as standard input and output. Without a shell, as in
/// an empty container, executes the command's first word directly, with the other words as arguments.
void become(const std::string& command, int channel) {
  dup2(channel, STDIN_FILENO);
  dup2(channel, STDOUT_FILENO);
  close(channel);
  execl("/bin/sh", "sh", "-c", command.c_str(), static_cast<char*>(nullptr));
  std::istringstream words(command);
  std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  if (!arguments.empty()) execv(pointers[0], pointers.data());
  _exit(127);
}

using abi_function = decltype(&contct_kernel_abi);

/// Makes the call `asked`, which is trace text, and returns the answer as trace text.
std::string answer_to(std::string_view asked, kernel_procedure* ask) {
  recorded_call recorded;
  trace_reader(asked, "the call").next_inputs(recorded);
  call<double> c = recorded.out.prepare(recorded.in);
  put_guarded(c, ask);
  std::string text;
  append_answer(c.smin, c.ss, c.isep, "", text);
  return text;
}

void say(int channel, std::string_view words) {
  (void)dprintf(channel, "%.*s", static_cast<int>(words.size()), words.data());
}

/// In a plug-in's child: waits for calls, executes them and sends the answers, until the channel is closed.
void answer_calls(kernel_procedure* ask, int channel) {
  char block[1 << 14];
  std::string asked;
  for (ssize_t n = 0; (n = ::read(channel, block, sizeof block)) > 0;) {
    asked.append(block, n);
    if (!asked.ends_with("\nask\n")) continue;
    try {
      say(channel, answer_to(asked, ask));
    } catch (const std::exception& e) {
      say(channel, std::string(fault_word) + e.what() + "\nend\n");
    }
    asked.clear();
  }
}

/// In a plug-in's child: loads the library, sends `ready_word` or an error message, and answers calls.
void host_plugin(const std::string& path, int channel) {
  if (is_static)
    return say(channel,
               "a static program cannot load a shared library; allowed: pipe:COMMAND, with a command "
               "built from the kernel's source and reference/adopt/pipe_main.c");
  fortran::forget_unit_26();  // the plug-in may be FORTRAN and write to its own unit 26
  // "./" is added because dlopen searches a name without a slash only among the system's libraries.
  void* const library =
      dlopen((path.find('/') == std::string::npos ? "./" + path : path).c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return say(channel, std::string("cannot be loaded: ") + dlerror());
  // NOLINTBEGIN(cppcoreguidelines-pro-type-reinterpret-cast): dlsym gives no other type
  const auto version = reinterpret_cast<abi_function>(dlsym(library, "contct_kernel_abi"));
  const auto ask = reinterpret_cast<kernel_procedure*>(dlsym(library, "contct_kernel"));
  // NOLINTEND(cppcoreguidelines-pro-type-reinterpret-cast)
  if (version == nullptr || ask == nullptr)
    return say(channel, std::string("found no symbol ") +
                            (version == nullptr ? "contct_kernel_abi" : "contct_kernel") +
                            "; allowed: a library that exports contct_kernel_abi and contct_kernel, "
                            "as cpp/contct/kernel/plugin.h declares them");
  if (const int found = version(); found != CONTCT_KERNEL_ABI)
    return say(channel,
               "found ABI " + std::to_string(found) + "; allowed: " + std::to_string(CONTCT_KERNEL_ABI));
  say(channel, ready_word);
  answer_calls(ask, channel);
}

}  // namespace

std::unique_ptr<kernel> make_pipe(const std::string& command, const outside_limits& limits) {
  return std::make_unique<kernel_in_child>(
      facts_of_outside("pipe:" + command, "a command"), [command](int channel) { become(command, channel); },
      false, limits);
}

std::unique_ptr<kernel> make_plugin(const std::string& path, const outside_limits& limits) {
  return std::make_unique<kernel_in_child>(
      facts_of_outside("plugin:" + path, "a shared library"),
      [path](int channel) { host_plugin(path, channel); }, true, limits);
}

}  // namespace contct
