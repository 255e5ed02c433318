// A child process answers over its channel, and its end is reported.
#include "contct/outside/child_process.hpp"

#include <unistd.h>

#include <csignal>

#include "outside/outside_calls.hpp"

using namespace contct::app;

namespace {

using sent = child_process::sent;

child_process::clock::time_point soon() {
  return child_process::clock::now() + std::chrono::seconds(20);
}

/// Sends back what comes, until the channel is closed.
void echo(int channel) {
  char word = 0;
  while (read(channel, &word, 1) == 1 && write(channel, &word, 1) == 1) {
  }
}

}  // namespace

TEST_CASE("a child gets what is sent, and its answer is received") {
  const leftovers left;
  {
    child_process child(echo);
    std::string back;
    CHECK(child.send("ab", soon()) == sent::whole);
    while (back.size() < 2) REQUIRE(child.receive(back, soon()) == sent::whole);
    CHECK(back == "ab");
    CHECK(child.receive(back, child_process::clock::now()) == sent::late);
    CHECK(back == "ab");
  }
  left.check();
}

TEST_CASE("how a child ended is reported: its status, its signal, or that it was stopped") {
  const leftovers left;
  {
    const auto end_of = [](const std::function<void(int)>& body) {
      child_process child(body);
      std::string nothing;
      CHECK(child.receive(nothing, soon()) == sent::gone);
      return child.end();
    };
    CHECK(end_of([](int) { _exit(2); }) == "ended with status 2");
    CHECK(end_of([](int) {}) == "ended with status 0");
    CHECK_THAT(end_of([](int) { (void)raise(SIGSEGV); }),
               Catch::Matchers::StartsWith("was ended by signal 11 ("));
    child_process deaf([](int channel) {
      if (write(channel, "x", 1) != 1) _exit(3);
      for (;;) pause();
    });
    std::string ready;
    REQUIRE(deaf.receive(ready, soon()) == sent::whole);
    CHECK(deaf.end() == child_process::was_stopped);
    CHECK(deaf.end() == child_process::was_stopped);  // once more, of a child that is gone
  }
  left.check();
}
