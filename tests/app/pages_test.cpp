// Tests that README.md, trace-format.md, DIVERGENCES.md, cookbook.md and the help texts say what the program
// does, and that cpp/run.sh runs in the caller's folder. For this a cmake without effect replaces the build,
// and build/release has a link to the built program.
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "app/process.hpp"
#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "read/good_problem.hpp"

using namespace contct;
using json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

const std::string readme = read_input(CONTCT_ROOT "/README.md");

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  REQUIRE(begin != std::string::npos);
  const std::size_t end = text.find(to, begin + from.size());
  REQUIRE(end != std::string::npos);
  return text.substr(begin + from.size(), end - begin - from.size());
}

const std::string page = read_input(CONTCT_ROOT "/reference/DIVERGENCES.md");

/// A section of the page: the runs of its problem by a 1989 kernel and by the corrected rule.
struct way {
  /// `status`: the exit status of the 1989 kernel with --strict.
  way(const std::string& heading, const std::string& file, int status, const std::string& kernel = "fortran")
      : text(page.substr(page.find("\n### " + heading))),
        wrong(run(file, kernel, status)),
        right(run(file, "corrected", 0)) {
    text.resize(text.find("\n#", 5));
  }
  static json run(const std::string& file, const std::string& kernel, int status) {
    const workplace here;
    const std::string line =
        "run @problems/divergences/" + file + ".toml --strict --json out.json --kernels " + kernel;
    here.check(line, status, {}, {"^"});
    return here.json("out.json");
  }
  /// Checks that the section contains this number, and that the measured value rounds to it.
  void says(const std::string& number, double measured) const {
    INFO(number << " is said, " << measured << " measured, in" << text);
    CHECK(text.find(number) != std::string::npos);
    const std::size_t e = std::min(number.find_first_of("e "), number.size());  // after the digits
    const std::size_t point = std::min(number.find('.'), e - 1);
    const double exponent = number.find('e') < number.size() ? std::stod(number.substr(e + 1)) : 0.0;
    const double unit = std::pow(10.0, exponent - static_cast<double>(e - 1 - point));
    CHECK(std::abs(std::strtod(number.c_str(), nullptr) - measured) <= 0.51 * unit);
  }
  std::string text;
  json wrong, right;
};

double w(const json& result, std::size_t step, std::size_t node) {
  return result["steps"][step - 1]["w"][node - 1];
}

/// Returns the rest of each line between two texts that begins with `start`.
texts lines_between(const std::string& text, const std::string& from, const std::string& to,
                    const std::string& start) {
  std::istringstream in(between(text, from, to));
  texts lines;
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(start)) lines.push_back(line.substr(start.size()));
  return lines;
}

/// Returns the command lines under "Examples:".
texts examples_in(const std::string& help) {
  return lines_between(help + "\f", "Examples:\n", "\f", "  contct ");
}

/// Returns the sum of the contact forces of the pairs with this surface, "above" or "below".
double force_of(const nlohmann::json& step, const std::string& surface) {
  double sum = 0.0;
  for (const auto& pair : step["pairs"])
    if (pair["surface"] == surface) sum += pair["force"].get<double>();
  return sum;
}

/// Returns (modulus / 4 EI)^(1/4), the decay constant of Winkler's beam.
double decay(double modulus, double EI) {
  return std::pow(modulus / (4 * EI), 0.25);
}

/// A project folder with links to the scripts and the built program.
class built_project {
 public:
  built_project() {
    for (const char* folder :
         {"the project/cpp", "the project/build/release", "the project/reference", "tools"})
      fs::create_directories(dir_.path() / folder);
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
    fs::permissions(dir_.write("tools/" + name, "#!/bin/sh\n" + does + "\n"), fs::perms::owner_all);
  }

