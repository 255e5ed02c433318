// Tests that a command or plug-in that crashes, hangs, gives an invalid answer, writes outside its outputs or
// cannot be loaded is reported, that the run continues, and that no file and no process is left behind.
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "catch.hpp"
#include "contct/kernel/child_kernel.hpp"
#include "contct/kernel/fortran.hpp"
#include "contct/kernel/registry.hpp"
#include "support/one_pair.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;

namespace {

// Faults of misbehaves.c.
constexpr double behaves = 0, crashes = 1, exits_0 = 3, exits_3 = 4, hangs = 5, talks = 6;

outside_limits short_patience() {
  outside_limits limits;
  limits.patience = std::chrono::milliseconds(500);
  return limits;
}

/// Returns a call whose first face selects a fault of misbehaves.c.
small_call<double> call_for(double fault) {
  return small_call<double>({{0.5, 2.0, fault}, {0.0, 1.0, 4.0, in_contact, face_below}});
}

/// Returns the reported failure of a kernel, or an empty text if the kernel correctly answers without an
/// event.
std::string put(kernel& k, double fault = behaves) {
  small_call<double> c = call_for(fault);
  try {
    c.ask(k);
  } catch (const kernel_failure& failure) {
    return failure.what();
  }
  const bool right =
      c.smin == 1 && c.ss == std::vector<double>{1, 1} && c.isep == std::vector<int>{separated, in_contact};
  return right ? "" : "another answer";
}

std::string put_to_pipe(const std::string& command, const outside_limits& limits = {}) {
  return put(*make_pipe(command, limits));
}

std::string plugin(const std::string& name) {
  return CONTCT_PLUGINS "/" + name + ".so";
}

/// A command that answers every call of two pairs with no event.
const std::string well_behaved =
    "while read -r line; do [ \"$line\" = ask ] && "
    "printf 'smin 0x1p+0\\npair 1 ss 0x1p+0 isep 1\\npair 2 ss 0x1p+0 isep -1\\nend\\n'; done";

long open_descriptors() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

/// Checks that kernels leave no open file and no child process.
class leftovers {
 public:
  ~leftovers() { check(); }
  void check() const {
    CHECK(open_descriptors() == descriptors_);
    errno = 0;
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);  // no child process exists
    CHECK(errno == ECHILD);
  }

 private:
  long descriptors_ = open_descriptors();
};

/// Changes to a new folder while this object lives, since FORTRAN writes fort.26 to the current folder.
class in_own_folder {
 public:
  in_own_folder() { std::filesystem::current_path(folder_.path()); }
  ~in_own_folder() { std::filesystem::current_path(before_); }

  [[nodiscard]] bool is_empty() const { return folder_.files().empty(); }

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
  scratch_folder folder_;
};

/// Returns what is written to the file descriptor of a stream while `f` runs.
std::string written_to(std::FILE* stream, const std::function<void()>& f) {
  const scratch_folder folder;
  (void)std::fflush(stream);
  const int kept = dup(fileno(stream)), file = open(folder.write("text", "").c_str(), O_WRONLY);
  dup2(file, fileno(stream));
  f();
  std::string text = folder.read("text");
  (void)std::fflush(stream);
  dup2(kept, fileno(stream));
  close(kept);
  close(file);
  return text;
}

}  // namespace

TEST_CASE("if a kernel command answers a call twice, the second answer is not used for the next call") {
  const leftovers left;
  // The command writes a second answer after the first answer was read, and before the next call.
  const scratch_folder folder;
  const std::string go = folder.at("go"), said = folder.at("said");
  REQUIRE(mkfifo(go.c_str(), 0600) == 0);
  REQUIRE(mkfifo(said.c_str(), 0600) == 0);
  const auto k = make_pipe(well_behaved.substr(0, well_behaved.rfind("; done")) + " && read -r word < '" +
                           go + "' && echo stray && echo said > '" + said + "'; done");
  CHECK(put(*k).empty());
  std::ofstream(go) << "go\n";
  std::string word;
  std::ifstream(said) >> word;
  CHECK(word == "said");
  CHECK(put(*k) == "it answered without being called");
  CHECK(put(*k).empty());
}

