// Tests output files: a run never overwrites its input or another output, never leaves half a file, and
// reports every failure. Also tests the JUnit and Markdown reports.
#include "app/outputs.hpp"

#include <cstdlib>
#include <filesystem>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/bad_inputs.hpp"

using namespace contct;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

using words = std::vector<std::string>;

/// Runs a command that must be refused, checks that no file changed, and returns the message.
std::string refusal(const scratch_folder& dir, const words& arguments, const process_options& options = {}) {
  const auto before = dir.files();
  const finished f = contct_program(dir.path(), arguments, options);
  INFO(f.out << f.err);
  CHECK(f.exit == 2);
  CHECK(f.out.empty());
  CHECK(dir.files() == before);
  return f.err;
}

const check_report two_of_three{
    "contct replay",
    {"floating point: strict"},
    {{"a.trace: cpp", outcome::passed, "equal", ""},
     {"b <&> \"c\".trace: mine", outcome::failed, "1 mismatch | here", "call 1: SS(1)\n\x01 odd"},
     {"c.trace: cpp", outcome::skipped, "another precision", ""}},
    0.5};

}  // namespace

TEST_CASE(
    "no command writes an output over a file that the problem file names, under any path or through a link") {
  const scratch_folder dir;
  fs::copy(root / "reference/structures", dir.path(), fs::copy_options::recursive);
  fs::create_hard_link(dir.path() / "frame.mtx", dir.path() / "hard");
  const std::string before = dir.read("frame.mtx");
  int refused = 0;
  const auto refuse = [&](const words& output, const std::string& problem, const std::string& name) {
    INFO(output[0] << " " << output[1] << " " << name);
    CHECK_THAT(refusal(dir, {output[0], problem, output[1], name}),
               Contains(output[1] + " " + name + ": found the same file as a file that the problem names"));
    ++refused;
  };
  for (const words& output : {words{"run", "--json"},
                              {"run", "--html"},
                              {"run", "--csv"},
                              {"run", "--log"},
                              {"run", "--trace"},
                              {"run", "--proof"},
                              {"run", "--junit"},
                              {"run", "--markdown"},
                              {"explain", "--json"},
                              {"exact", "--json"}})
    refuse(output, "frame.toml", "hard");
  for (const char* file : {"frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"})
    refuse({"run", "--json"}, "frame.toml", file);
  for (const char* file : {"calculix/console.sti", "calculix/console.dof", "calculix/console.inp"})
    refuse({"run", "--json"}, "calculix/console.toml", file);
  CHECK(refused == 17);
  CHECK(dir.read("frame.mtx") == before);
}

TEST_CASE("contct run refuses a table of pairs that would replace a file that the problem file names") {
  const scratch_folder dir;
  dir.write("K.pairs.csv", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 2\n");
  dir.write("p.toml",
            "[matrix]\nstiffness = \"K.pairs.csv\"\n[[step]]\npoint = [ { dof = \"1\", value = 1 } ]\n");
  CHECK_THAT(refusal(dir, {"run", "p.toml", "--csv", "K.csv"}),
             Contains("K.pairs.csv: found the same file as"));
  CHECK_THAT(dir.read("K.pairs.csv"), Contains("MatrixMarket"));
}

TEST_CASE("contct verify refuses to overwrite verification.toml or a reference problem") {
  const scratch_folder dir;
  fs::copy(root / "reference/verification.toml", dir.path());
  fs::copy(root / "reference/problems", dir.path() / "problems", fs::copy_options::recursive);
  for (const std::string file : {"verification.toml", "problems/pb07-three-gap-supports.toml"}) {
    const std::string before = dir.read(file);
    for (const char* option : {"--json", "--junit", "--markdown"})
      CHECK_THAT(refusal(dir, {"verify", "--reference", ".", option, file}),
                 Contains("found the same file as"));
    CHECK(dir.read(file) == before);
  }
}

TEST_CASE("every command refuses an output file with an empty name") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  int refused = 0;
  for (const words& command : {words{"run", "pb.toml", "--json", "--html", "--csv", "--vtu", "--log",
                                     "--trace", "--proof", "--junit", "--markdown"},
                               {"explain", "pb.toml", "--json"},
                               {"exact", "pb.toml", "--json"},
                               {"replay", "none.trace", "--junit", "--markdown"},
                               {"fuzz", "--calls=1", "--json", "--out", "--junit", "--markdown"},
                               {"verify", "--quiet", "--json", "--junit", "--markdown"}}) {
    for (std::size_t i = 2; i < command.size(); ++i) {
      const words given = {command[0], command[1], command[i], ""};
      CHECK_THAT(refusal(dir, given), Contains(command[i] + ": found an empty name; allowed: a file name"));
      CHECK_THAT(refusal(dir, {command[0], command[1], command[i] + "="}), Contains(command[i] + ": "));
      ++refused;
    }
  }
  CHECK(refused == 20);
}

