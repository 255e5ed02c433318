// Tests input files as text, lines, fields and numbers, and that output files appear complete or not at all.
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <limits>

#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/output_file.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
namespace fs = std::filesystem;

TEST_CASE("an input file is read completely, whatever its bytes are") {
  const scratch_folder here;
  CHECK(read_input(here.write("empty", "")).empty());
  std::string all;
  for (int i = 0; i < 200'000; ++i) all += static_cast<char>(i % 256);  // more than one block
  CHECK(read_input(here.write("all", all)) == all);
}

TEST_CASE("a missing file, a folder and a file that is too large are refused, and the message has the name") {
  const scratch_folder here;
  CHECK_THROWS_WITH(read_input(here.at("none")), Contains("none: cannot be read: No such file"));
  CHECK_THROWS_WITH(read_input(here.path().string(), "mesh"),
                    Contains(": found a directory; allowed: a mesh"));
  const std::string large = here.write("large", "");
  std::filesystem::resize_file(large, (1 << 20) - 1);
  CHECK(read_input(large, "mesh", 1).size() == (1 << 20) - 1);
  std::filesystem::resize_file(large, 1 << 20);
  CHECK_THROWS_WITH(read_input(large, "mesh", 1),
                    Contains("large: found 1 MiB or more; allowed: a mesh of less than 1 MiB"));
}

TEST_CASE("an error message names the file and the line, or only the file") {
  CHECK_THROWS_WITH(refuse_line("K.mtx", 12, "x", "y"), "K.mtx:12: found x; allowed: y");
  CHECK_THROWS_WITH(refuse_line("K.mtx", 0, "x", "y"), "K.mtx: found x; allowed: y");
  CHECK_THROWS_AS(refuse_line("K.mtx", 1, "", ""), input_error);
}

TEST_CASE("text is split into lines at line feeds, and empty lines are counted") {
  text_lines lines("one\n\n three \r\nlast", "f");
  CHECK(lines.line() == 0);
  std::vector<std::string> found;
  while (lines.next()) found.emplace_back(lines.here());
  CHECK(found == std::vector<std::string>{"one", "", " three \r", "last"});
  CHECK(lines.line() == 4);
  CHECK(lines.rest().empty());
  CHECK_FALSE(text_lines("", "f").next());
}

TEST_CASE("if the last line has no line end, the file is refused as cut off") {
  text_lines lines("one\n2", "f");
  REQUIRE(lines.next());
  CHECK_NOTHROW(lines.refuse_unended());
  REQUIRE(lines.next());
  CHECK_THROWS_WITH(lines.refuse_unended(), Contains("f:2: found \"2\" without a line end"));
}

TEST_CASE("any blanks separate the fields of a line, and blank lines are skipped but counted") {
  field_lines lines("\n  a\tb  c\r\n \v\f\n1 2 3 4 5 6 7 8 9 10\n", "f");
  REQUIRE(lines.next());
  CHECK(lines.line() == 2);
  REQUIRE(lines.fields() == 3);
  CHECK(lines.field(0) == "a");
  CHECK(lines.field(2) == "c");
  CHECK_NOTHROW(lines.expect(3, "three"));
  CHECK_THROWS_WITH(lines.expect(2, "two"), Contains("f:2: found a line of 9 bytes; allowed: two"));
  REQUIRE(lines.next());
  CHECK(lines.line() == 4);
  CHECK(lines.fields() == 10);
  CHECK_FALSE(lines.next());
  CHECK(lines.fields() == 0);
}

TEST_CASE("a line of fields without a line end is refused, but blanks after the last line end are accepted") {
  field_lines cut("1 2\n3 4", "f");
  REQUIRE(cut.next());
  CHECK_THROWS_WITH(cut.next(), Contains("f:2: found \"3 4\" without a line end"));
  field_lines whole("1 2\n  ", "f");
  REQUIRE(whole.next());
  CHECK_FALSE(whole.next());
}

TEST_CASE("a whole number is read if it is in a given range, with or without a plus sign") {
  field_lines lines("+7 -3 8 7.0 7x +-7 99999999999999999999\n", "f");
  REQUIRE(lines.next());
  CHECK(lines.whole(0, -3, 7, "n") == 7);
  CHECK(lines.whole(1, -3, 7, "n") == -3);
  for (const std::size_t i : {2, 3, 4, 5, 6}) {
    INFO(lines.field(i));
    CHECK_THROWS_WITH(lines.whole(i, -3, 7, "n"), Contains("f:1: found \"" + std::string(lines.field(i)) +
                                                           "\" for n; allowed: a whole number from -3 to 7"));
  }
}

TEST_CASE("a real number must be a finite decimal, and FORTRAN's exponent D is accepted only on request") {
  field_lines lines("+1.5 -2e-3 .5 5. nan inf 1e999 1,5 0x1p3 1D0 +-1 +\n", "f");
  REQUIRE(lines.next());
  for (const auto& [i, x] : {std::pair(0, 1.5), {1, -2e-3}, {2, 0.5}, {3, 5.0}})
    CHECK(lines.real(i, "x") == x);
  for (std::size_t i = 4; i < lines.fields(); ++i)
    CHECK_THROWS_WITH(lines.real(i, "x"), Contains("for x; allowed: a finite number"));
  CHECK(lines.text_lines::real("-1.5D+01", "x", true) == -15.0);
  CHECK(lines.text_lines::real("+2d1", "x", true) == 20.0);
  CHECK_THROWS_WITH(lines.text_lines::real("1D999", "x", true), Contains("\"1D999\" for x"));
}

TEST_CASE("a text is read as a number only if the whole text is a number") {
  CHECK(number_in<int>("-12") == -12);
  CHECK(number_in<double>("1e3") == 1000.0);
  CHECK(number_in<double>("1.8p1", std::chars_format::hex) == 3.0);
  CHECK(number_in<double>("inf") == std::numeric_limits<double>::infinity());
  for (const char* text : {"", " 1", "1 ", "+1", "1x", "99999999999"}) {
    INFO(text);
    CHECK_FALSE(number_in<int>(text).has_value());
  }
}

TEST_CASE("a finished output file appears in one operation, and an unfinished one not at all") {
  for (const std::string older : {"", "old"}) {
    const scratch_folder dir;
    if (!older.empty()) dir.write("out.json", older);
    {
      output_file unfinished(dir.at("out.json"));
      unfinished.write("new");
    }
    CHECK(dir.read("out.json") == older);
    output_file out(dir.at("out.json"));
    out.write("half");
    CHECK(dir.files().size() == (older.empty() ? 0 : 1));
    CHECK(dir.read("out.json") == older);
    out.write(" and half" + std::string(200000, '.'));
    out.finish();
    CHECK(dir.read("out.json") == "half and half" + std::string(200000, '.'));
    CHECK(dir.files().size() == 1);
  }
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

TEST_CASE("two names of one file are recognised as the same file") {
  const scratch_folder dir;
  const auto at = [&](const char* name) { return dir.at(name); };
  dir.write("old", "old");
  fs::create_directory(at("folder"));
  fs::create_symlink("old", at("to-old"));
  fs::create_symlink("new", at("to-new"));
  fs::create_hard_link(at("old"), at("hard"));
  const auto pairs = std::vector<std::pair<const char*, const char*>>{
      {"old", "folder/../old"}, {"old", "to-old"}, {"old", "hard"}, {"to-new", "new"}};
  for (const auto& [a, b] : pairs) CHECK(same_file(at(a), at(b)));
  CHECK(same_file(at("new"), at("folder/../new")));  // the file does not exist yet
  CHECK_FALSE(same_file(at("old"), at("new")));
  CHECK_FALSE(same_file(at("new"), at("old")));
  CHECK_FALSE(same_file(at("new"), at("newer")));
  CHECK_FALSE(same_file("/dev/null", "/dev/null"));  // two outputs may go to a device
}

TEST_CASE("an output file that cannot be written is refused at once, and the message names the file") {
  CHECK_THROWS_WITH(output_file("/no/such/place/out.json"), Contains("/no/such/place/out.json"));
  const scratch_folder dir;
  CHECK_THROWS_AS(output_file(dir.path().string()), output_error);
  fs::create_symlink("b", dir.path() / "a");  // a circle of links
  fs::create_symlink("a", dir.path() / "b");
  CHECK_THROWS_WITH(output_file(dir.at("a")), Contains("cannot be written"));
}

TEST_CASE("an output to a device has no temporary file, and throws if the device is full") {
  output_file out("/dev/null"), full("/dev/full");
  out.write("gone");
  CHECK_NOTHROW(out.finish());
  CHECK(fs::is_character_file("/dev/null"));
  CHECK_THROWS_AS((full.write(std::string(1 << 20, 'x')), full.finish()), output_error);
}
