// Tests that wrong input gives exit status 2 and a message, and writes no output file, and that texts of a
// problem's files send no control characters to a terminal.
#include <sstream>

#include "app/process.hpp"
#include "catch.hpp"
#include "contct/text/strings.hpp"
#include "read/good_problem.hpp"

using namespace contct;
namespace fs = std::filesystem;

namespace {

const std::string pb7 = "@problems/pb07-three-gap-supports.toml";
const std::string matrix = "%%MatrixMarket matrix coordinate real symmetric\n";
const std::string matrix_problem =
    "[matrix]\nstiffness = 'K.mtx'\n[[step]]\npoint = [ { dof = '1', value = 1 } ]\n";

// ESC, BEL, DEL, a C1 control, marks that change the direction of text. hostile_bytes also has bytes that
// are not valid UTF-8.
// NOLINTNEXTLINE(misc-misleading-bidirectional): the text must contain such marks
const std::string hostile = "\x1b[31m\x07\x7f\u009b31m\u202e\u2067";
const std::string hostile_bytes = hostile + "\xff\xc0\x9b";
const std::string hostile_in_toml = R"(\u001b[31m\u0007\u007f\u009b31m\u202e\u2067)";

/// Runs the program and checks that its output has no control characters except a CR before LF. Returns the
/// number of outputs with an escaped ESC, which must not be 0 if the hostile text was printed.
int escapes_shown(const scratch_folder& dir, const texts& arguments) {
  const finished f = contct_program(dir.path(), arguments);
  int escaped = 0;
  for (std::string plain : {f.out, f.err}) {
    for (std::size_t at = plain.find("\r\n"); at != std::string::npos; at = plain.find("\r\n", at))
      plain.erase(at, 1);
    INFO(joined(arguments, " ") << "\n" << terminal_text(plain));
    CHECK(terminal_text(plain) == plain);
    escaped += count(plain, "\\x1b") > 0 ? 1 : 0;
  }
  CHECK(f.exit >= 0);
  return escaped;
}

/// Runs a command for every output that a problem can have, each to standard output, and returns the number
/// of outputs with an escaped ESC.
int escapes_of_all_outputs(const scratch_folder& dir, const std::string& file) {
  int escaped = 0;
  std::istringstream lines(
      "check\nrun\nrun --detail --kernels corrected\nrun --final-only\nexplain --all\n"
      "explain --increment 1.1\nrun --free-run --kernels fortran,corrected\nrun --kernels fortran,%\n"
      "run --engine %\nrun --node %\nrun --json %/x\nexplain --quiet --json -\nexact --kernels fortran\n"
      "exact --quiet --json -\nrun --json -\nrun --html -\nrun --csv -\nrun --log -\nrun --trace -\n"
      "run --proof -\nrun --junit -\nrun --markdown -\n");
  for (std::string line; std::getline(lines, line);) {
    texts arguments = words_of(line);
    for (std::string& word : arguments)
      if (const std::size_t at = word.find('%'); at != std::string::npos) word.replace(at, 1, hostile_bytes);
    arguments.insert(arguments.begin() + 1, file);
    escaped += escapes_shown(dir, arguments);
  }
  return escaped;
}

/// Returns `good_problem` with `by` in its texts.
std::string beam_problem(const std::string& by) {
  return "title = \"" + by + "\"\n[units]\nlength = \"m" + by + "\"\nforce = \"kN" + by + "\"\n" +
         with("[[step]]\n", "[[step]]\nname = \"load " + by + "\"\n");
}

/// Writes a matrix problem, a spring at a wall, in which the names of the three dofs and nodes begin with
/// `name`, which is `in_toml` in TOML.
void write_matrix_problem(const scratch_folder& dir, const std::string& name, const std::string& in_toml) {
  dir.write("K.mtx",
            "%%MatrixMarket matrix coordinate real symmetric\n3 3 5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n");
  dir.write("K.dof", name + "1.x\n" + name + "2.x\n" + name + "3.x\n");
  dir.write("K.xyz", name + "1 0 0\n" + name + "2 1 0\n" + name + "3 2 0\n");
  dir.write(
      "m.toml",
      "[matrix]\nstiffness = \"K.mtx\"\ndofs = \"K.dof\"\ncoordinates = \"K.xyz\"\n[[support]]\ndof = \"" +
          in_toml + "1.x\"\nspring = 1.0\n[[contact]]\ndof = \"" + in_toml +
          "3.x\"\nsurface = \"above\"\nface = 0.5\nstiffness = 10.0\n[[step]]\npoint = [ { dof = \"" +
          in_toml + "2.x\", value = 2.0 } ]\n");
}

}  // namespace

