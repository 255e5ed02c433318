// Tests that a command that crashes, hangs or gives a wrong answer is reported, and that the run continues.
#include <sys/stat.h>

#include <fstream>

#include "kernel/outside_calls.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// A command that answers every call of two pairs with no event.
const std::string well_behaved =
    "while read -r line; do [ \"$line\" = ask ] && "
    "printf 'smin 0x1p+0\\npair 1 ss 0x1p+0 isep 1\\npair 2 ss 0x1p+0 isep -1\\nend\\n'; done";

std::string put_to_pipe(const std::string& command) {
  return put(*make_pipe(command, short_patience()), behaves);
}

}  // namespace

TEST_CASE("if a kernel command answers a call twice, the second answer is not used for the next call") {
  const leftovers left;
  {
    // The command writes a second answer after the first answer was read, and before the next call.
    const scratch_folder folder;
    const std::string go = folder.at("go");
    const std::string said = folder.at("said");
    REQUIRE(mkfifo(go.c_str(), 0600) == 0);
    REQUIRE(mkfifo(said.c_str(), 0600) == 0);
    const std::string twice = well_behaved.substr(0, well_behaved.rfind("; done")) + " && read -r word < '" +
                              go + "' && echo stray && echo said > '" + said + "'; done";
    const auto k = make_pipe(twice, short_patience());
    CHECK(put(*k, behaves).empty());
    std::ofstream(go) << "go\n";
    std::string word;
    std::ifstream(said) >> word;
    CHECK(word == "said");
    CHECK(put(*k, behaves) == "it answered without being called");
    CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("a kernel command that ends is reported, and the next call starts a new process") {
  const leftovers left;
  CHECK(put_to_pipe("exit 0") == "it ended with status 0");
  CHECK(put_to_pipe("read -r line; exit 3") == "it ended with status 3");
  CHECK_THAT(put_to_pipe("kill -SEGV $$"), Contains("ended by signal 11"));
  CHECK(put_to_pipe("/no/such/command 2>/dev/null") == "it ended with status 127");
  {
    const scratch_folder folder;
    const std::string seen = folder.at("seen");
    const auto k = make_pipe("mkdir " + seen + " 2>/dev/null && exit 4; " + well_behaved, short_patience());
    CHECK(put(*k, behaves) == "it ended with status 4");
    CHECK(put(*k, behaves).empty());
  }
  left.check();
}

TEST_CASE("a kernel command is stopped if it does not answer, closes the pipe or writes too much") {
  const leftovers left;
  const std::string wanted = "; allowed: an answer that ends with the line \"end\", and a flush after it";
  CHECK(put_to_pipe("exec cat >/dev/null") == "it did not answer within 500 ms: found nothing" + wanted);
  CHECK(put_to_pipe("exec sleep 100 <&- >&-") == "it closed its end of the pipe");
  CHECK_THAT(put_to_pipe("exec tr '\\0' y </dev/zero 2>/dev/null"),
             Contains("it answered more than 10") && Contains("bytes"));
  CHECK(put_to_pipe("printf 'smin 0x1p+0\\n'; exec cat >/dev/null") ==
        "it did not answer within 500 ms: found \"smin 0x1p+0\\x0a\"" + wanted);
  left.check();
}

TEST_CASE("an invalid answer of a kernel command is refused, with what was found and what is allowed") {
  const auto answering = [](const std::string& text) {
    return put_to_pipe("printf '" + text + "'; exec cat >/dev/null");
  };
  const std::string pairs = "pair 1 ss 1 isep 1\\npair 2 ss 1 isep -1\\n";
  CHECK(answering("smin 1\\r\\npair 1 ss 1 isep 1\\r\\npair 2 ss 1 isep -1\\r\\nend\\r\\n").empty());
  CHECK(answering("smin 1\\rpair 1 ss 1 isep 1\\rpair 2 ss 1 isep -1\\rend\\r") ==
        "it ends lines with CR alone; allowed: LF, or CR LF");
  for (const char* number : {"1D0", "1.0D+00", "1,0", "+1", " 1"})
    CHECK_THAT(answering("smin " + std::string(number) + "\\n" + pairs + "end\\n"),
               Contains("its answer:1: found smin " + std::string(number) +
                        "; allowed: \"smin X\", X such as 1.1e-20") &&
                   Contains("(E, not D)") && Contains("one blank between words"));
  for (const char* end : {"END", " end", "end ", "done", ""})
    CHECK_THAT(answering("smin 1\\n" + pairs + end + "\\n"),
               Contains("its answer:4: found " + std::string(end) + "; allowed: ") && Contains("\"end\""));
  CHECK_THAT(answering("hello\\nend\\n"),
             Contains("gave an invalid answer: its answer:1: found hello; allowed: \"smin X\""));
  CHECK_THAT(answering("smin 1\\nend\\n"),
             Contains("its answer:2: found end; allowed: \"pair 1 ss X isep S\""));
  CHECK_THAT(answering("smin 1\\npair 2 ss 1 isep 1\\npair 1 ss 1 isep 1\\nend\\n"),
             Contains("its answer:2"));
  CHECK_THAT(answering("smin 1\\npair 1 ss 1 isep 1\\npair 2 ss 1 isep 1\\nend\\nsmin 1\\nend\\n"),
             Contains("continues after \"end\""));
  CHECK_THAT(answering("smin\\t1\\033[2J\\nend\\n"), Contains("found smin\\x091\\x1b[2J; allowed"));
}
