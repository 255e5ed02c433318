// Tests that output files appear complete or not at all, however the process ends.
#include "contct/text/output_file.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "catch.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
namespace fs = std::filesystem;

TEST_CASE("an output file appears only when it is finished") {
  const scratch_folder dir;
  output_file out(dir.at("out.json"));
  out.write("half");
  CHECK(dir.files().empty());
  out.write(" and half" + std::string(200000, '.'));
  out.finish();
  CHECK(dir.read("out.json") == "half and half" + std::string(200000, '.'));
  CHECK(dir.files().size() == 1);
}

TEST_CASE("a new output file has the permissions that the umask allows") {
  const scratch_folder dir;
  const mode_t before = umask(0027);
  for (int time = 0; time < 2; ++time) {  // first made, then replaced
    output_file out(dir.at("out.json"));
    out.finish();
    struct stat s {};
    REQUIRE(stat(dir.at("out.json").c_str(), &s) == 0);
    CHECK((s.st_mode & 0777U) == 0640U);
  }
  umask(before);
}

TEST_CASE("an existing output file is replaced in one operation, so it is always complete") {
  const scratch_folder dir;
  dir.write("out.json", "old");
  output_file out(dir.at("out.json"));
  out.write("new");
  CHECK(dir.read("out.json") == "old");
  out.finish();
  CHECK(dir.read("out.json") == "new");
  CHECK(dir.files().size() == 1);
}

TEST_CASE("if an output file is not finished, an older file with the same name stays unchanged") {
  const scratch_folder dir;
  dir.write("out.json", "old");
  {
    output_file out(dir.at("out.json"));
    out.write("new");
  }
  CHECK(dir.read("out.json") == "old");
  CHECK(dir.files().size() == 1);
}

TEST_CASE("if a signal ends the process, no unfinished output file remains") {
  for (const int sign : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGKILL}) {
    const scratch_folder dir;
    const pid_t child = fork();
    if (child == 0) {
      (void)std::signal(sign, SIG_DFL);
      output_file out(dir.at("out.json"));
      out.write(std::string(100000, 'x'));
      (void)raise(sign);
      _exit(1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    CHECK(dir.files().empty());
  }
}

TEST_CASE("an output whose name is a symbolic link is written to the target, whether this exists or not") {
  const scratch_folder dir;
  fs::create_directory(dir.path() / "there");
  fs::create_symlink("there/out.json", dir.path() / "link");  // relative to the link's folder
  for (const char* text : {"first", "second"}) {
    output_file out(dir.at("link"));
    out.write(text);
    out.finish();
    CHECK(fs::is_symlink(dir.path() / "link"));
    CHECK(dir.read("there/out.json") == text);
  }
}

TEST_CASE("an output is refused if its name is a symbolic link in a circle of links") {
  const scratch_folder dir;
  fs::create_symlink("b", dir.path() / "a");
  fs::create_symlink("a", dir.path() / "b");
  CHECK_THROWS_WITH(output_file(dir.at("a")), Catch::Matchers::Contains("cannot be written"));
}

TEST_CASE("two names of one file are recognised as the same file") {
  const scratch_folder dir;
  const auto at = [&](const char* name) { return dir.at(name); };
  dir.write("old", "old");
  fs::create_directory(at("folder"));
  fs::create_symlink("old", at("to-old"));
  fs::create_symlink("new", at("to-new"));
  fs::create_hard_link(at("old"), at("hard"));
  CHECK(same_file(at("old"), at("folder/../old")));
  CHECK(same_file(at("old"), at("to-old")));
  CHECK(same_file(at("old"), at("hard")));
  CHECK(same_file(at("new"), at("folder/../new")));  // the file does not exist yet
  CHECK(same_file(at("to-new"), at("new")));
  CHECK_FALSE(same_file(at("old"), at("new")));
  CHECK_FALSE(same_file(at("new"), at("old")));
  CHECK_FALSE(same_file(at("new"), at("newer")));
  CHECK_FALSE(same_file("/dev/null", "/dev/null"));  // two outputs may go to a device
}

TEST_CASE("an output file that cannot be written is refused at once, and the message names the file") {
  CHECK_THROWS_WITH(output_file("/no/such/place/out.json"),
                    Catch::Matchers::Contains("/no/such/place/out.json"));
  const scratch_folder dir;
  CHECK_THROWS_AS(output_file(dir.path().string()), output_error);
}

TEST_CASE("an output to a device is written to the device without a temporary file") {
  output_file out("/dev/null");
  out.write("gone");
  CHECK_NOTHROW(out.finish());
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("an output to a full device throws output_error") {
  output_file out("/dev/full");
  CHECK_THROWS_AS((out.write(std::string(1 << 20, 'x')), out.finish()), output_error);
}