TEST_CASE("a command that ends, hangs, closes the pipe, writes too much or answers wrongly is reported") {
  const leftovers left;
  const std::string late = "it did not answer within 500 ms: found ";
  const std::string wanted = "; allowed: an answer that ends with the line \"end\", and a flush after it";
  const std::pair<std::string, std::string> failures[] = {
      {"exit 0", "it ended with status 0"},
      {"read -r line; exit 3", "it ended with status 3"},
      {"kill -SEGV $$", "ended by signal 11"},
      {"/no/such/command 2>/dev/null", "it ended with status 127"},
      {"exec cat >/dev/null", late + "nothing" + wanted},
      {"printf 'smin 0x1p+0\\n'; exec cat >/dev/null", late + "\"smin 0x1p+0\\x0a\"" + wanted},
      {"exec sleep 100 <&- >&-", "it closed its end of the pipe"},
      {"exec tr '\\0' y </dev/zero 2>/dev/null", "it answered more than 10"},
  };
  for (const auto& [command, words] : failures)
    CHECK_THAT(put_to_pipe(command, words.starts_with(late) ? short_patience() : outside_limits()),
               Contains(words));

  const std::string pairs = "pair 1 ss 1 isep 1\\npair 2 ss 1 isep -1\\n";
  std::vector<std::pair<std::string, std::string>> answers = {
      {"smin 1\\rpair 1 ss 1 isep 1\\rpair 2 ss 1 isep -1\\rend\\r",
       "it ends lines with CR alone; allowed: LF, or CR LF"},
      {"hello\\nend\\n", "gave an invalid answer: its answer:1: found hello; allowed: \"smin X\""},
      {"smin 1\\nend\\n", "its answer:2: found end; allowed: \"pair 1 ss X isep S\""},
      {"smin 1\\npair 2 ss 1 isep 1\\npair 1 ss 1 isep 1\\nend\\n", "its answer:2"},
      {"smin 1\\npair 1 ss 1 isep 1\\npair 2 ss 1 isep 1\\nend\\nsmin 1\\nend\\n", "continues after \"end\""},
      {"smin\\t1\\033[2J\\nend\\n", "found smin\\x091\\x1b[2J; allowed"},
  };
  for (const std::string number : {"1D0", "1.0D+00", "1,0", "+1", " 1"})
    answers.emplace_back("smin " + number + "\\n" + pairs + "end\\n",
                         "its answer:1: found smin " + number + "; allowed: \"smin X\", X such as 1.1e-20");
  for (const std::string end : {"END", " end", "end ", "done", ""})
    answers.emplace_back("smin 1\\n" + pairs + end + "\\n", "its answer:4: found " + end + "; allowed: ");
  for (const auto& [answer, words] : answers)
    CHECK_THAT(put_to_pipe("printf '" + answer + "'; exec cat >/dev/null"), Contains(words));
  CHECK(put_to_pipe("printf 'smin 1\\r\\npair 1 ss 1 isep 1\\r\\npair 2 ss 1 isep -1\\r\\nend\\r\\n'; exec "
                    "cat >/dev/null")
            .empty());
}

TEST_CASE("if a kernel command ends, the next call starts a new process") {
  const leftovers left;
  const scratch_folder folder;
  const auto k = make_pipe("mkdir " + folder.at("seen") + " 2>/dev/null && exit 4; " + well_behaved);
  CHECK(put(*k) == "it ended with status 4");
  CHECK(put(*k).empty());
}

TEST_CASE("a kernel plug-in that hangs three times is stopped, and is not started again") {
  const leftovers left;
  const auto k = make_plugin(plugin("misbehaves"), short_patience());
  for (int i = 0; i < 3; ++i) {
    CHECK(put(*k).empty());
    CHECK_THAT(put(*k, hangs), Contains("it did not answer within 500 ms"));
  }
  left.check();  // the hanging child has ended, and no other child is started
  CHECK_THAT(put(*k), Contains("not called again after 3 failures; the last: it did not answer"));
}

TEST_CASE("after the allowed number of failures, 1000 by default, a kernel plug-in is not called again") {
  const leftovers left;
  outside_limits limits;  // 40 failures instead of 1000, which take long under a sanitizer
  CHECK(limits.most_failures == 1000);
  limits.most_failures = 40;
  const auto k = make_plugin(plugin("misbehaves"), limits);
  for (int i = 0; i < 40; ++i) CHECK(put(*k, exits_3) == "it ended with status 3");
  CHECK_THAT(put(*k), Contains("not called again after 40 failures"));
}

