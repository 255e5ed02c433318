// Tests that progress is shown only on a terminal, and erased at the end.
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;

namespace {

const char* const erased = "\r\033[K";

/// A command that shows progress, and a text that it must show.
struct long_work {
  const char* name;
  std::vector<std::string> arguments;
  const char* shows;
};

std::vector<long_work> long_works() {
  return {{"run", {"run", "plate.toml"}, "step 2 of 2, increment "},
          {"explain", {"explain", "plate.toml", "--json", "/dev/null"}, "step 2 of 2, increment "},
          {"exact", {"exact", "plate.toml"}, "step 2 of 2, increment "},
          {"verify", {"verify", "--reference", CONTCT_ROOT "/reference"}, " problems"},
          {"fuzz", {"fuzz", "--calls", "2000"}, " % of "},
          {"replay", {"replay", CONTCT_ROOT "/reference/traces/ties.trace"}, "ties.trace: 1 call"}};
}

/// Runs contct on a terminal, with CONTCT_PROGRESS_AFTER = `seconds`. `both`: standard output is the terminal
/// too.
finished at_terminal(const scratch_folder& dir, const std::vector<std::string>& arguments,
                     const std::string& seconds, bool both = false) {
  process_options o;
  o.terminal = both;
  o.error_terminal = true;
  o.environment = {{"TERM", "dumb"}, {"CONTCT_PROGRESS_AFTER", seconds}};
  return contct_program(dir.path(), arguments, o);
}

/// A scratch folder with the file plate.toml.
class plate_directory : public scratch_folder {
 public:
  plate_directory() { REQUIRE(contct_program(path(), {"new", "plate"}).exit == 0); }
};

}  // namespace

TEST_CASE("every long command shows progress on a terminal, and erases it at the end") {
  const plate_directory dir;
  for (const long_work& w : long_works()) {
    INFO(w.name);
    const finished f = at_terminal(dir, w.arguments, "0");
    CHECK(f.exit == 0);
    CHECK_THAT(f.err, Contains(w.shows));
    CHECK_THAT(f.err, EndsWith(erased));
    CHECK(f.err.find('\n') == std::string::npos);
    CHECK(f.out.find('\r') == std::string::npos);
  }
}

TEST_CASE("no command shows progress with --quiet, or if standard error is not a terminal") {
  const plate_directory dir;
  for (const long_work& w : long_works()) {
    INFO(w.name);
    std::vector<std::string> arguments = w.arguments;
    arguments.emplace_back("--quiet");
    const finished quiet = at_terminal(dir, arguments, "0");
    CHECK(quiet.exit == 0);
    CHECK(quiet.err.empty());
    CHECK(quiet.out.empty());
  }
  process_options at_once;
  at_once.environment = {{"CONTCT_PROGRESS_AFTER", "0"}};
  CHECK(contct_program(dir.path(), {"run", "plate.toml"}, at_once).err.empty());
}

TEST_CASE(
    "if the table and the progress share a terminal, the progress is erased before each row of the table") {
  const plate_directory dir;
  const std::vector<std::string> run = {"run", "plate.toml", "--kernels", "corrected"};
  const finished plain = contct_program(dir.path(), run);
  std::string seen = at_terminal(dir, run, "0", true).out;
  CHECK_THAT(seen, Contains("step 2 of 2, increment "));
  // The text that remains visible: an erase sequence removes the part of the line before the sequence.
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

TEST_CASE("contct run refuses a CONTCT_PROGRESS_AFTER that is not a number of seconds") {
  const plate_directory dir;
  for (const char* const wrong : {"soon", "-1", "nan", "1s", ""}) {
    const finished f = at_terminal(dir, {"run", "plate.toml"}, wrong);
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, Contains("CONTCT_PROGRESS_AFTER") && Contains("allowed: seconds, 0 or more"));
  }
}