  /// Runs `sh .../cpp/run.sh ARGUMENTS` in `folder`, and checks its exit status and the words of its output.
  void check(const fs::path& folder, const std::string& arguments, int exit, const texts& pieces) const {
    const finished f =
        shell("cd '" + folder.string() + "' && PATH='" + dir_.at("tools") +
              ":/usr/bin:/bin' CDPATH=/tmp sh '" + (root() / "cpp/run.sh").string() + "' " + arguments);
    INFO(f.out);
    CHECK(f.exit == exit);
    check_words(f.out, pieces);
  }

 private:
  scratch_folder dir_;
};

}  // namespace

TEST_CASE("README.md shows the output that the program prints for the same run") {
  const std::string problem = "reference/problems/pb07-three-gap-supports.toml";
  CHECK(contct_program(root, {"run", problem}).out ==
        between(readme, "$ build/release/contct run " + problem + "\n", "```"));
}

TEST_CASE("the beam in README.md runs, and has an event") {
  CHECK(count(readme, "```toml\n") == 1);
  workplace({{"own.toml", between(readme, "```toml\n", "```")}}).check("run own.toml", 0, {"make 1:"});
}

TEST_CASE("README.md cites the program with the name, version and checksum that contct --version prints") {
  const std::string cited = between(readme, "@software{contct,", "```");
  const std::string printed = workplace().contct("--version").out + "\n";
  const std::string checksum = between(printed, "listing sha256 ", "\n");
  CHECK(checksum.size() == 64);
  CHECK(count(cited, "{" + between(printed, "contct ", "\n") + "}") == 1);
  CHECK(count(cited, "Listing SHA-256 " + checksum + "}") == 1);
}

TEST_CASE("the trace in trace-format.md is valid, and the FORTRAN and C++ kernels give its answers") {
  process_options shown;
  shown.input = between(read_input(CONTCT_ROOT "/reference/trace-format.md"), "```trace\n", "```");
  workplace().check("replay --kernel fortran,cpp -", 0, {"1 call, ", "2 passed, 0 failed"}, {}, shown);
}

TEST_CASE("DIVERGENCES.md, way 1: at a near tie an event is too early, and the error outlasts the load") {
  const way a("1. ", "near-tie", 3);
  check_like(a.wrong["steps"], R"([{"increments": {"0": {"events": [{}, {}]}},
      "certificate": {"certified": false}}, {"certificate": {"certified": false}}])");
  a.says("1.3333e-4", w(a.wrong, 2, 3));
  a.says("0.0", w(a.right, 2, 3));
  a.says("4.8e-6", w(a.wrong, 1, 3) - w(a.right, 1, 3));
  a.says("3 %", 100 * w(a.wrong, 2, 3) / -w(a.right, 1, 3));
}

TEST_CASE("DIVERGENCES.md, way 2: in small units a pair makes contact too early, or keeps its force") {
  const way a("2. ", "small-unit", 3);
  check_like(a.wrong["steps"][0],
             R"({"pairs": {"0": {"state": "contact"}}, "certificate": {"certified": false}})");
  CHECK(a.right["steps"][0]["pairs"][0]["state"] == "separated");
  a.says("-1.1163e-11", w(a.wrong, 2, 3));
  a.says("-4.8372e-11", w(a.right, 2, 3));
  // A pair compressed by less than EPSGAP separates at unloading but keeps its force.
  const way b("2. ", "stiff-stop", 3);
  check_like(b.wrong["steps"],
             R"([{"certificate": {"certified": true}}, {"certificate": {"certified": false}}])");
  b.says("+0.0040", w(b.wrong, 2, 3));
  b.says("-0.0040", w(b.right, 2, 3));
  b.says("4.5e-11", -0.004 - w(b.right, 1, 3));
}

