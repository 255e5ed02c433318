// Kernels from outside that crash, hang, lie or reach where they must not: the run goes on, and says what
// happened.
#include "contct/outside/outside.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "catch.hpp"
#include "contct/kernel/fortran.hpp"
#include "contct/outside/registry.hpp"
#include "support/one_pair.hpp"

using namespace contct;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

constexpr double behaves = 0, crashes = 1, aborts = 2, exits_0 = 3, exits_3 = 4, hangs = 5, talks = 6;

std::string plugin(const std::string& name) {
  return CONTCT_PLUGINS "/" + name + ".so";
}

outside_limits short_patience() {
  outside_limits limits;
  limits.patience = 500ms;
  return limits;
}

/// A call whose first face tells misbehaves.c what to do.
small_call<double> call_for(double fault) {
  return small_call<double>(
      {{0.5, 2.0, fault, separated, face_above}, {0.0, 1.0, 4.0, in_contact, face_below}});
}

/// What a kernel is reported to have done; empty when it answered, as it should, that nothing happens.
std::string put(kernel& k, double fault) {
  small_call<double> c = call_for(fault);
  call<double> arguments = c.arguments();
  try {
    k.answer(arguments);
  } catch (const kernel_failure& failure) {
    return failure.what();
  }
  const bool right = arguments.smin == 1 && c.ss == std::vector<double>{1, 1} &&
                     c.isep == std::vector<int>{separated, in_contact};
  return right ? "" : "another answer";
}

std::string why_refused(const std::string& path) {
  try {
    (void)make_plugin(path, short_patience());
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "nothing";
}

long open_descriptors() {
  long count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) ++count;
  return count;
}

/// Counts what a kernel leaves behind.
class leftovers {
 public:
  void check() const {
    CHECK(open_descriptors() == descriptors_);
    errno = 0;
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);  // no child, running or dead
    CHECK(errno == ECHILD);
  }

 private:
  long descriptors_ = open_descriptors();
};

/// A command that answers every call that nothing happens to its two pairs.
const std::string well_behaved =
    "while read -r line; do [ \"$line\" = ask ] && "
    "printf 'smin 0x1p+0\\npair 1 ss 0x1p+0 isep 1\\npair 2 ss 0x1p+0 isep -1\\nend\\n'; done";

std::string put_to_pipe(const std::string& command) {
  return put(*make_pipe(command, short_patience()), behaves);
}

/// The file descriptor `stream`, led to a file while this object lives.
class caught_stream {
 public:
  explicit caught_stream(int stream) : stream_(stream), kept_(dup(stream)), file_(std::tmpfile()) {
    (void)std::fflush(nullptr);
    dup2(fileno(file_), stream_);
  }
  ~caught_stream() {
    dup2(kept_, stream_);
    close(kept_);
    (void)std::fclose(file_);
  }
  caught_stream(const caught_stream&) = delete;
  caught_stream& operator=(const caught_stream&) = delete;

  [[nodiscard]] std::string text() const {
    char block[4096];
    const ssize_t n = pread(fileno(file_), block, sizeof block, 0);
    return {block, static_cast<std::size_t>(n < 0 ? 0 : n)};
  }

 private:
  int stream_;
  int kept_;
  std::FILE* file_;
};

}  // namespace

TEST_CASE("a plug-in that ends its process is reported, and the next call is asked of a fresh one") {
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    const std::vector<std::pair<double, std::string>> ends = {{crashes, "it was ended by signal 11"},
                                                              {aborts, "it was ended by signal 6"},
                                                              {exits_0, "it ended with status 0"},
                                                              {exits_3, "it ended with status 3"}};
    for (const auto& [fault, words] : ends) {
      CHECK(put(*k, behaves).empty());
      CHECK_THAT(put(*k, fault), Contains(words));
    }
    CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("a plug-in that hangs is given up after its time, three times, and then asked no more") {
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    for (int i = 0; i < 3; ++i) {
      CHECK(put(*k, behaves).empty());
      CHECK_THAT(put(*k, hangs), Contains("it did not answer within 500 ms"));
    }
    const auto before = std::chrono::steady_clock::now();
    CHECK_THAT(put(*k, behaves), Contains("asked no more after 3 failures; the last: it did not answer"));
    CHECK(std::chrono::steady_clock::now() - before < 100ms);
  }
  left.check();
}

