// Tests that a problem file may name files below its folder, and others only if this is allowed.
#include <filesystem>
#include <string>

#include "catch.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/input_text.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
namespace fs = std::filesystem;

namespace {

/// Returns the path of the file that `stiffness` names in the problem file `file`.
std::string path_of(const std::string& file, const std::string& name, reach allowed, char quote = '\'') {
  const toml::table document = parse_toml("stiffness = " + (quote + name) + quote + "\n", file);
  return named_files(file, allowed).path_of(toml_value(document, file)["stiffness"]);
}

}  // namespace

TEST_CASE("a named file is relative to the folder of the problem file") {
  CHECK(path_of("a/b/p.toml", "K.mtx", reach::own_folder) == "a/b/K.mtx");
  CHECK(path_of("a/b/p.toml", "c/../K.mtx", reach::own_folder) == "a/b/c/../K.mtx");
  CHECK(path_of("a/b/p.toml", "../K.mtx", reach::anywhere) == "a/b/../K.mtx");
  CHECK(path_of("a/b/p.toml", "/c/K.mtx", reach::anywhere) == "/c/K.mtx");
  CHECK(path_of("p.toml", "K.mtx", reach::own_folder) == "K.mtx");
  CHECK(path_of("p.toml", "-", reach::own_folder) == "./-");  // the name of a file, and not standard input
  CHECK(path_of("standard input", "-", reach::own_folder) == "./-");
}

TEST_CASE(
    "a file outside the problem's folder is refused under any name, and the message names --allow-outside") {
  const scratch_folder here;
  fs::create_directories(here.path() / "own/below");
  fs::create_directories(here.path() / "own-beside");
  here.write("secret", "1\n");
  here.write("own/K.mtx", "1\n");
  here.write("own-beside/K.mtx", "1\n");
  fs::create_symlink("../secret", here.path() / "own/link");
  fs::create_directory_symlink("../..", here.path() / "own/below/up");
  fs::create_symlink("K.mtx", here.path() / "own/inside");
  const std::string file = here.at("own/p.toml");
  for (const std::string& name : std::vector<std::string>{
           "../secret", "/etc/passwd", here.at("secret"), "link", "below/up/secret", "below/../../secret",
           "../own-beside/K.mtx", "none/../../secret", "/proc/self/environ", ".."}) {
    INFO(name);
    CHECK_THROWS_WITH(path_of(file, name, reach::own_folder),
                      Contains("p.toml:1:13: stiffness: found ") &&
                          Contains("which is not below the folder of the problem file; allowed: ") &&
                          Contains("--allow-outside"));
    CHECK_NOTHROW(path_of(file, name, reach::anywhere));
  }
  for (const std::string& name : std::vector<std::string>{"K.mtx", "./K.mtx", "inside", "below/../K.mtx",
                                                          "none", here.at("own/K.mtx"), "../own/K.mtx"}) {
    INFO(name);
    CHECK_NOTHROW(path_of(file, name, reach::own_folder));
  }
}

TEST_CASE("a problem file that is reached through a linked folder may name files in the target of the link") {
  const scratch_folder here;
  fs::create_directories(here.path() / "data");
  fs::create_directory_symlink("data", here.path() / "current");
  here.write("data/K.mtx", "1\n");
  CHECK_NOTHROW(path_of(here.at("current/p.toml"), "K.mtx", reach::own_folder));
  CHECK_NOTHROW(path_of(here.at("current/p.toml"), "../data/K.mtx", reach::own_folder));
  CHECK_THROWS_AS(path_of(here.at("current/p.toml"), "../other", reach::own_folder), input_error);
}

TEST_CASE("a file name that contains a NUL character is refused") {
  for (const reach allowed : {reach::own_folder, reach::anywhere})
    CHECK_THROWS_WITH(path_of("a/p.toml", "K.mtx\\u0000\\tof\\u0000", allowed, '"'),
                      "a/p.toml:1:13: stiffness: found \"K.mtx\\x00\\x09of\\x00\"; allowed: a file name "
                      "without the character \\u0000");
}