TEST_CASE("DIVERGENCES.md, way 3: in single precision, a pressed pair counts as one that only touches") {
  const way a("3. ", "single-precision", 3, "fortran-r4");
  check_like(a.wrong["steps"][1], R"({"pairs": {"0": {"state": "separated"}},
      "increments": {"0": {"fraction": "< 1e-9"}}})");
  CHECK(a.right["steps"][1]["pairs"][0]["state"] == "contact");
  a.says("+4.000000", w(a.wrong, 2, 3));
  a.says("-4.000000", w(way::run("single-precision", "fortran", 0), 2, 3));
  a.says("4.5e-8", -4.0 - w(a.right, 1, 3));
}

TEST_CASE("DIVERGENCES.md, way 4: an event exactly at full load happens in the next step, harmlessly") {
  const way a("4. ", "event-at-full-load", 0);
  for (const json& result : {a.wrong, a.right}) {
    a.says("-0.004", w(result, 1, 3));
    check_like(result["steps"],
               R"([{"pairs": {"0": {"state": "separated"}}, "certificate": {"certified": true}},
        {"pairs": {"0": {"state": "contact"}}, "increments": {"0": {"fraction": "< 1e-9"}}}])");
  }
}

TEST_CASE("DIVERGENCES.md, way 6: an event near full load also toggles a second pair, which has no event") {
  const way a("6. ", "mark-toggled", 3);
  a.says("0.998", a.wrong["steps"][0]["increments"][0]["fraction"]);
  check_like(a.wrong["steps"][0], R"({"increments": {"0": {"events": [{}, {}]}},
      "pairs": {"0": {"state": "contact"}}})");
  CHECK(a.right["steps"][0]["increments"][0]["events"].size() == 1);
  a.says("-5e4", a.wrong["steps"][0]["pairs"][0]["force"]);
  CHECK(w(a.wrong, 1, 3) == Approx(w(a.right, 1, 3)).epsilon(1e-9));
}

TEST_CASE("DIVERGENCES.md, way 7: wrong contact forces end the path of a beam that has an equilibrium") {
  const way a("7. ", "locked-in-forces", 5);
  check_like(a.wrong, R"({"end": {"step": 3}, "steps": {"1": {"certificate": {"certified": false}}}})");
  a.says("0.99907", a.wrong["end"]["fraction"]);
  a.says("2.27", w(a.wrong, 3, 13));
  for (std::size_t node = 1; node <= 13; ++node) CHECK(std::abs(w(a.right, 3, node)) < 1e-9);
}

TEST_CASE("DIVERGENCES.md, way 8: the 1989 rule makes no progress, although an equilibrium exists") {
  const way a("8. ", "standstill", 5);
  check_like(a.wrong, R"({"end": {"fraction": "< 1e-9"}, "steps": {"0": {"increments": [{}, {}]}}})");
  check_like(a.right["steps"][0]["pairs"], R"({"0": {"force": 1.5}, "1": {"force": 1.5}})");
  a.says("1.5", a.right["steps"][0]["pairs"][0]["force"]);
}

TEST_CASE("DIVERGENCES.md names every problem file of reference/problems/divergences, and no other file") {
  const std::string folder = "problems/divergences/";
  std::set<std::string> named;
  for (std::size_t at = page.find(folder); at != std::string::npos; at = page.find(folder, at + 1)) {
    const std::size_t end = page.find(".toml", at);
    if (end < at + 60) named.insert(page.substr(at + folder.size(), end + 5 - at - folder.size()));
  }
  std::set<std::string> there;
  for (const auto& entry : std::filesystem::directory_iterator(root / "reference" / folder))
    there.insert(entry.path().filename().string());
  CHECK(named == there);
  CHECK(there.size() == 8);
}

