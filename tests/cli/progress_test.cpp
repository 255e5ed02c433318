// Progress: on a terminal that waits, gone in the end, and nowhere else.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "cli/process.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
namespace fs = std::filesystem;

namespace {

const char* const erased = "\r\033[K";

/// Work of each command that takes some seconds on any machine of today.
struct long_work {
  const char* name;
  std::vector<std::string> arguments;
  const char* shows;
};

std::vector<long_work> long_works() {
  return {{"run",
           {"run", "big.toml", "--kernels", "corrected", "--engine", "refactor"},
           "step 2 of 2, increment "},
          {"explain", {"explain", "big.toml", "--json", "/dev/null"}, "step 2 of 2, increment "},
          {"verify", {"verify", "--reference", "reference"}, " problems"},
          {"atlas", {"atlas", "--problems", "60"}, " problems"},
          {"fuzz", {"fuzz", "--calls", "500000"}, " % of "}};
}

/// The reference problems, twice over.
void write_reference(const scratch_directory& dir) {
  const fs::path reference = CONTCT_ROOT "/reference";
  std::ostringstream once;
  once << std::ifstream(reference / "verification.toml").rdbuf();
  fs::create_directory(dir.path() / "reference");
  fs::create_symlink(reference / "problems", dir.path() / "reference/problems");
  dir.write("reference/verification.toml", once.str() + once.str());
}

/// The plate of `contct new` with twenty times as many elements.
void write_big(const scratch_directory& dir) {
  std::string text = contct_program(dir.path(), {"new", "plate", "-"}).out;
  const auto replace = [&text](const std::string& from, const std::string& to) {
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
  };
  replace("elements  = [8, 4]", "elements = [40, 20]");
  replace("node      = 45", "node = 861");
  dir.write("big.toml", text);
}

finished at_terminal(const scratch_directory& dir, const std::vector<std::string>& arguments,
                     bool both = false) {
  process_options o;
  o.terminal = both;
  o.error_terminal = true;
  o.environment = {{"TERM", "dumb"}};
  return contct_program(dir.path(), arguments, o);
}

}  // namespace

TEST_CASE("whatever takes over a second shows its progress on a terminal, and erases it in the end") {
  const scratch_directory dir;
  write_big(dir);
  write_reference(dir);
  for (const long_work& w : long_works()) {
    INFO(w.name);
    const finished f = at_terminal(dir, w.arguments);
    CHECK(f.exit == 0);
    CHECK_THAT(f.err, Contains(w.shows));
    CHECK_THAT(f.err, EndsWith(erased));
    CHECK(f.err.find('\n') == std::string::npos);
    CHECK(f.out.find('\r') == std::string::npos);
  }
}

TEST_CASE("quiet takes the progress away, and so does a standard error that is no terminal") {
  const scratch_directory dir;
  write_big(dir);
  write_reference(dir);
  for (const long_work& w : long_works()) {
    if (std::string(w.name) == "atlas") continue;  // it has no --quiet
    INFO(w.name);
    std::vector<std::string> arguments = w.arguments;
    arguments.emplace_back("--quiet");
    const finished quiet = at_terminal(dir, arguments);
    CHECK(quiet.exit == 0);
    CHECK(quiet.err.empty());
  }
  CHECK(contct_program(dir.path(), {"run", "big.toml", "--kernels", "corrected"}).err.empty());
}

TEST_CASE("where table and progress share a terminal, every row of the table begins on a clean line") {
  const scratch_directory dir;
  write_big(dir);
  const std::vector<std::string> run = {"run", "big.toml", "--kernels", "corrected", "--engine", "refactor"};
  const finished plain = contct_program(dir.path(), run);
  std::string seen = at_terminal(dir, run, true).out;
  CHECK_THAT(seen, Contains("step 2 of 2, increment "));
  // What remains on the screen: a line up to where it was last erased is gone.
  std::string screen;
  for (std::size_t from = 0; from < seen.size();) {
    const std::size_t end = std::min(seen.find('\n', from), seen.size());
    std::string line = seen.substr(from, end - from);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (const std::size_t last = line.rfind(erased); last != std::string::npos) line.erase(0, last + 4);
    if (end < seen.size()) screen += line + "\n";
    from = end + 1;
  }
  CHECK(screen == plain.out);
}

TEST_CASE("what is quick shows no progress") {
  const scratch_directory dir;
  REQUIRE(contct_program(dir.path(), {"new", "beam"}).exit == 0);
  CHECK(at_terminal(dir, {"run", "beam.toml"}).err.empty());
  CHECK(at_terminal(dir, {"explain", "beam.toml"}).err.empty());
  CHECK(at_terminal(dir, {"kernels"}).err.empty());
}
