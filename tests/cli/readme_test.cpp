// What the README shows is what the program does.
#include <fstream>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "cli/process.hpp"

using namespace contct;

namespace {

const std::filesystem::path root = CONTCT_ROOT;

std::string readme() {
  std::ostringstream text;
  text << std::ifstream(root / "README.md").rdbuf();
  return text.str();
}

/// What stands between `from` and `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  REQUIRE(begin != std::string::npos);
  const std::size_t end = text.find(to, begin + from.size());
  REQUIRE(end != std::string::npos);
  return text.substr(begin + from.size(), end - begin - from.size());
}

}  // namespace

TEST_CASE("the README's run is a real run") {
  const std::string problem = "reference/problems/pb07-three-gap-supports.toml";
  const std::string shown = between(readme(), "$ build/release/contct run " + problem + "\n", "```");
  const finished f = contct_program(root, {"run", problem});
  CHECK(f.exit == 0);
  CHECK(shown == f.out);
}

TEST_CASE("the README's problem can be run") {
  const scratch_directory dir;
  dir.write("own.toml", between(readme(), "```toml\n", "```"));
  CHECK(contct_program(dir.path(), {"run", "own.toml"}).exit == 0);
}