TEST_CASE("every command has help with examples, and every example runs as it is printed") {
  const std::string help = workplace().contct("--help").out;
  std::size_t commands = 0;
  std::size_t run = 0;
  for (const std::string& line : lines_between(help, "Subcommands:\n", "\n\n", "  ")) {
    const std::string command = line.substr(0, line.find(' '));
    if (command.empty()) continue;  // the second line of a text
    ++commands;
    const finished f = workplace().contct(command + " --help");
    INFO(command);
    CHECK(f.exit == 0);
    CHECK(f.err.empty());
    CHECK_FALSE(examples_in(f.out).empty());
    for (const std::string& example : examples_in(f.out)) {
      if (command == "prove")
        continue;  // tests/prove runs these, which take a minute and fail with sanitizers
      CHECK(example.starts_with(command));
      const workplace here;
      if (command != "new") {
        here.check("new beam", 0);
        here.check("run beam.toml --quiet --trace calls.trace", 0);
        fs::create_symlink(CONTCT_PLUGINS "/libvariant_right.so", here.path() / "mine.so");
        fs::create_symlink(root / "reference/benchmarks/calculix.json", here.path() / "theirs.json");
      }
      here.check(example, 0, {}, {"!error"});
      ++run;
    }
  }
  CHECK(run >= 15);
  CHECK(commands >= 9);
  CHECK(examples_in(help).size() == commands);
}

TEST_CASE("a problem from contct new is certified, and has all tables of the format in its comments") {
  for (const std::string shape : {"beam", "plate"}) {
    const workplace here;
    here.check("new " + shape, 0,
               {shape + ".toml is written; next: contct run " + shape + ".toml --strict --html report.html"});
    CHECK(here.files() == texts{shape + ".toml"});
    std::string text = here.read(shape + ".toml");
    check_words(text, {"[[support]]", "[[contact]]", "[[bed]]", "[[step]]", "positive up"});
    here.check("run " + shape + ".toml --strict --json out.json", 0, {"make ", "break ", "are certified"});
    const std::string certified = R"({"certificate": {"certified": true}})";
    check_like(here.json("out.json")["steps"], "[" + certified + "," + certified + "]");
    // With the tables in its comments it runs too.
    int put_in = 0;
    for (const char* piece : {"# [[", "# spring", "# nodes", "# at", "# fix", "# modulus", "# face",
                              "# settlement", "# name =", "# from =", "# to   ="})
      for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at), ++put_in)
        text.erase(at, 2);
    CHECK(put_in >= 3);
    here.write("own.toml", text);
    here.check("run own.toml", 0, {}, {"!error"});
  }
}

TEST_CASE("contct new without a kind of problem lists the kinds of the cookbook, and has exit status 2") {
  const std::string out = workplace().contct("new").out;
  std::size_t kinds = 0;
  for (const auto& entry : fs::directory_iterator(root / "reference/cookbook")) {
    if (entry.path().extension() != ".toml") continue;
    workplace().check("new", 2, {"\n  " + entry.path().stem().string() + " "});
    ++kinds;
  }
  CHECK(count(out, "\n") == kinds + 1);
  CHECK(kinds == 11);
}

