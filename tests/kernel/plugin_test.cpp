// Tests that a plug-in that crashes, hangs, writes outside its outputs or cannot be loaded is reported, and
// that the run continues.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "contct/kernel/fortran.hpp"
#include "contct/kernel/registry.hpp"
#include "kernel/outside_calls.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

std::string plugin(const std::string& name) {
  return CONTCT_PLUGINS "/" + name + ".so";
}

std::string why_refused(const std::string& path) {
  try {
    (void)make_plugin(path, short_patience());
  } catch (const std::invalid_argument& refused) {
    return refused.what();
  }
  return "nothing";
}

/// Changes to a new folder while this object lives, since FORTRAN writes fort.26 to the current folder.
class in_own_folder {
 public:
  in_own_folder() { std::filesystem::current_path(folder_.path()); }
  ~in_own_folder() { std::filesystem::current_path(before_); }
  in_own_folder(const in_own_folder&) = delete;
  in_own_folder& operator=(const in_own_folder&) = delete;

  [[nodiscard]] bool is_empty() const { return folder_.files().empty(); }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
  scratch_folder folder_;
};

/// Redirects the file descriptor `stream` to a file while this object lives.
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

TEST_CASE("a kernel plug-in that hangs three times is stopped, and is not started again") {
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    for (int i = 0; i < 3; ++i) {
      CHECK(put(*k, behaves).empty());
      CHECK_THAT(put(*k, hangs), Contains("it did not answer within 500 ms"));
    }
    left.check();  // the hanging child has ended, and no other child is started
    CHECK_THAT(put(*k, behaves), Contains("not called again after 3 failures; the last: it did not answer"));
    left.check();
  }
  left.check();
}

TEST_CASE(
    "after the allowed number of quick failures, 1000 by default, a kernel plug-in is not called again") {
  const leftovers left;
  {
    outside_limits limits;  // 40 failures instead of 1000, which take long under a sanitizer
    CHECK(limits.most_failures == 1000);
    limits.most_failures = 40;
    const auto k = make_plugin(plugin("misbehaves"), limits);
    int failed = 0;
    for (int i = 0; i < 40; ++i) failed += put(*k, exits_3) == "it ended with status 3" ? 1 : 0;
    CHECK(failed == 40);
    CHECK_THAT(put(*k, behaves), Contains("not called again after 40 failures"));
  }
  left.check();
}

TEST_CASE("if a kernel plug-in writes outside an array, the call fails and the message names the array") {
  const std::vector<std::string> arrays = {"DD", "DTEST", "CC", "SS", "SMIN", "ID", "ISEP", "ISURF"};
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"), short_patience());
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      CHECK(put(*k, 10 + static_cast<double>(i)) == "it wrote before the start of " + arrays[i]);
      CHECK(put(*k, 20 + static_cast<double>(i)) == "it wrote past the end of " + arrays[i]);
    }
    CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("if a kernel plug-in changes an input, the call fails and the message names the input") {
  const auto k = make_plugin(plugin("misbehaves"), short_patience());
  CHECK(put(*k, 30) == "it changed its input DD");
  CHECK(put(*k, 31) == "it changed its input DTEST");
  CHECK(put(*k, 32) == "it changed its input CC");
  CHECK(put(*k, 35) == "it changed its input ID");
  CHECK(put(*k, 37) == "it changed its input ISURF");
  CHECK(put(*k, behaves).empty());
}

TEST_CASE("a library that is not a kernel plug-in is refused, and the message gives the reason") {
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
  CHECK_THAT(why_refused(plugin("hangs_when_loaded")), Contains("did not load within the time limit"));
  left.check();
}

TEST_CASE("after a small call, a kernel plug-in answers calls of any size") {
  const leftovers left;
  {
    const auto k = make_plugin(plugin("misbehaves"));
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

TEST_CASE("unit 26 of a FORTRAN plug-in is separate from unit 26 of this program, and leaves no file") {
  const leftovers left;
  const in_own_folder here;
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
  CHECK(here.is_empty());
  left.check();
}

TEST_CASE(
    "a FORTRAN plug-in leaves no file of unit 26 behind, even if the process never called the listing") {
  const in_own_folder here;
  {
    const auto k = make_plugin(plugin("writes_unit_26"), short_patience());
    CHECK(put(*k, behaves).empty());
  }
  CHECK(here.is_empty());
}

TEST_CASE("if a kernel plug-in crashes, the signal is reported, whatever signal handler this program has") {
  const auto own = std::signal(SIGSEGV, [](int) { _exit(9); });
  const std::string words = put(*make_plugin(plugin("misbehaves"), short_patience()), crashes);
  (void)std::signal(SIGSEGV, own);
  CHECK_THAT(words, Contains("it was ended by signal 11"));
}

TEST_CASE("what a kernel plug-in prints goes to standard error") {
  const caught_stream out(STDOUT_FILENO);
  const caught_stream err(STDERR_FILENO);
  std::string words;
  // The child has a copy of stdout's buffer, and must not print it.
  (void)std::fputs("not yet printed", stdout);
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
