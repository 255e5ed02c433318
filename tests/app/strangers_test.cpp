// Tests that texts of a problem's files send no control characters to a terminal, and that a problem opens
// only files below its folder.
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/process.hpp"
#include "catch.hpp"
#include "contct/text/strings.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

using words = std::vector<std::string>;

// ESC, BEL, DEL, a C1 control, marks that change the direction of text. hostile_bytes also has bytes that
// are not valid UTF-8.
// NOLINTNEXTLINE(misc-misleading-bidirectional): the text must contain such marks
const std::string hostile = "\x1b[31m\x07\x7f\u009b31m\u202e\u2067";
const std::string hostile_bytes = hostile + "\xff\xc0\x9b";
const std::string hostile_in_toml = R"(\u001b[31m\u0007\u007f\u009b31m\u202e\u2067)";

/// Runs the program and checks that its output has no control characters except a CR before LF. Returns the
/// number of outputs with an escaped ESC, which must not be 0 if the hostile text was printed.
int escapes_shown(const scratch_folder& dir, const words& arguments) {
  const finished f = contct_program(dir.path(), arguments);
  int escaped = 0;
  for (std::string plain : {f.out, f.err}) {
    for (std::size_t at = plain.find("\r\n"); at != std::string::npos; at = plain.find("\r\n", at))
      plain.erase(at, 1);
    INFO(joined(arguments, " ") << "\n" << terminal_text(plain));
    CHECK(terminal_text(plain) == plain);
    if (plain.find("\\x1b") != std::string::npos) ++escaped;
  }
  CHECK(f.exit >= 0);
  return escaped;
}

/// Returns the command lines for every output that a problem can have, each to standard output.
std::vector<words> questions(const std::string& file) {
  std::vector<words> all = {{"check", file},
                            {"run", file},
                            {"run", file, "--detail", "--kernels", "corrected"},
                            {"run", file, "--final-only"},
                            {"run", file, "--free-run", "--kernels", "fortran,corrected"},
                            {"run", file, "--kernels", "fortran," + hostile_bytes},
                            {"run", file, "--engine", hostile_bytes},
                            {"run", file, "--node", hostile_bytes},
                            {"run", file, "--json", hostile_bytes + "/x"},
                            {"explain", file, "--all"},
                            {"explain", file, "--increment", "1.1"},
                            {"explain", file, "--quiet", "--json", "-"},
                            {"exact", file, "--kernels", "fortran"},
                            {"exact", file, "--quiet", "--json", "-"},
                            {"check", file}};
  for (const char* output :
       {"--json", "--html", "--csv", "--log", "--trace", "--proof", "--junit", "--markdown"})
    all.push_back({"run", file, output, "-"});
  return all;
}

const std::string beam_problem =
    "title = \"Beam @\"\n[units]\nlength = \"m@\"\nforce = \"kN@\"\n"
    "[beam]\nx = [0.0, 1.0, 2.0]\nEI = 1.0e4\n"
    "[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5.0e4\n"
    "[[step]]\nname = \"load @\"\npoint = [ { node = 3, w = -60.0 } ]\n";

/// Returns `text` with every "@" replaced by `by`.
std::string filled(std::string text, const std::string& by) {
  for (std::size_t at = text.find('@'); at != std::string::npos; at = text.find('@', at + by.size()))
    text.replace(at, 1, by);
  return text;
}

/// Writes a matrix problem, a spring at a wall, in which the names of the three dofs and nodes begin with
/// `name`.
void write_matrix_problem(const scratch_folder& dir, const std::string& name) {
  dir.write("K.mtx",
            "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n");
  dir.write("K.dof", name + "1.x\n" + name + "2.x\n" + name + "3.x\n");
  dir.write("K.xyz", name + "1 0 0\n" + name + "2 1 0\n" + name + "3 2 0\n");
  std::string label;  // the name with TOML's escapes
  for (const char c : name) {
    constexpr std::string_view digits = "0123456789abcdef";
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f)
      label += std::string("\\u00") + digits[byte / 16] + digits[byte % 16];
    else
      label += c;
  }
  dir.write(
      "m.toml",
      "[matrix]\nstiffness = \"K.mtx\"\ndofs = \"K.dof\"\ncoordinates = \"K.xyz\"\n[[support]]\ndof = \"" +
          label + "1.x\"\nspring = 1.0\n[[contact]]\ndof = \"" + label +
          "3.x\"\nsurface = \"above\"\nface = 0.5\nstiffness = 10.0\n[[step]]\npoint = [ { dof = \"" + label +
          "2.x\", value = 2.0 } ]\n");
}

}  // namespace

TEST_CASE("no command sends control characters from a problem file to the terminal") {
  const scratch_folder dir;
  int escaped = 0;
  const std::string name = "p" + hostile_bytes + "'\n.toml";
  dir.write(name, filled(beam_problem, hostile_in_toml));
  for (const words& w : questions(name)) escaped += escapes_shown(dir, w);
  write_matrix_problem(dir, hostile);
  for (const words& w : questions("m.toml")) escaped += escapes_shown(dir, w);
  CHECK(escaped >= 25);
}