TEST_CASE("in every kind of problem of the cookbook, one number agrees with a hand calculation") {
  const auto steps_of = [](const std::string& kind) {
    const workplace here;
    here.check("new " + kind, 0);
    here.check("run " + kind + ".toml --kernels corrected --strict --json out.json", 0, {}, {"!error"});
    return here.json("out.json")["steps"];
  };
  // After the bracket separates, moments about the left bearing give the column's reaction.
  const double weight = 78.5 * 1.491e-2;
  const double column = (weight * 12 * 6 + 75.0 * 2 + 75.0 * 4) / 6;
  check_like(steps_of("crane")[0], {{"name", "SLS left"},
                                    {"pairs", {{"0", {{"state", "separated"}}}}},
                                    {"reactions", {{"1", {{"value", column}}}}}});
  // The settlement is that of an infinite beam under the axle plus that under the self-weight.
  const double axle = -6.25 / 4e4 - 100 * decay(4e4, 4.3e4) / (2 * 4e4);
  check_like(steps_of("slab")[13], {{"name", "axle at 6"}, {"w", {{"120", axle}}}}, 1e-3);
  // The grout's force is the sum of the column's force and the bolts' forces.
  const auto plate = steps_of("base-plate")[1];
  CHECK(force_of(plate, "above") > 50.0);
  CHECK(force_of(plate, "below") == Approx(80.0 + force_of(plate, "above")).epsilon(1e-9));
  // The last rack has the reaction of a propped cantilever whose clamp rises.
  const auto racks = steps_of("racks");
  for (const auto& [step, rise] : {std::pair(1, 0.015), std::pair(2, 0.015 + 0.010)}) {
    const double force = 3 * 0.8 * 8 / 8 - 3 * 4772 * rise / (8 * 8 * 8);
    check_like(racks[step]["pairs"], {{"0", {{"state", "separated"}}}, {"1", {{"force", force}}}}, 1e-3);
  }
  // The middle bearing lifts a beam that bends and shears; the outer bearings sink.
  const double EI = 3.3e7 * 0.26667, GA = 1.375e7 * 0.66667;
  const double sinks = 5 * 400 * 1296.0 / 384 / EI + 400 * 36 / 8.0 / GA + 1200 / 1e8;
  const double lifted = (sinks - 5e-4) / (216 / 48.0 / EI + 6 / 4.0 / GA + 1.5 / 1e8);
  check_like(steps_of("deep-beam")[1]["pairs"], {{"2", {{"force", lifted}}}}, 1e-9);
  // The settlement under the wheel is that of an infinite beam.
  check_like(steps_of("rail")[1]["w"][24], -(0.6 + 112.5 * decay(5e4, 6380.0) / 2) / 5e4, 0.01);
  // Two sleepers carry the wheel and the rail, and the joint turns by its moment.
  const double turning = 58.05 * 0.3 - 1.8 * 1.5;
  check_like(steps_of("rail-joint")[1]["hinges"],
             {{"0", {{"hinge", 1}, {"x", 3}, {"moment", turning}, {"rotation", turning / 1500}}}}, 1e-9);
  // The pressed edge settles like that of a rigid footing with its load outside the kern.
  check_like(steps_of("bed")[1]["w"][30], -2 * 300.0 / (3 * (1.5 - 240.0 / 300.0)) / 5e4, 0.01);
  // If both girders have the same load, each girder of the grillage bends like a simple beam.
  check_like(steps_of("matrix")[0]["w"][6], -40.0 * 512 / (48 * 2.1e8 * 8.36e-5));
}

TEST_CASE("cpp/run.sh runs in the caller's folder, and returns the exit status of program or build") {
  const built_project project;
  const scratch_folder elsewhere;
  elsewhere.write("my own.toml", good_problem);
  project.check(elsewhere.path(), "run 'my own.toml' --json out.json", 0, {"equal to the bit"});
  CHECK(elsewhere.files() == texts{"my own.toml", "out.json"});
  project.check(elsewhere.path(), "run missing.toml", 2, {});
  project.tool("cmake", "echo no compiler is found; exit 1");
  project.check(elsewhere.path(), "kernels", 1, {"$no compiler is found\n"});
}

TEST_CASE("cpp/run.sh without arguments runs the reference problem PB7, whatever the current folder is") {
  const built_project project;
  project.check(project.root(), "", 0,
                {"building in build/release\n"
                 "build/release/contct run reference/problems/pb07-three-gap-supports.toml\n"
                 "\n"
                 "PB7  Simply supported beam over three gap supports\n"});
  const std::string root = fs::canonical(project.root()).string();
  project.check(scratch_folder().path(), "", 0,
                {root + "/build/release/contct run " + root + "/reference/problems/pb07",
                 "$8 calls, 64 values compared, 0 mismatches\n"
                 "the 1989 rule comes to the same states: every number agrees to 10 digits or more\n"
                 "all 4 final states are certified: this beam has no mesh error\nproved: 10 digits or more "
                 "of every number\n"});
}