TEST_CASE("a problem that cannot be read gives exit status 2, one message, and no output files") {
  const workplace here(
      {{"bad.toml", with("stiffness", "stifness")},
       {"program.toml", "\x7f" + std::string("ELF\x02\x01\x01\x00", 7) + std::string(1000, '\xfe')}});
  for (const auto& [file, message] :
       {std::pair("bad.toml", "^contct: bad.toml:11:1: contact[1].stifness: found an"),
        {"program.toml", "^contct: program.toml:1:"},
        {"program.toml", "not TOML"},
        {"missing.toml", "missing.toml: cannot be read: No such file"},
        {".", "found a directory"},
        {"''", "cannot be read"},
        {"-", "^contct: standard input:"}}) {
    const std::string line = "run " + std::string(file) + " --json out.json --log out.log";
    const process_options from{"[beam]\nEI = 0\n", {}, false};
    here.check_refusals(line, {{"", message}}, from);
    CHECK(count(here.contct(line, from).err, "\n") == 1);
  }
}

TEST_CASE("wrong usage of contct gives exit status 2 and a message with what is allowed") {
  const workplace here(
      {{"good.toml", good_problem},
       {"plate.toml",
        "[plate]\nsize = [1, 1]\nelements = [2, 2]\n"
        "D = 1\nnu = 0.3\n[[bed]]\nmodulus = 4\nface = 0\n[[step]]\nuniform = -1\n"},
       {"K.mtx", matrix + "1 1 1\n1 1 2.0\n"},
       {"m.toml", matrix_problem},
       {"large.toml", "[beam]\nlength = 1\nelements = 30000\nEI = 1\n[[step]]\nuniform = 1\n"}});
  here.check_refusals(
      "", {{"", "--help"},
           {"run m.toml --refine --json o.json",
            "--refine: found a structure given by its matrix, K.mtx; allowed: [beam] and [plate]"},
           {"exact large.toml", "found 60002 dofs; allowed: at most 50000"},
           {"verify --reference nowhere", "nowhere/verification.toml"}});
  here.check_refusals("run good.toml",
                      {{"--json no/such/place.json", "no/such/place.json"},
                       {"--kernels fortran,basic", "fortran-r4"},
                       {"--kernels fortran,cpp,fortran", "named twice"},
                       {"--kernels fortran,corrected", "differ in rule and cannot be equal to the bit"},
                       {"--engine warp", "no engine is named \"warp\"; allowed: auto, refactor, "},
                       {"--engine warp", "condensed"},
                       {"--max-increments 0", "--max-increments: Value 0 not in range"},
                       {"--json - --log -", "cannot both be -"}});
  here.check("run plate.toml --engine condensed", 2, {"^"}, {"allowed: a beam with pairs"});
  // This message must come before the error that unit 26 is already open.
  for (const char* pair : {"fortran,fortran-r4", "fortran-r4,fortran", "cpp,fortran-r4", "cpp-r4,fortran"})
    here.check_refusals("run good.toml --kernels",
                        {{pair,
                          "-byte REAL, the 1989 rule) differ in precision and cannot be "
                          "equal to the bit; compare them with --free-run"}});
  for (const char* node : {"0", "4", "'x = 0.5'", "x", "three"})
    here.check_refusals("run good.toml --csv o.csv --node",
                        {{node, "--node: found"},
                         {node, "a node from 1 to 3, or x = .. with the coordinate of a node, from 0 to 2"}});
  here.check_refusals("exact " + pb7,
                      {{"--rule 1990", "--rule: 1990 not in"}, {"--kernels nobody", "nobody"}});
}

TEST_CASE("contct explain refuses a step, increment, pair or kernel that it cannot explain") {
  workplace().check_refusals(
      "explain --json o.json " + pb7,
      {{"--pair 4", "--pair: found 4; allowed: a pair from 1 to 3"},
       {"--pair 0", "--pair: found 0; allowed: a pair from 1 to 3"},
       {"--step 5", "--step: found 5; allowed: a step from 1 to 4"},
       {"--step -1", "--step: found -1; allowed: a step from 1 to 4"},
       {"--increment 5.1", "--step: found 5; allowed: a step from 1 to 4"},
       {"--increment 4", "--increment: found 4; allowed: an increment from 1 to 3"},
       {"--increment 1.2", "--increment: found 1.2; allowed: an increment from 1 to 1, in step 1"},
       {"--increment two", "--increment: found two; allowed: a whole number from 1, or STEP.INCREMENT"},
       {"--increment 0", "--increment: found 0"},
       {"--increment 2.", "--increment: found 2."},
       {"--increment 2.1 --step 3", "allowed: the same step"},
       {"--kernels corrected", "has the corrected rule, which is not in the listing"},
       {"--kernels fortran,corrected", "--free-run --kernels corrected,fortran"},
       {"--kernels fortran,cpp-r4", "differ in precision"},
       {"--kernels cpp,cpp", "named twice"},
       {"--kernels cpp,fortran,cpp", "found 3 kernels; allowed: one or two"},
       {"--kernels pipe:cat", "is an external kernel and cannot lead"},
       {"--engine warp", "allowed: auto, refactor, "}});
  workplace().check_refusals("explain @traces/ties.trace",
                             {{"--json -", "found a trace with --json"},
                              {"--increment 999", "--increment: found 999; allowed: the number of a call"}});
}

