#include "contct/kernel/fortran.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <thread>

#include "catch.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

small_call<double> one_that_closes() {
  return small_call<double>({{0.0, 1.0, 0.25, separated, face_above}});
}

}  // namespace

TEST_CASE("the 1989 code answers a call in 4-byte REAL, as in the listing, and a call in 8-byte REAL") {
  small_call<float> r4({{0.0F, 3.0F, 1.0F, separated, face_above}});
  call<float> c4 = r4.arguments();
  fortran::contct(c4);
  CHECK(c4.smin == 1.0F / 3.0F);
  small_call<double> r8({{0.0, 3.0, 1.0, separated, face_above}});
  call<double> c8 = r8.arguments();
  fortran::contct(c8);
  CHECK(c8.smin == 1.0 / 3.0);
  CHECK(static_cast<double>(c4.smin) != c8.smin);
  CHECK(r8.isep[0] == in_contact);
}

TEST_CASE("if unit 26 is not requested, the 1989 code writes no text and no file fort.26") {
  for (int i = 0; i < 1000; ++i) {
    auto c = one_that_closes();
    call<double> arguments = c.arguments();
    fortran::contct(arguments);
  }
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE("each request for the text of unit 26 returns only the text of calls since the request before") {
  fortran::unit_26 log;
  CHECK(log.take().empty());
  auto c = one_that_closes();
  call<double> arguments = c.arguments();
  fortran::contct(arguments);
  const std::string text = log.take();
  CHECK(text.find("MAKING CONTACT") != std::string::npos);
  CHECK(log.take().empty());
  c.isep[0] = separated;
  fortran::contct(arguments);
  CHECK(log.take() == text);
}

TEST_CASE("the text of unit 26 is read completely, whatever the number of calls since the last reading") {
  fortran::unit_26 log;
  auto c = small_call<double>({{0.0, 0.0, 0.25, separated, face_above}});
  call<double> arguments = c.arguments();
  const std::string line = "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n";
  std::size_t characters = 0;
  for (int take = 0; take < 3000; ++take) {
    // The text of 8192 calls fills a whole number of the blocks in which the file is read.
    const int calls = take % 1000 == 999 ? 8192 : take % 20;
    std::string written;
    for (int i = 0; i < calls; ++i) {
      fortran::contct(arguments);
      written += line;
    }
    INFO(take);
    REQUIRE(log.take() == written);
    characters += written.size();
  }
  CHECK(characters > 2'500'000);
}

TEST_CASE("only one object at a time can open unit 26, because unit 26 belongs to the whole process") {
  {
    const fortran::unit_26 log;
    CHECK_THROWS_AS(fortran::unit_26(), std::logic_error);
  }
  CHECK_NOTHROW(fortran::unit_26());
}

TEST_CASE("if a signal ends the process at any moment, no file of unit 26 remains") {
  const auto folder =
      std::filesystem::temp_directory_path() / ("contct-unit26-test-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  for (int i = 0; i < 40; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      (void)std::signal(SIGTERM, SIG_DFL);
      setenv("TMPDIR", folder.c_str(), 1);
      while (true) (void)fortran::unit_26();
    }
    usleep(static_cast<useconds_t>(3000 + 37 * i));
    kill(child, SIGTERM);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
  }
  CHECK(std::filesystem::is_empty(folder));
  std::filesystem::remove_all(folder);
}

TEST_CASE("COMMON /DOF/ is set for every call, so that calls in several threads do not affect each other") {
  const auto many = [](int indof, bool& right) {
    // Node 1 has the dofs 1 to 3, of which only dof `indof` responds.
    const std::vector<double> dd(3, 0.0);
    std::vector<double> dtest(3, 0.0);
    dtest[static_cast<std::size_t>(indof) - 1] = 4.0;
    const std::vector<double> cc = {1.0};
    const std::vector<int> id = {1};
    const std::vector<int> isurf = {face_above};
    for (int i = 0; i < 20000; ++i) {
      std::vector<double> ss = {0.0};
      std::vector<int> isep = {separated};
      call<double> c{dd, dtest, cc, ss, 0.0, id, isep, isurf, {indof, 3}};
      fortran::contct(c);
      right = right && c.smin == 0.25;
    }
  };
  bool first = true;
  bool second = true;
  std::thread a(many, 1, std::ref(first));
  std::thread b(many, 3, std::ref(second));
  a.join();
  b.join();
  CHECK(first);
  CHECK(second);
}
