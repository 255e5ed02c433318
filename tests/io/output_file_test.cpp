#include "contct/io/output_file.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "catch.hpp"

using namespace contct;
namespace fs = std::filesystem;

namespace {

/// A directory of the test's own, gone afterwards.
struct scratch {
  fs::path path = fs::temp_directory_path() / ("contct-output-test-" + std::to_string(::getpid()));
  scratch() { fs::create_directories(path); }
  ~scratch() { fs::remove_all(path); }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

std::string contents(const fs::path& p) {
  std::ostringstream text;
  text << std::ifstream(p).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a file appears when it is finished, and not before") {
  const scratch dir;
  const fs::path f = dir.path / "out.json";
  {
    output_file out(f.string());
    out.write("half");
    CHECK_FALSE(fs::exists(f));
    out.write(" and half");
    out.finish();
    CHECK(contents(f) == "half and half");
  }
  CHECK(dir.files() == 1);
}

TEST_CASE("what is not finished leaves nothing, and an older file stays as it was") {
  const scratch dir;
  const fs::path f = dir.path / "out.json";
  std::ofstream(f) << "old";
  {
    output_file out(f.string());
    out.write("new");
  }
  CHECK(contents(f) == "old");
  CHECK(dir.files() == 1);
}

TEST_CASE("a place that cannot be written is refused at once, by name") {
  CHECK_THROWS_WITH(output_file("/no/such/place/out.json"),
                    Catch::Matchers::Contains("/no/such/place/out.json"));
  const scratch dir;
  CHECK_THROWS_AS(output_file(dir.path.string()), output_error);
}

TEST_CASE("a device is written directly") {
  output_file out("/dev/null");
  out.write("gone");
  CHECK_NOTHROW(out.finish());
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a full device is an error, not a short file") {
  output_file out("/dev/full");
  CHECK_THROWS_AS((out.write(std::string(1 << 20, 'x')), out.finish()), output_error);
}