TEST_CASE("contct replay and contct fuzz refuse files and options with which they compare nothing") {
  const workplace here(
      {{"empty.trace", ""}, {"header.trace", "contct-trace-1 2026-11-21\nkernel fortran\n"}});
  here.check_refusals("replay", {{"empty.trace", "empty.trace: found the end of the text"},
                                 {"header.trace", "found no call"},
                                 {"missing.trace", "missing.trace"},
                                 {"", "TRACE"}});
  here.check("replay @traces/ties.trace --kernel cpp-r4 --json r.json", 2,
             {"skipped: recorded with 8-byte REAL and the 1989 rule"}, {"nothing was compared"});
  for (const char* line :
       {"fuzz --calls 0", "fuzz --kernels fortran", "fuzz --shard 3/2", "fuzz --shard 1/2x",
        "fuzz --kernels fortran,corrected", "fuzz --kernels fortran,cpp-r4", "fuzz --kernels fortran,nobody"})
    here.check(line, 2);
  // Of four calls, shard 5 of 9 gets none.
  here.check("fuzz --calls 4 --problems 0 --shard 5/9", 2, {"^"}, {"nothing was compared"});
}

TEST_CASE("contct refuses an environment variable whose value is not a valid time") {
  const workplace here({{"pb.toml", good_problem}});
  for (const char* wrong : {"soon", "-1", "nan", "1s", ""}) {
    process_options o;
    o.error_terminal = true;
    o.environment = {{"TERM", "dumb"}, {"CONTCT_PROGRESS_AFTER", wrong}};
    here.check("run pb.toml", 2, {"^"}, {"CONTCT_PROGRESS_AFTER", "allowed: seconds, 0 or more"}, o);
  }
  for (const char* wrong : {"today", "-1", "", "253402300800"})
    here.check("run pb.toml --html o.html", 2, {}, {"SOURCE_DATE_EPOCH", "allowed: seconds since 1970"},
               {"", {{"SOURCE_DATE_EPOCH", wrong}}});
}

TEST_CASE("contct new writes the files that its problem names, and overwrites no file and no symbolic link") {
  const workplace here({{"beam.toml", "mine"}});
  fs::create_symlink("nowhere", here.path() / "link.toml");
  for (const std::string file : {"beam.toml", "link.toml", ".", ""})
    here.check("new beam " + file, 2, {}, {"which exists already"});
  here.check("new beam no/such/folder.toml", 2, {}, {"no/such/folder.toml"});
  here.check("new crene", 2, {},
             {"KIND: found crene (did you mean \"crane\"?); allowed: base-plate, beam, bed, crane"});
  CHECK(here.read("beam.toml") == "mine");
  fs::create_directory(here.path() / "own");
  here.check("new matrix own/grillage.toml", 0,
             {"own/grillage.toml, own/matrix.mtx, own/matrix.dof, own/matrix.xyz are written"});
  here.check("check own/grillage.toml", 0);
  here.check("new matrix own/second.toml", 2, {}, {"own/matrix.mtx, which exists already"});
  CHECK_FALSE(fs::exists(here.path() / "own/second.toml"));
}

