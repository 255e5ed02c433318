// Tasks in several processes: their results in order, and what becomes of a worker that fails.
#include "contct/lab/workers.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/kernel.hpp"

using namespace contct::lab;
using contct::kernels::kernel_failure;

namespace {

struct taken {
  std::vector<std::int64_t> numbers;
  std::string all;
};

taken done_by(int jobs, std::int64_t tasks, const task_work& work) {
  taken t;
  do_tasks(jobs, tasks, work, [&t](std::int64_t number, const std::string& result) {
    t.numbers.push_back(number);
    t.all += result;
  });
  return t;
}

bool has_no_child() {
  return waitpid(-1, nullptr, WNOHANG) == -1;
}

/// What happens to task 5 of 20 is thrown after the first five are taken, and nobody is left.
template <class Thrown>
std::string thrown_by(int jobs, const task_work& work) {
  std::int64_t before = 0;
  std::string words = "nothing was thrown";
  try {
    do_tasks(jobs, 20, work, [&before](std::int64_t, const std::string&) { ++before; });
  } catch (const Thrown& e) {
    words = e.what();
  }
  if (!std::is_same_v<Thrown, std::bad_alloc>) CHECK(before == 5);  // a worker without memory says nothing
  CHECK(has_no_child());
  return words;
}

}  // namespace

TEST_CASE("the results of one, two and three jobs are taken in the order of tasks, long ones whole") {
  const task_work work = [](std::int64_t n) {
    return std::to_string(n) + std::string(static_cast<std::size_t>(n % 7) * 100'000, '.');
  };
  for (const std::int64_t tasks : {0, 1, 2, 50}) {
    const taken one = done_by(1, tasks, work);
    CHECK(static_cast<std::int64_t>(one.numbers.size()) == tasks);
    for (const int jobs : {2, 3, 100, 0}) {
      const taken several = done_by(jobs, tasks, work);
      CHECK(several.numbers == one.numbers);
      CHECK(several.all == one.all);
    }
  }
  CHECK(has_no_child());
}

TEST_CASE("a task that ends after its successors is taken before them") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const taken t = done_by(2, 10, [&ends](std::int64_t n) {
    char byte = 'x';
    if (n == 0 && read(ends[0], &byte, 1) != 1) throw std::runtime_error("no byte");
    if (n == 4 && write(ends[1], &byte, 1) != 1) throw std::runtime_error("no byte sent");
    return std::to_string(n);
  });
  CHECK(t.all == "0123456789");
  close(ends[0]);
  close(ends[1]);
}

TEST_CASE("two jobs are two other processes, one job is this one") {
  const auto process = [](std::int64_t) { return std::to_string(getpid()) + " "; };
  const std::string own = process(0);
  CHECK(done_by(1, 2, process).all == own + own);
  CHECK(done_by(2, 2, process).all.find(own) == std::string::npos);
}

TEST_CASE("what a task throws is thrown in its turn, whatever the number of jobs") {
  for (const int jobs : {1, 3}) {
    CHECK(thrown_by<kernel_failure>(jobs, [](std::int64_t n) -> std::string {
            if (n >= 5) throw kernel_failure("no answer to " + std::to_string(n));
            return "";
          }) == "no answer to 5");
    CHECK(thrown_by<std::runtime_error>(jobs, [](std::int64_t n) -> std::string {
            if (n >= 5) throw std::runtime_error("found " + std::to_string(n));
            return "";
          }) == "found 5");
    CHECK(thrown_by<std::bad_alloc>(jobs, [](std::int64_t n) -> std::string {
            if (n == 5) throw std::bad_alloc();
            return n < 5 ? "" : "later";
          }) != "nothing was thrown");
  }
}

TEST_CASE("a worker that is killed, or exits, ends the tasks with one message") {
  const auto words = [](const task_work& work) {
    try {
      (void)done_by(2, 20, work);
    } catch (const std::runtime_error& e) {
      return std::string(e.what());
    }
    return std::string("nothing was thrown");
  };
  using Catch::Matchers::StartsWith;
  CHECK_THAT(words([](std::int64_t n) {
               if (n == 7) (void)raise(SIGKILL);
               return std::string();
             }),
             StartsWith("a worker process was ended by signal 9 (Killed) before its task was done"));
  CHECK_THAT(words([](std::int64_t n) {
               if (n == 7) _exit(3);
               return std::string();
             }),
             StartsWith("a worker process ended with status 3"));
  CHECK(has_no_child());
}

TEST_CASE("what is thrown where results are taken leaves no worker") {
  CHECK_THROWS_AS(do_tasks(
                      3, 100, [](std::int64_t) { return std::string(); },
                      [](std::int64_t n, const std::string&) {
                        if (n == 9) throw std::logic_error("enough");
                      }),
                  std::logic_error);
  CHECK(has_no_child());
}
