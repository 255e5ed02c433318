// Tests cpp/run.sh, which builds in its project and runs in the caller's folder. In these tests
// a cmake without effect replaces the build, and build/release has a link to the built program.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/bad_inputs.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
namespace fs = std::filesystem;

namespace {

/// A project folder with links to the scripts and the built program.
class built_project {
 public:
  built_project() {
    fs::create_directories(root() / "cpp");
    fs::create_directories(root() / "build/release");
    fs::create_directories(root() / "reference");
    fs::create_directories(dir_.path() / "tools");
    for (const char* script : {"cpp/run.sh", "cpp/install.sh"})
      fs::copy_file(fs::path(CONTCT_ROOT) / script, root() / script);
    fs::create_directory_symlink(fs::path(CONTCT_ROOT) / "reference/problems", root() / "reference/problems");
    fs::create_symlink(CONTCT_PROGRAM, root() / "build/release/contct");
    tool("cmake", "test -f cpp/run.sh");  // fails in any folder other than the project's
    tool("dpkg-query", "echo install ok installed");
  }

  [[nodiscard]] fs::path root() const { return dir_.path() / "the project"; }

  /// Puts a program of this name first in PATH.
  void tool(const std::string& name, const std::string& does) const {
    const std::string path = "tools/" + name;
    dir_.write(path, "#!/bin/sh\n" + does + "\n");
    fs::permissions(dir_.path() / path, fs::perms::owner_all);
  }

  /// Runs `sh .../cpp/run.sh ARGUMENTS` in `folder`, and returns its exit status and its output.
  [[nodiscard]] std::pair<int, std::string> run(const fs::path& folder, const std::string& arguments) const {
    const std::string out = (dir_.path() / "out").string();
    const std::string line = "cd '" + folder.string() + "' && PATH='" + (dir_.path() / "tools").string() +
                             ":/usr/bin:/bin' CDPATH=/tmp sh '" + (root() / "cpp/run.sh").string() + "' " +
                             arguments + " >'" + out + "' 2>&1";
    const int status = std::system(line.c_str());  // NOLINT: a shell is what is tested
    return {status, dir_.read("out")};
  }

 private:
  scratch_folder dir_;
};

}  // namespace

TEST_CASE("cpp/run.sh takes file names relative to the folder in which it is called") {
  const built_project project;
  const scratch_folder elsewhere;
  elsewhere.write("my own.toml", good_problem);
  const auto [status, out] = project.run(elsewhere.path(), "run 'my own.toml' --json out.json");
  INFO(out);
  CHECK(status == 0);
  CHECK_THAT(out, Contains("equal to the bit"));
  CHECK(elsewhere.files() == std::vector<std::string>{"my own.toml", "out.json"});
}

TEST_CASE("cpp/run.sh without arguments runs the reference problem PB7, whatever the current folder is") {
  const built_project project;
  const scratch_folder elsewhere;
  const auto [at_home, shown] = project.run(project.root(), "");
  CHECK(at_home == 0);
  CHECK_THAT(shown, Contains("building in build/release\n"
                             "build/release/contct run reference/problems/pb07-three-gap-supports.toml\n"
                             "\n"
                             "PB7  Simply supported beam over three gap supports\n"));
  const auto [status, out] = project.run(elsewhere.path(), "");
  INFO(out);
  CHECK(status == 0);
  const std::string root = fs::canonical(project.root()).string();
  CHECK_THAT(out, Contains(root + "/build/release/contct run " + root + "/reference/problems/pb07"));
  CHECK_THAT(
      out,
      EndsWith(
          "8 calls, 64 values compared, 0 mismatches\n"
          "the 1989 rule comes to the same states: every number agrees to 10 digits or more\n"
          "all 4 final states are certified for this mesh\nproved: 10 digits or more of every number\n"));
}

TEST_CASE(
    "cpp/run.sh returns the program's exit status, and prints the last messages of a build that fails") {
  const built_project project;
  const scratch_folder elsewhere;
  CHECK(WEXITSTATUS(project.run(elsewhere.path(), "run missing.toml").first) == 2);
  project.tool("cmake", "echo no compiler is found; exit 1");
  const auto [status, out] = project.run(elsewhere.path(), "kernels");
  CHECK(WEXITSTATUS(status) == 1);
  CHECK_THAT(out, EndsWith("no compiler is found\n"));
}
