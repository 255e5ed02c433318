// Tests that the examples in README.md and the trace in trace-format.md are the program's real output.
#include <fstream>
#include <sstream>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;

namespace {

std::string page(const char* name) {
  std::ostringstream text;
  text << std::ifstream(root / name).rdbuf();
  return text.str();
}

std::string readme() {
  return page("README.md");
}

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  REQUIRE(begin != std::string::npos);
  const std::size_t end = text.find(to, begin + from.size());
  REQUIRE(end != std::string::npos);
  return text.substr(begin + from.size(), end - begin - from.size());
}

}  // namespace

TEST_CASE("README.md shows the output that the program prints for the same run") {
  const std::string problem = "reference/problems/pb07-three-gap-supports.toml";
  const std::string shown = between(readme(), "$ build/release/contct run " + problem + "\n", "```");
  const finished f = contct_program(root, {"run", problem});
  CHECK(f.exit == 0);
  CHECK(shown == f.out);
}

TEST_CASE("the beam in README.md runs, and has an event") {
  const std::string text = readme();
  int problems = 0;
  for (std::size_t at = text.find("```toml\n"); at != std::string::npos;
       at = text.find("```toml\n", at + 1)) {
    const scratch_folder dir;
    dir.write("own.toml", between(text.substr(at), "```toml\n", "```"));
    const finished f = contct_program(dir.path(), {"run", "own.toml"});
    INFO(f.out << f.err);
    CHECK(f.exit == 0);
    CHECK_THAT(f.out, Catch::Matchers::Contains("make 1:") || Catch::Matchers::Contains("break 1:"));
    ++problems;
  }
  CHECK(problems == 1);
}

TEST_CASE("README.md cites the program with the name, version and checksum that contct --version prints") {
  const std::string cited = between(readme(), "@software{contct,", "```");
  const finished f = contct_program(root, {"--version"});
  const std::string version = between(f.out, "contct ", "\n");
  const std::string checksum = between(f.out + "\n", "listing sha256 ", "\n");
  CHECK(checksum.size() == 64);
  CHECK_THAT(cited, Catch::Matchers::Contains("{" + version + "}"));
  CHECK_THAT(cited, Catch::Matchers::Contains("Listing SHA-256 " + checksum + "}"));
}

TEST_CASE("the trace in trace-format.md is valid, and the FORTRAN and C++ kernels give its answers") {
  process_options shown;
  shown.input = between(page("reference/trace-format.md"), "```trace\n", "```");
  const finished f = contct_program(root, {"replay", "--kernel", "fortran,cpp", "-"}, shown);
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Catch::Matchers::Contains("1 call, ") && Catch::Matchers::Contains("2 passed, 0 failed"));
}