TEST_CASE("no command writes an output over a file that the problem names, also through a link") {
  const workplace here;
  fs::copy(root / "reference/structures", here.path(), fs::copy_options::recursive);
  fs::create_hard_link(here.path() / "frame.mtx", here.path() / "hard");
  here.write("K.pairs.csv", matrix + "1 1 1\n1 1 2\n");
  here.write("p.toml",
             "[matrix]\nstiffness = 'K.pairs.csv'\n[[step]]\npoint = [ { dof = '1', value = 1 } ]\n");
  const std::string before = here.read("frame.mtx") + here.read("K.pairs.csv");
  const std::string same = ": found the same file as a file that the problem names";
  for (const char* option : {"json", "html", "csv", "log", "trace", "proof", "junit", "markdown"})
    here.check_refusals("run frame.toml --" + std::string(option), {{"hard", option + (" hard" + same)}});
  for (const char* file : {"frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"})
    here.check_refusals("run frame.toml --json", {{file, file + same}});
  for (const char* file : {"calculix/console.sti", "calculix/console.dof", "calculix/console.inp"})
    here.check_refusals("run calculix/console.toml --json", {{file, file + same}});
  here.check_refusals("", {{"explain frame.toml --json hard", "--json hard" + same},
                           {"exact frame.toml --json hard", "--json hard" + same},
                           {"run p.toml --csv K.csv", "K.pairs.csv: found the same file as"}});
  CHECK(here.read("frame.mtx") + here.read("K.pairs.csv") == before);
}

TEST_CASE("contct verify refuses to overwrite verification.toml or a reference problem") {
  const workplace here;
  fs::copy(root / "reference/verification.toml", here.path());
  fs::copy(root / "reference/problems", here.path() / "problems", fs::copy_options::recursive);
  for (const std::string file : {"verification.toml", "problems/pb07-three-gap-supports.toml"}) {
    const std::string before = here.read(file);
    for (const char* option : {"--json ", "--junit ", "--markdown "})
      here.check_refusals("verify --reference .", {{option + file, "found the same file as"}});
    CHECK(here.read(file) == before);
  }
}

TEST_CASE("every command refuses an output file with an empty name") {
  const workplace here({{"pb.toml", good_problem}});
  int refused = 0;
  for (const auto& [command, options] :
       {std::pair("run pb.toml", "--json --html --csv --vtu --log --trace --proof --junit --markdown"),
        {"explain pb.toml", "--json"},
        {"exact pb.toml", "--json"},
        {"replay none.trace", "--json --junit --markdown"},
        {"fuzz --calls=1", "--json --out --junit --markdown"},
        {"verify --quiet", "--json --junit --markdown"}}) {
    for (const std::string& option : words_of(options)) {
      here.check_refusals(command, {{option + " ''", option + ": found an empty name; allowed: a file name"},
                                    {option + "=", option + ": "}});
      ++refused;
    }
  }
  CHECK(refused == 21);
}

TEST_CASE("contct run refuses an output in the file of its problem or of another output, by any path") {
  const workplace here({{"pb.toml", good_problem}, {"stdout", ""}});
  fs::create_symlink("pb.toml", here.path() / "link");
  fs::create_hard_link(here.path() / "pb.toml", here.path() / "hard");
  fs::create_symlink("out", here.path() / "to-out");
  fs::create_directory(here.path() / "folder");
  for (const std::string out : {"pb.toml", "link", "hard"})
    here.check_refusals("run", {{"pb.toml --json " + out, "the same file as the problem"},
                                {"link --log " + out, "the same file as the problem"}});
  for (const std::string log : {"out", "./out", "folder/../out", "to-out"})
    here.check_refusals("run pb.toml --json out --log",
                        {{log, "--log " + log + ": found the same file as --json"}});
  here.check_refusals("run pb.toml", {{"--html out --csv out", "found"},
                                      {"--html pb.toml", "found"},
                                      {"--csv out.csv --json out.pairs.csv", "found"},
                                      {"--csv out.csv --json out.states.csv", "found"},
                                      {"--vtu out.vtu --html out.pvd", "found"},
                                      {"--vtu out.vtu --csv ./out.000.vtu", "found"},
                                      {"--vtu out.vtu --log out.119.vtu", "found"},
                                      {"--html - --csv -", "cannot both be -"},
                                      {"--vtu -", "found"},
                                      {"--vtu out", "found"}});
  here.check_refusals("run pb.toml --json stdout", {{"", "the same file as standard output"}},
                      {"", {}, false, here.at("stdout")});
  here.check("run pb.toml --json /dev/null --log /dev/null", 0);
  CHECK(here.read("pb.toml") == good_problem);
}