TEST_CASE("a plug-in may fail a thousand times where failing costs no time") {
  const leftovers left;
  {
    outside_limits limits;  // forty stand for the thousand: under a sanitizer each takes a while
    CHECK(limits.most_failures == 1000);
    limits.most_failures = 40;
    const auto k = make_plugin(plugin("misbehaves"), limits);
    int failed = 0;
    for (int i = 0; i < 40; ++i) failed += put(*k, exits_3) == "it ended with status 3" ? 1 : 0;
    CHECK(failed == 40);
    CHECK_THAT(put(*k, behaves), Contains("asked no more after 40 failures"));
  }
  left.check();
}

TEST_CASE("a plug-in that writes around an array is told which, and where") {
  const std::vector<std::string> arrays = {"DD", "DTEST", "CC", "SS", "SMIN", "ID", "ISEP", "ISURF"};
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      CHECK(put(*k, 10 + static_cast<double>(i)) == "it wrote in front of " + arrays[i]);
      CHECK(put(*k, 20 + static_cast<double>(i)) == "it wrote behind the end of " + arrays[i]);
    }
    CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("a plug-in that changes an input is told which") {
  const auto k = make_plugin(plugin("misbehaves"), short_patience());
  CHECK(put(*k, 30) == "it changed its input DD");
  CHECK(put(*k, 31) == "it changed its input DTEST");
  CHECK(put(*k, 32) == "it changed its input CC");
  CHECK(put(*k, 35) == "it changed its input ID");
  CHECK(put(*k, 37) == "it changed its input ISURF");
  CHECK(put(*k, behaves).empty());
}

TEST_CASE("a library that is no plug-in is refused, in words") {
  const leftovers left;
  CHECK_THAT(why_refused("/no/such/library.so"), Contains("plugin:/no/such/library.so: cannot be loaded"));
  CHECK_THAT(why_refused("no-such-library.so"), Contains("cannot be loaded: ./no-such-library.so"));
  CHECK_THAT(why_refused("/etc/passwd"), Contains("cannot be loaded"));
  CHECK_THAT(why_refused(""), Contains("cannot be loaded"));
  CHECK_THAT(why_refused(plugin("no_symbol")),
             Contains("found no symbol contct_kernel; allowed: a library that exports"));
  CHECK_THAT(why_refused(plugin("other_abi")), Contains("found ABI 2; allowed: 1"));
  CHECK_THAT(why_refused(plugin("crashes_when_loaded")),
             Contains("signal 11") && Contains("while it was loaded"));
  CHECK_THAT(why_refused(plugin("hangs_when_loaded")), Contains("did not load within its time"));
  left.check();
}

