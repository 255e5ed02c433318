// Tests the help texts, the suggestions for misspelt words, and `contct new`.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

using words = std::vector<std::string>;

words split(const std::string& text, char at) {
  words parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

/// Returns the commands that `contct --help` lists.
words commands() {
  const std::string help = contct_program(".", {"--help"}).out;
  const std::size_t from = help.find("Subcommands:\n");
  REQUIRE(from != std::string::npos);
  words names;
  for (const std::string& line : split(help.substr(from, help.find("\n\n", from) - from), '\n'))
    if (line.rfind("  ", 0) == 0) names.push_back(line.substr(2, line.find(' ', 2) - 2));
  return names;
}

/// Returns the command lines under "Examples:", each as a list of arguments.
std::vector<words> examples_in(const std::string& help) {
  const std::size_t from = help.find("Examples:\n");
  REQUIRE(from != std::string::npos);
  std::vector<words> found;
  for (const std::string& line : split(help.substr(from), '\n')) {
    if (line.rfind("  contct ", 0) != 0) continue;
    words arguments = split(line, ' ');
    arguments.erase(arguments.begin());
    found.push_back(arguments);
  }
  return found;
}

/// Writes the files that the examples name.
void prepare(const scratch_folder& dir, bool with_problems) {
  if (!with_problems) return;
  REQUIRE(contct_program(dir.path(), {"new", "beam", "beam.toml"}).exit == 0);
  REQUIRE(contct_program(dir.path(), {"run", "beam.toml", "--quiet", "--trace", "calls.trace"}).exit == 0);
  fs::create_symlink(CONTCT_PLUGINS "/libvariant_right.so", dir.path() / "mine.so");
  fs::create_symlink(root / "reference/benchmarks/calculix.json", dir.path() / "theirs.json");
}

}  // namespace

TEST_CASE("every command has help with examples, and every example runs as it is printed") {
  const words all = commands();
  CHECK(all.size() >= 9);
  std::size_t run = 0;
  for (const std::string& command : all) {
    const finished help = contct_program(".", {command, "--help"});
    INFO(command);
    CHECK(help.exit == 0);
    CHECK(help.err.empty());
    const auto examples = examples_in(help.out);
    CHECK_FALSE(examples.empty());
    for (const words& arguments : examples) {
      if (command == "prove")
        continue;  // tests/prove runs these examples, which take a minute and fail with sanitizers
      CHECK(arguments.at(0) == command);
      const scratch_folder dir;
      prepare(dir, command != "new");
      const finished f = contct_program(dir.path(), arguments);
      std::string line = "contct";
      for (const std::string& a : arguments) line += " " + a;
      INFO(line << "\n" << f.out << f.err);
      CHECK(f.exit == 0);
      ++run;
    }
  }
  CHECK(run >= 15);
  const finished help = contct_program(".", {"--help"});
  CHECK(help.exit == 0);
  CHECK(examples_in(help.out).size() == all.size());
}

TEST_CASE(
    "a problem file from contct new has events and certified states, and its comments name every table of "
    "the format") {
  for (const char* shape : {"beam", "plate"}) {
    const scratch_folder dir;
    INFO(shape);
    const finished made = contct_program(dir.path(), {"new", shape});
    const std::string name = std::string(shape) + ".toml";
    CHECK(made.exit == 0);
    CHECK_THAT(made.out,
               Contains(name + " is written; next: contct run " + name + " --strict --html report.html"));
    CHECK(dir.files() == words{name});
    const std::string text = dir.read(name);
    for (const char* piece : {"[[support]]", "[[contact]]", "[[bed]]", "[[step]]", "positive up"})
      CHECK_THAT(text, Contains(piece));
    const finished f = contct_program(dir.path(), {"run", name, "--strict", "--json", "out.json"});
    INFO(f.out << f.err);
    CHECK(f.exit == 0);
    CHECK(f.err.empty());
    CHECK_THAT(f.out, Contains("make ") && Contains("break ") && Contains("are certified"));
    const auto result = nlohmann::json::parse(dir.read("out.json"));
    REQUIRE(result["steps"].size() == 2);
    for (const auto& step : result["steps"]) CHECK(step["certificate"]["exact"] == true);
  }
}

TEST_CASE("a file from contct new still runs if its commented-out lines are activated") {
  for (const char* shape : {"beam", "plate"}) {
    const scratch_folder dir;
    std::string text = contct_program(dir.path(), {"new", shape, "-"}).out;
    int put_in = 0;
    for (const char* piece :
         {"# [[", "# spring", "# nodes", "# at", "# fix", "# modulus", "# face", "# settlement"}) {
      for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at)) {
        text.erase(at, 2);
        ++put_in;
      }
    }
    CHECK(put_in >= 3);
    dir.write("own.toml", text);
    const finished f = contct_program(dir.path(), {"run", "own.toml"});
    INFO(text << f.out << f.err);
    CHECK(f.exit == 0);
  }
}

TEST_CASE("contct new overwrites no file and no symbolic link, even if the link's target is missing") {
  const scratch_folder dir;
  dir.write("beam.toml", "mine");
  fs::create_symlink("nowhere", dir.path() / "link.toml");
  for (const char* file : {"beam.toml", "link.toml", "."}) {
    const finished f = contct_program(dir.path(), {"new", "beam", file});
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, Contains("which exists already"));
  }
  CHECK(contct_program(dir.path(), {"new", "beam"}).exit == 2);
  CHECK(dir.read("beam.toml") == "mine");
  CHECK(dir.files() == words{"beam.toml", "link.toml"});
  CHECK(contct_program(dir.path(), {"new", "beam", "no/such/folder.toml"}).exit == 2);
  CHECK_THAT(contct_program(dir.path(), {"new", "crene"}).err,
             Contains("KIND: found crene (did you mean \"crane\"?); allowed: beam, plate, crane, slab"));
}
