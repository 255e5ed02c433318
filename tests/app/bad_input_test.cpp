// Tests that wrong input gives exit status 2, one message with file, line and column, and no output file.
#include <algorithm>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/good_problem.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// Runs `file` with an output option, checks that the run is refused and writes no file, and returns the
/// message.
std::string refusal(const scratch_folder& dir, const std::string& file, const process_options& options = {}) {
  const auto before = dir.files();
  const finished f =
      contct_program(dir.path(), {"run", file, "--json", "out.json", "--log", "out.log"}, options);
  CHECK(f.exit == 2);
  CHECK(f.out.empty());
  CHECK(std::count(f.err.begin(), f.err.end(), '\n') == 1);
  CHECK(dir.files() == before);
  return f.err;
}

}  // namespace

TEST_CASE("a bad problem file gives exit status 2, one message with line and column, and no output files") {
  const scratch_folder dir;
  dir.write("bad.toml", with("stiffness", "stifness"));
  CHECK_THAT(refusal(dir, "bad.toml"), StartsWith("contct: bad.toml:11:1: contact[1].stifness: found an"));
  dir.write("program.toml", "\x7f" + std::string("ELF\x02\x01\x01\x00", 7) + std::string(1000, '\xfe'));
  CHECK_THAT(refusal(dir, "program.toml"), StartsWith("contct: program.toml:1:") && Contains("not TOML"));
}

TEST_CASE("contct run refuses a missing problem file, a directory and an empty file name") {
  const scratch_folder dir;
  CHECK_THAT(refusal(dir, "missing.toml"), Contains("missing.toml: cannot be read: No such file"));
  CHECK_THAT(refusal(dir, "."), Contains("found a directory"));
  CHECK_THAT(refusal(dir, ""), Contains("cannot be read"));
}

TEST_CASE(
    "if a bad problem is read from standard input, the message names standard input in place of a file") {
  const scratch_folder dir;
  CHECK_THAT(refusal(dir, "-", {"[beam]\nEI = 0\n", {}, false}), StartsWith("contct: standard input:"));
}

TEST_CASE("before contct run solves a problem, it refuses an output file that cannot be written") {
  const scratch_folder dir;
  dir.write("good.toml", good_problem);
  const finished f = contct_program(dir.path(), {"run", "good.toml", "--json", "no/such/place.json"});
  CHECK(f.exit == 2);
  CHECK(f.out.empty());
  CHECK_THAT(f.err, Contains("no/such/place.json"));
  CHECK(dir.files() == std::vector<std::string>{"good.toml"});
}

TEST_CASE("wrong usage of contct gives exit status 2 and a message with the allowed names") {
  const scratch_folder dir;
  dir.write("good.toml", good_problem);
  const auto refused = [&](const std::vector<std::string>& arguments, const char* words) {
    const finished f = contct_program(dir.path(), arguments);
    INFO(f.err);
    CHECK(f.exit == 2);
    CHECK(f.out.empty());
    CHECK_THAT(f.err, Contains(words));
  };
  refused({}, "--help");
  refused({"run", "good.toml", "--kernels", "fortran,basic"}, "fortran-r4");
  refused({"run", "good.toml", "--kernels", "fortran,cpp,fortran"}, "named twice");
  // This message must come before the error that unit 26 is already open.
  for (const char* pair : {"fortran,fortran-r4", "fortran-r4,fortran", "cpp,fortran-r4", "cpp-r4,fortran"})
    refused(
        {"run", "good.toml", "--kernels", pair},
        "-byte REAL, the 1989 rule) differ in precision and cannot be equal to the bit; compare them with "
        "--free-run");
  refused({"run", "good.toml", "--engine", "warp"}, "no engine is named \"warp\"; allowed: auto, refactor, ");
  refused({"run", "good.toml", "--max-increments", "0"}, "--max-increments: Value 0 not in range");
  refused({"run", "good.toml", "--json", "-", "--log", "-"}, "cannot both be -");
  CHECK(dir.files() == std::vector<std::string>{"good.toml"});
}