TEST_CASE(
    "no command sends control characters from a trace, or from a file that a problem names, to the "
    "terminal") {
  const scratch_folder dir;
  int escaped = 0;
  write_matrix_problem(dir, "n");
  REQUIRE(contct_program(dir.path(), {"run", "m.toml", "--quiet", "--trace", "calls.trace"}).exit == 0);
  fs::create_directories(dir.path() / "set/problems");
  dir.write("set/problems/p.toml", filled(beam_problem, hostile_in_toml));
  dir.write(
      "set/verification.toml",
      "[[case]]\nfile = \"p.toml\"\ntitle = \"one\"\n[[case.check]]\nquantity = \"w\"\nnode = 3\nstep = 1\n"
      "value = 0.0\ntolerance = 1e-9\nkind = \"closed form\"\nsource = \"here\"\nbecause = \"so\"\n");
  for (const auto& [file, arguments] : {std::pair("K.mtx", words{"run", "m.toml"}),
                                        {"K.dof", {"run", "m.toml"}},
                                        {"K.xyz", {"run", "m.toml", "--html", "-"}},
                                        {"calls.trace", {"replay", "calls.trace"}},
                                        {"set/verification.toml", {"verify", "--reference", "set"}}}) {
    INFO(file);
    const std::string sound = dir.read(file);
    const std::size_t at = sound.find_first_of(" \n", sound.size() / 2);
    dir.write(file, sound.substr(0, at) + hostile_bytes + sound.substr(at));
    escaped += escapes_shown(dir, arguments);
    dir.write(file, sound);
  }
  CHECK(escaped >= 2);
}

TEST_CASE("messages escape control characters in a kernel's answer") {
  const scratch_folder dir;
  dir.write("p.toml", filled(beam_problem, ""));
  dir.write("kernel.sh",
            "while read line; do [ \"$line\" = ask ] && printf 'smin "
            "\\033[31m\\007\\177\\302\\233\\377\\nend\\n'; done\n");
  int escaped = 0;
  for (const words& w : {words{"run", "p.toml", "--kernels", "cpp,pipe:sh kernel.sh"},
                         {"run", "p.toml", "--kernels", "pipe:sh kernel.sh"},
                         {"run", "p.toml", "--kernels", "plugin:./" + hostile_bytes},
                         {"fuzz", "--calls", "3", "--problems", "0", "--kernels", "cpp,pipe:sh kernel.sh"}})
    escaped += escapes_shown(dir, w);
  CHECK(escaped >= 2);
}

TEST_CASE(
    "run, check, explain and exact refuse a file outside the problem's folder, except with --allow-outside") {
  const scratch_folder dir;
  fs::create_directory(dir.path() / "own");
  dir.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n");
  dir.write("own/p.toml",
            "[matrix]\nstiffness = \"../K.mtx\"\n[[contact]]\ndof = \"2\"\nsurface = \"above\"\nface = 0.5\n"
            "stiffness = 10\n[[step]]\npoint = [ { dof = \"2\", value = 1 } ]\n");
  int allowed = 0;
  for (const char* command : {"run", "check", "explain", "exact"}) {
    const finished refused = contct_program(dir.path(), {command, "own/p.toml"});
    INFO(command << "\n" << refused.err);
    CHECK(refused.exit == 2);
    CHECK_THAT(refused.err, StartsWith("contct: own/p.toml:") && Contains("--allow-outside"));
    CHECK(contct_program(dir.path(), {command, "own/p.toml", "--allow-outside"}).exit == 0);
    ++allowed;
  }
  CHECK(allowed == 4);
}

TEST_CASE("no message quotes the content of a file outside the problem's folder") {
  const scratch_folder dir;
  const std::string secret = "secretroot:x:0:0:root:/root:/bin/sh";
  dir.write("passwd", secret + "\n" + secret + "2 secretfield\n");
  dir.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n");
  dir.write("K.dof", "a.x\nb.x\n");
  dir.write("job.dof", "a.x\nb.x\n");
  dir.write("job.sti", secret + "\n");
  const std::string matrix = "[matrix]\nstiffness = \"K.mtx\"\n";
  const std::string rest =
      "[[contact]]\ndof = \"b.x\"\nsurface = \"above\"\nface = 0.5\nstiffness = 10\n[[step]]\n";
  const std::string point = rest + "point = [ { dof = \"b.x\", value = 1 } ]\n";
  int refused = 0;
  for (const std::string& text :
       {"[matrix]\nstiffness = \"passwd\"\n" + point, matrix + "dofs = \"passwd\"\n" + point,
        matrix + "dofs = \"K.dof\"\ncoordinates = \"passwd\"\n" + point,
        matrix + "dofs = \"K.dof\"\n" + rest + "load = \"passwd\"\n",
        "[calculix]\njob = \"job\"\n" + point}) {
    dir.write("p.toml", text);
    const finished f = contct_program(dir.path(), {"run", "p.toml"});
    INFO(text << f.err);
    CHECK(f.exit == 2);
    CHECK_THAT(f.err, !Contains("secret"));
    ++refused;
  }
  CHECK(refused == 5);
}