TEST_CASE("a file outside the problem's folder needs --allow-outside, and no message quotes it") {
  const std::string secret = "secretroot:x:0:0:root:/root:/bin/sh\n";
  const workplace here({{"passwd", secret + secret + "2 secretfield\n"},
                        {"K.mtx", matrix + "2 2 3\n1 1 2\n2 1 -1\n2 2 2\n"},
                        {"K.dof", "a.x\nb.x\n"},
                        {"job.dof", "a.x\nb.x\n"},
                        {"job.sti", secret}});
  const std::string rest =
      "[[contact]]\ndof = 'b.x'\nsurface = 'above'\nface = 0.5\nstiffness = 10\n[[step]]\n";
  const std::string point = rest + "point = [ { dof = 'b.x', value = 1 } ]\n";
  fs::create_directory(here.path() / "own");
  here.write("own/p.toml", "[matrix]\nstiffness = '../K.mtx'\ndofs = '../K.dof'\n" + point);
  for (const std::string command : {"run", "check", "explain", "exact"}) {
    here.check(command + " own/p.toml", 2, {}, {"^contct: own/p.toml:", "--allow-outside"});
    here.check(command + " own/p.toml --allow-outside", 0);
  }
  const std::string given = "[matrix]\nstiffness = 'K.mtx'\n";
  for (const std::string& text :
       {"[matrix]\nstiffness = 'passwd'\n" + point, given + "dofs = 'passwd'\n" + point,
        given + "dofs = 'K.dof'\ncoordinates = 'passwd'\n" + point,
        given + "dofs = 'K.dof'\n" + rest + "load = 'passwd'\n", "[calculix]\njob = 'job'\n" + point}) {
    here.write("p.toml", text);
    here.check("run p.toml", 2, {}, {"!secret"});
  }
}

TEST_CASE("contct exact solves with a nearly singular matrix, and refuses a barely indefinite matrix") {
  const workplace here({{"p.toml", matrix_problem}});
  const auto corner_of = [&here](const std::string& corner) {
    here.write("K.mtx", matrix + "2 2 3\n1 1 1\n2 1 1\n2 2 " + corner + "\n");
    return "exact p.toml --digits 30";
  };
  here.check(corner_of("1.0000000000000002"), 0, {"largest w 5000000000000001 at dof 1"});
  here.check(corner_of("0.9999999999999999"), 2, {},
             {"K.mtx: not positive semidefinite: found u'Ku = -1e-16, exactly"});
  here.check(corner_of("1"), 4);  // semidefinite, and the load drives the rigid-body motion
}

TEST_CASE("no command sends control characters from a problem file to the terminal") {
  const scratch_folder dir;
  const std::string name = "p" + hostile_bytes + "'\n.toml";
  dir.write(name, beam_problem(hostile_in_toml));
  write_matrix_problem(dir, hostile, hostile_in_toml);
  CHECK(escapes_of_all_outputs(dir, name) + escapes_of_all_outputs(dir, "m.toml") >= 25);
}

TEST_CASE("no command sends control characters from a trace or a named file to the terminal") {
  const scratch_folder dir;
  int escaped = 0;
  write_matrix_problem(dir, "n", "n");
  REQUIRE(contct_program(dir.path(), {"run", "m.toml", "--quiet", "--trace", "calls.trace"}).exit == 0);
  fs::create_directories(dir.path() / "set/problems");
  dir.write("set/problems/p.toml", beam_problem(hostile_in_toml));
  dir.write(
      "set/verification.toml",
      "[[case]]\nfile = \"p.toml\"\ntitle = \"one\"\n[[case.check]]\nquantity = \"w\"\nnode = 3\nstep = 1\n"
      "value = 0.0\ntolerance = 1e-9\nkind = \"closed form\"\nsource = \"here\"\nbecause = \"so\"\n");
  for (const auto& [file, line] : {std::pair("K.mtx", "run m.toml"),
                                   {"K.dof", "run m.toml"},
                                   {"K.xyz", "run m.toml --html -"},
                                   {"calls.trace", "replay calls.trace"},
                                   {"set/verification.toml", "verify --reference set"}}) {
    INFO(file);
    const std::string sound = dir.read(file);
    const std::size_t at = sound.find_first_of(" \n", sound.size() / 2);
    dir.write(file, sound.substr(0, at) + hostile_bytes + sound.substr(at));
    escaped += escapes_shown(dir, words_of(line));
    dir.write(file, sound);
  }
  CHECK(escaped >= 2);
}

TEST_CASE("messages escape control characters in a kernel's answer") {
  const scratch_folder dir;
  dir.write("p.toml", beam_problem(""));
  dir.write("kernel.sh",
            "while read line; do [ \"$line\" = ask ] && printf 'smin "
            "\\033[31m\\007\\177\\302\\233\\377\\nend\\n'; done\n");
  int escaped = escapes_shown(dir, {"run", "p.toml", "--kernels", "plugin:./" + hostile_bytes});
  for (const char* line :
       {"run p.toml --kernels 'cpp,pipe:sh kernel.sh'", "run p.toml --kernels 'pipe:sh kernel.sh'",
        "fuzz --calls 3 --problems 0 --kernels 'cpp,pipe:sh kernel.sh'"})
    escaped += escapes_shown(dir, words_of(line));
  CHECK(escaped >= 2);
}