TEST_CASE("if a kernel plug-in writes outside an array or changes an input, the message names the array") {
  const std::vector<std::string> arrays = {"DD", "DTEST", "CC", "SS", "SMIN", "ID", "ISEP", "ISURF"};
  const leftovers left;
  const auto k = make_plugin(plugin("misbehaves"));
  for (int i = 0; i < 8; ++i) {
    CHECK(put(*k, 10 + i) == "it wrote before the start of " + arrays[i]);
    CHECK(put(*k, 20 + i) == "it wrote past the end of " + arrays[i]);
    if (i != 3 && i != 4 && i != 6) CHECK(put(*k, 30 + i) == "it changed its input " + arrays[i]);
  }
  CHECK(put(*k).empty());
}

TEST_CASE("a library that is not a kernel plug-in is refused, and the message gives the reason") {
  const leftovers left;
  const std::pair<std::string, std::string> refused[] = {
      {"/no/such/library.so", "plugin:/no/such/library.so: cannot be loaded"},
      {"no-such-library.so", "cannot be loaded: ./no-such-library.so"},
      {"/etc/passwd", "cannot be loaded"},
      {"", "cannot be loaded"},
      {plugin("no_symbol"), "found no symbol contct_kernel; allowed: a library that exports"},
      {plugin("other_abi"), "found ABI 2; allowed: 1"},
      {plugin("crashes_when_loaded"), "signal 11 (Segmentation fault) while it was loaded"},
      {plugin("hangs_when_loaded"), "did not load within the time limit"},
  };
  for (const auto& [path, words] : refused)
    CHECK_THROWS_WITH(
        make_plugin(path, path == plugin("hangs_when_loaded") ? short_patience() : outside_limits()),
        Contains(words));
}

TEST_CASE("after a small call, a kernel plug-in answers calls of any size") {
  const leftovers left;
  const auto k = make_plugin(plugin("misbehaves"));
  for (const std::size_t dofs : {2U, 5000U, 2U, 200'000U, 2U}) {
    small_call<double> c = call_for(behaves);
    c.dd.resize(dofs, 7.0);
    c.dtest.resize(dofs, 7.0);
    CHECK(c.ask(*k).smin == 1);
    CHECK(c.ss == std::vector<double>{1, 1});
  }
  for (const std::size_t pairs : {3000U, 0U, 30'000U}) {
    small_call<double> c(std::vector<pair_at<double>>(pairs, {0.0, 1.0, 0.0, separated, face_below}));
    CHECK(c.ask(*k).smin == 1);
    CHECK(c.ss == std::vector<double>(pairs, 1.0));
    CHECK(c.isep == std::vector<int>(pairs, separated));
  }
}

TEST_CASE("unit 26 of a FORTRAN plug-in is separate from unit 26 of this program, and leaves no file") {
  const leftovers left;
  const in_own_folder here;
  const auto listing = make_kernel("fortran");
  small_call<double> c({{0.0, -4.0, -1.0, separated, face_below}});
  c.ask(*listing);
  for (int i = 0; i < 2; ++i) CHECK(put(*make_plugin(plugin("writes_unit_26"))).empty());
  c.ask(*listing);
  CHECK_THAT(listing->take_text(), Contains("MAKING") && Contains("BREAKING") && !Contains("plug-in"));
  CHECK(here.is_empty());
}

TEST_CASE("a FORTRAN plug-in leaves no file of unit 26, even if the process never called the listing") {
  const in_own_folder here;
  CHECK(put(*make_plugin(plugin("writes_unit_26"))).empty());
  CHECK(here.is_empty());
}

TEST_CASE("if a kernel plug-in crashes, the signal is reported, whatever signal handler this program has") {
  const auto own = std::signal(SIGSEGV, [](int) { _exit(9); });
  const std::string words = put(*make_plugin(plugin("misbehaves")), crashes);
  (void)std::signal(SIGSEGV, own);
  CHECK_THAT(words, Contains("it was ended by signal 11"));
}

TEST_CASE("what a kernel plug-in prints goes to standard error") {
  std::string words, complained;
  const std::string printed = written_to(stdout, [&] {
    complained = written_to(stderr, [&] {
      (void)std::fputs("not yet printed",
                       stdout);  // the child has a copy of stdout's buffer, and must not print it
      const auto k = make_plugin(plugin("misbehaves"));
      words = put(*k, talks) + put(*k, exits_0);
    });
  });
  CHECK(words == "it ended with status 0");
  CHECK(printed.empty());
  CHECK(complained == "text of a plug-in\n");
}