TEST_CASE(
    "contct run refuses two outputs in the same file, even if the options name the file by different paths") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  fs::create_symlink("out", dir.path() / "link");
  fs::create_directory(dir.path() / "folder");
  for (const char* log : {"out", "./out", "folder/../out", "link"}) {
    INFO(log);
    CHECK_THAT(refusal(dir, {"run", "pb.toml", "--json", "out", "--log", log}),
               Contains(std::string("--log ") + log + ": found the same file as --json"));
  }
  CHECK(contct_program(dir.path(), {"run", "pb.toml", "--json", "/dev/null", "--log", "/dev/null"}).exit ==
        0);
}

TEST_CASE("contct run refuses to write an output over its problem file, also through a link") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  fs::create_symlink("pb.toml", dir.path() / "link");
  fs::create_hard_link(dir.path() / "pb.toml", dir.path() / "hard");
  for (const char* out : {"pb.toml", "link", "hard"}) {
    INFO(out);
    CHECK_THAT(refusal(dir, {"run", "pb.toml", "--json", out}), Contains("the same file as the problem"));
    CHECK_THAT(refusal(dir, {"run", "link", "--log", out}), Contains("the same file as the problem"));
  }
  CHECK(dir.read("pb.toml") == good_problem);
}

TEST_CASE(
    "an output file is refused if standard output is redirected to it, and the message suggests the name -") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  dir.write("out", "");
  CHECK_THAT(
      refusal(dir, {"run", "pb.toml", "--json", "out"}, {"", {}, false, (dir.path() / "out").string()}),
      Contains("the same file as standard output"));
}

TEST_CASE("contct run writes an output whose name is a symbolic link to the target of the link") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  fs::create_symlink("target", dir.path() / "link");
  for (int time = 0; time < 2; ++time) {
    CHECK(contct_program(dir.path(), {"run", "pb.toml", "--json", "link"}).exit == 0);
    CHECK(fs::is_symlink(dir.path() / "link"));
    CHECK_THAT(dir.read("target"), Contains("contct-result-1"));
  }
}

TEST_CASE("if standard output is full or closed, contct run writes the output files, and has exit status 2") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  for (const words& arguments : {words{"run", "pb.toml"},
                                 {"run", "pb.toml", "--json", "-"},
                                 {"kernels"},
                                 {"--help"},
                                 {"run", "--help"},
                                 {"--version"}}) {
    for (const char* output : {"/dev/full", "closed"}) {
      INFO(arguments[0] << " to " << output);
      CHECK_THAT(refusal(dir, arguments, {"", {}, false, output}), Contains("standard output: "));
    }
  }
  for (const char* output : {"/dev/full", "closed"}) {
    const finished f =
        contct_program(dir.path(), {"run", "pb.toml", "--json", "out.json"}, {"", {}, false, output});
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, Contains("standard output: "));
    CHECK_THAT(dir.read("out.json"), Contains("\"status\":\"solved\"") || Contains("\"status\": \"solved\""));
    fs::remove(dir.path() / "out.json");
  }
}

