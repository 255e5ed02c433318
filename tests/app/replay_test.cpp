// Tests `contct run --trace`, `contct replay` and contct-replay.
#include <algorithm>
#include <filesystem>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

std::string reference_problem(const char* name) {
  return (root / "reference/problems" / name).string();
}

/// Records a problem's path as t.trace in `dir`, and returns the trace.
std::string recorded(const scratch_folder& dir, const char* problem) {
  const finished f =
      contct_program(dir.path(), {"run", reference_problem(problem), "--trace", "t.trace", "--quiet"});
  INFO(f.err);
  REQUIRE(f.exit == 0);
  CHECK(f.out.empty());
  return dir.read("t.trace");
}

}  // namespace

TEST_CASE("FORTRAN and C++ replay a recorded path, and their answers are equal to the bit") {
  const scratch_folder dir;
  const std::string trace = recorded(dir, "pb07-three-gap-supports.toml");
  CHECK_THAT(trace, Contains("\nlapack LAPACK ") && Contains("\nfloating-point strict\n"));
  const finished f = contct_program(dir.path(), {"replay", "t.trace", "--kernel", "fortran,cpp"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.out,
             Contains("t.trace: fortran: equal to the bit; 8 calls, 64 values compared, 0 mismatches"));
  CHECK_THAT(f.out, Contains("t.trace: cpp: equal to the bit"));
  const finished piped = contct_program(dir.path(), {"replay", "-"}, {.input = trace, .environment = {}});
  CHECK(piped.exit == 0);
  CHECK_THAT(piped.out, Contains("standard input: fortran: equal"));
}

TEST_CASE("contct replay refuses a kernel whose precision is not that of the trace") {
  const scratch_folder dir;
  recorded(dir, "pb01-cantilever-tip-stop.toml");
  const finished f = contct_program(dir.path(), {"replay", "t.trace", "--kernel", "cpp-r4"});
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("nothing was compared"));
  CHECK_THAT(f.out, Contains("skipped: recorded with 8-byte REAL and the 1989 rule"));
}

TEST_CASE(
    "if a trace has a changed answer, contct replay reports a mismatch and its branch margin, with exit "
    "status 1") {
  const scratch_folder dir;
  std::string trace = recorded(dir, "pb01-cantilever-tip-stop.toml");
  const std::size_t at = trace.find("MAKING");
  REQUIRE(at != std::string::npos);
  trace[at] = 'N';
  dir.write("d.trace", trace);
  const finished f =
      contct_program(dir.path(), {"replay", "d.trace", "--junit", "r.xml", "--markdown", "r.md"});
  CHECK(f.exit == 1);
  CHECK_THAT(f.err, Contains("differs in text, line 1") && Contains("branch margin: "));
  CHECK_THAT(f.out, Contains("mismatch; 6 calls, 24 values compared, 1 mismatch"));
  const std::string both =
      shell(std::string(CONTCT_PROGRAM) + " replay " + (dir.path() / "d.trace").string() + " 2>&1").out;
  CHECK(both.find("mismatch; 6 calls") < both.find("differs in text"));  // the result, then the messages
  CHECK_THAT(dir.read("r.xml"), Contains("failures=\"1\""));
  CHECK_THAT(dir.read("r.md"), Contains("## contct replay: failed"));
}

TEST_CASE("contct replay of all reference traces names the line at fault in a kernel and the known fault") {
  std::vector<std::string> arguments = {
      "replay", "--quiet", "--kernel", "plugin:" + std::string(CONTCT_PLUGINS) + "/libvariant_less_equal.so"};
  std::vector<std::string> traces;
  for (const auto& entry : fs::directory_iterator(root / "reference/traces"))
    traces.push_back(entry.path().string());
  std::sort(traces.begin(), traces.end());
  arguments.insert(arguments.end(), traces.begin(), traces.end());
  const scratch_folder dir;
  arguments.insert(arguments.end(), {"--report", (dir.path() / "r.json").string()});
  const finished f = contct_program(root, arguments);
  CHECK(f.exit == 1);
  const std::string report = dir.read("r.json");
  CHECK_THAT(report,
             Contains(R"("at_fault": { "line": 52, "statement": "IF (DIFF.LT.EPSMUL) THEN", "explained": )"));
  CHECK_THAT(f.err, Contains("at fault: line 52, IF (DIFF.LT.EPSMUL) THEN: explains all"));
  CHECK_THAT(f.err, Contains("known fault: A DIFF of exactly EPSMUL is not toggled: DIFF < EPSMUL, not <=."));
}

TEST_CASE("contct replay refuses a file that is not a trace, and the message names the file") {
  const scratch_folder dir;
  dir.write("empty.trace", "");
  dir.write("header.trace", "contct-trace-1 2026-11-21\nkernel fortran\n");
  CHECK_THAT(contct_program(dir.path(), {"replay", "empty.trace"}).err,
             Contains("empty.trace: found the end of the text"));
  const finished f = contct_program(dir.path(), {"replay", "header.trace"});
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("found no call"));
  CHECK(contct_program(dir.path(), {"replay", "missing.trace"}).exit == 2);
  CHECK(contct_program(dir.path(), {"replay"}).exit == 2);
}

TEST_CASE("contct-replay prints the same as contct replay, but is not linked with LAPACK or BLAS") {
  const scratch_folder dir;
  recorded(dir, "pb07-three-gap-supports.toml");
  const std::string program = (fs::path(CONTCT_PROGRAM).parent_path() / "contct-replay").string();
  const std::string out = shell(program + " " + (dir.path() / "t.trace").string()).out;
  const finished f = contct_program(dir.path(), {"replay", (dir.path() / "t.trace").string()});
  CHECK(out == f.out);
  const std::string libraries = shell("ldd " + program).out;
  CHECK_THAT(libraries, Contains("libc.so") && !Contains("lapack") && !Contains("blas"));
  // For a program that is linked with LAPACK, ldd does name LAPACK.
  CHECK_THAT(shell("ldd " + std::string(CONTCT_PROGRAM)).out, Contains("lapack"));
}

TEST_CASE(
    "the JUnit report of contct run has one test for the kernels, one for the path and one for the "
    "certificate") {
  const scratch_folder dir;
  const finished f =
      contct_program(dir.path(), {"run", reference_problem("pb05-cantilever-over-flat-obstacle.toml"),
                                  "--kernels", "fortran,cpp", "--strict", "--quiet", "--junit", "-"});
  CHECK(f.exit == 3);
  CHECK_THAT(f.out, Contains("tests=\"3\" failures=\"1\"") && Contains("name=\"certificate\"") &&
                        Contains("NOT certified") && Contains("listing sha256"));
}