TEST_CASE("a plug-in is asked calls of any size after a small one") {
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    for (const std::size_t dofs : {2U, 5000U, 2U, 200'000U, 2U}) {
      small_call<double> c = call_for(behaves);
      c.dd.resize(dofs, 7.0);
      c.dtest.resize(dofs, 7.0);
      call<double> arguments = c.arguments();
      k->answer(arguments);
      CHECK(arguments.smin == 1);
      CHECK(c.ss == std::vector<double>{1, 1});
    }
    for (const std::size_t pairs : {3000U, 0U, 30'000U}) {
      small_call<double> c(std::vector<pair_at<double>>(pairs, {0.0, 1.0, 0.0, separated, face_below}));
      call<double> arguments = c.arguments();
      k->answer(arguments);
      CHECK(arguments.smin == 1);
      CHECK(c.ss == std::vector<double>(pairs, 1.0));
      CHECK(c.isep == std::vector<int>(pairs, separated));
    }
  }
  left.check();
}

TEST_CASE("a FORTRAN plug-in's unit 26 is not this program's, and leaves no file") {
  const leftovers left;
  const std::filesystem::path file = "fort.26";
  std::filesystem::remove(file);
  {
    const auto listing = make_kernel("fortran");
    small_call<double> c({{0.0, -4.0, -1.0, separated, face_below}});
    call<double> arguments = c.arguments();
    listing->answer(arguments);
    {
      const auto k = make_plugin(plugin("writes_unit_26"), short_patience());
      CHECK(put(*k, behaves).empty());
      CHECK(put(*k, behaves).empty());
    }
    listing->answer(arguments);
    const std::string text = listing->take_text();
    CHECK_THAT(text, Contains("MAKING") && Contains("BREAKING") && !Contains("plug-in"));
  }
  CHECK_FALSE(std::filesystem::exists(file));
  left.check();
}

TEST_CASE("a FORTRAN plug-in leaves no file where the listing never ran") {
  std::filesystem::remove("fort.26");
  {
    const auto k = make_plugin(plugin("writes_unit_26"), short_patience());
    CHECK(put(*k, behaves).empty());
  }
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE("a plug-in's crash is told as one whatever this program does about its own") {
  const auto own = std::signal(SIGSEGV, [](int) { _exit(9); });
  const std::string words = put(*make_plugin(plugin("misbehaves"), short_patience()), crashes);
  (void)std::signal(SIGSEGV, own);
  CHECK_THAT(words, Contains("it was ended by signal 11"));
}

TEST_CASE("what a plug-in prints goes to standard error") {
  const caught_stream out(STDOUT_FILENO);
  const caught_stream err(STDERR_FILENO);
  std::string words;
  (void)std::fputs("not yet printed", stdout);  // the child has a copy of this, and must not print it
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    words = put(*k, talks) + put(*k, exits_0);
  }
  const std::string printed = out.text();
  const std::string complained = err.text();
  (void)std::fflush(stdout);
  CHECK(words == "it ended with status 0");
  CHECK(printed.empty());
  CHECK(complained == "text of a plug-in\n");
}

TEST_CASE("a command that answers is a kernel") {
  const leftovers left;
  {
    const auto k = make_pipe(well_behaved, short_patience());
    for (int i = 0; i < 3; ++i) CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("a second answer that comes late is not taken for the next call's") {
  const leftovers left;
  {
    const std::string said = well_behaved;
    const std::string twice = said.substr(0, said.rfind("; done")) + " && sleep 0.05 && echo stray; done";
    const auto k = make_pipe(twice, short_patience());
    CHECK(put(*k, behaves).empty());
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    CHECK(put(*k, behaves) == "it answered without being asked");
    CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("a command that ends is reported, and the next call is asked of a fresh one") {
  const leftovers left;
  CHECK(put_to_pipe("exit 0") == "it ended with status 0");
  CHECK(put_to_pipe("read -r line; exit 3") == "it ended with status 3");
  CHECK_THAT(put_to_pipe("kill -SEGV $$"), Contains("ended by signal 11"));
  CHECK(put_to_pipe("/no/such/command 2>/dev/null") == "it ended with status 127");
  const std::string seen = "outside_test.seen";
  std::filesystem::remove_all(seen);
  {
    const auto k = make_pipe("mkdir " + seen + " 2>/dev/null && exit 4; " + well_behaved, short_patience());
    CHECK(put(*k, behaves) == "it ended with status 4");
    CHECK(put(*k, behaves).empty());
  }
  std::filesystem::remove_all(seen);
  left.check();
}

TEST_CASE("a command that does not answer, closes its pipe or never stops talking is given up") {
  const leftovers left;
  CHECK(put_to_pipe("exec cat >/dev/null") == "it did not answer within 500 ms");
  CHECK(put_to_pipe("exec sleep 100") == "it did not answer within 500 ms");
  CHECK(put_to_pipe("exec sleep 100 <&- >&-") == "it closed its end of the pipe");
  CHECK_THAT(put_to_pipe("exec yes 2>/dev/null"), Contains("it answered more than 10") && Contains("bytes"));
  CHECK(put_to_pipe("printf 'smin 0x1p+0\\n'; exec cat >/dev/null") == "it did not answer within 500 ms");
  left.check();
}

TEST_CASE("a command that answers nonsense is told what was found and what is allowed") {
  const auto answering = [](const std::string& text) {
    return put_to_pipe("printf '" + text + "'; exec cat >/dev/null");
  };
  CHECK_THAT(answering("hello\\nend\\n"),
             Contains("answered nonsense: its answer:1: found hello; allowed: \"smin X\""));
  CHECK_THAT(answering("end\\n"), Contains("its answer:1: found end"));
  CHECK_THAT(answering("smin 1\\nend\\n"),
             Contains("its answer:2: found end; allowed: \"pair 1 ss X isep S\""));
  CHECK_THAT(answering("smin 1\\npair 2 ss 1 isep 1\\npair 1 ss 1 isep 1\\nend\\n"),
             Contains("its answer:2"));
  CHECK_THAT(answering("smin 1\\npair 1 ss 1 isep 1.5\\npair 2 ss 1 isep 1\\nend\\n"), Contains("isep 1.5"));
  CHECK_THAT(answering("smin 1\\npair 1 ss one isep 1\\npair 2 ss 1 isep 1\\nend\\n"), Contains("ss one"));
  CHECK_THAT(answering("smin 1\\npair 1 ss 1 isep 1\\npair 2 ss 1 isep 1\\nend\\nsmin 1\\nend\\n"),
             Contains("goes on behind \"end\""));
  CHECK_THAT(answering("smin\\t1\\033[2J\\nend\\n"), Contains("found smin\\x091\\x1b[2J; allowed"));
}