TEST_CASE("contct run writes the whole report page of --html, even if a pipe to head cuts off the table") {
  const scratch_folder dir;
  std::string text = good_problem;
  for (int i = 0; i < 2000; ++i) text += "[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n";
  dir.write("long.toml", text);
  const std::string here = dir.path().string();
  const std::string command = "cd '" + here +
                              "' && '" CONTCT_PROGRAM
                              "' run long.toml --html page.html --csv table.csv 2>errors | head -1 >table";
  CHECK(std::system(command.c_str()) == 0);
  CHECK_THAT(dir.read("table"), Contains("nodes, 1 pair, 2001 steps"));
  CHECK(dir.read("errors").empty());
  CHECK_THAT(dir.read("page.html"), Contains("</html>"));
  CHECK(fs::exists(dir.path() / "table.csv"));
}

TEST_CASE("if the stiffness is too ill-conditioned, contct run has exit status 2 and writes no files") {
  // PB9 with so large an EI that the bed's springs are lost to rounding.
  const scratch_folder dir;
  dir.write("stiff.toml",
            "[beam]\nlength = 2.0\nelements = 40\nEI = 1e16\n[[bed]]\nmodulus = 5000.0\nface = 0.0\n"
            "[[step]]\nuniform = [ { polynomial = [-20.0, 20.0, -5.0] } ]\n");
  const finished f = contct_program(dir.path(), {"run", "stiff.toml", "--kernels", "fortran,cpp", "--json",
                                                 "out.json", "--log", "out.log"});
  INFO(f.out << f.err);
  CHECK(f.exit == 2);
  CHECK_THAT(f.err, Contains("too ill-conditioned"));
  CHECK(dir.files() == words{"stiff.toml"});
}

TEST_CASE("contct run does not report kernels that were never called as equal to the bit") {
  const scratch_folder dir;
  dir.write("loose.toml",
            "[beam]\nx = [0, 1]\nEI = 1\n[[contact]]\nnode = 1\nsurface = \"below\"\nface = -1\n"
            "stiffness = 1\n[[step]]\nuniform = -1\n");
  const finished f = contct_program(dir.path(), {"run", "loose.toml"});
  CHECK(f.exit == 4);
  CHECK_THAT(f.out, Contains("fortran and cpp were never called, so nothing was compared"));
  CHECK_THAT(f.out, !Contains("equal to the bit"));
}

TEST_CASE("a JUnit report counts failed and skipped tests, and escapes the characters that XML forbids") {
  const std::string xml = junit_xml(two_of_three);
  CHECK_THAT(xml, Contains("<testsuites tests=\"3\" failures=\"1\" errors=\"0\" time=\"0.500\">"));
  CHECK_THAT(xml, Contains(" tests=\"3\" failures=\"1\" errors=\"0\" time=\"0.500\" skipped=\"1\">"));
  CHECK_THAT(xml, Contains("name=\"b &lt;&amp;&gt; &quot;c&quot;.trace: mine\""));
  CHECK_THAT(xml,
             Contains("<failure message=\"1 mismatch | here\">call 1: SS(1)\n\xEF\xBF\xBD odd</failure>"));
  CHECK_THAT(xml, Contains("<skipped message=\"another precision\"/>"));
  CHECK(xml.find('\x01') == std::string::npos);
  CHECK_THAT(junit_xml({"two\nlines", {}, {}, 0.0}),
             Contains("<testsuite name=\"two&#10;lines\" tests=\"0\""));
}

TEST_CASE(
    "a Markdown summary begins with the verdict, and a test's text with Markdown characters keeps the table "
    "valid") {
  const std::string text = markdown(two_of_three);
  CHECK(text.rfind("## contct replay: failed\n", 0) == 0);
  CHECK_THAT(text, Contains("1 passed, 1 failed, 1 skipped"));
  CHECK_THAT(text, Contains("| **failed** | 1 mismatch \\| here |"));
  CHECK_THAT(text, Contains("```\ncall 1: SS(1)"));
}
