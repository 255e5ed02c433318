// Tests the files that contct writes: report page, tables, grids and reports of tests; that progress is shown
// only on a terminal; and that large structures need little memory, which for a plate depends on its shorter
// side.
#include "app/outputs.hpp"

#include <cmath>
#include <sstream>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/good_problem.hpp"

using namespace contct;
namespace fs = std::filesystem;

namespace {

const std::string two_by_two =
    "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2\n2 1 -1\n2 2 2\n";

/// Returns a problem on the matrix K.mtx with these further keys of [matrix].
std::string spring_problem(const std::string& keys = "") {
  return "[matrix]\nstiffness = 'K.mtx'\n" + keys +
         "[[contact]]\ndof = '2'\nsurface = 'below'\nface = -0.5\nstiffness = 10\n"
         "[[step]]\npoint = [ { dof = '2', value = -3 } ]\n";
}

nlohmann::json data_of(const std::string& html) {
  const std::size_t from = html.find("id=\"data\">") + 10;
  return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

const std::string erased = "\r\033[K";

/// Commands that show progress, each with a text that it must show.
const std::pair<std::string, std::string> long_works[] = {
    {"run plate.toml", "step 2 of 2, increment "},
    {"explain plate.toml --json /dev/null", "step 2 of 2, increment "},
    {"exact plate.toml", "step 2 of 2, increment "},
    {"verify --reference @", " problems"},
    {"fuzz --calls 2000", " % of "},
    {"replay @traces/ties.trace", "ties.trace: 1 call"}};

/// Returns options for standard error on a terminal, with progress at once. `both`: with standard output.
process_options at_terminal(bool both = false) {
  return {"", {{"TERM", "dumb"}, {"CONTCT_PROGRESS_AFTER", "0"}}, both, "", true};
}

/// Returns the numbers `from`, `from` + `by`, .. up to `to` as a list.
std::string every(int from, int to, int by) {
  std::string list;
  for (int i = from; i <= to; i += by) list += std::to_string(i) + ", ";
  return list;
}

/// Returns a plate of 3000 by 2 elements that is supported at every tenth line across the plate, and sags
/// onto a stop in every fiftieth span.
std::string strip(bool along_x) {
  const std::string size = along_x ? "[3000, 2]" : "[2, 3000]";
  const int next = along_x ? 1 : 3;    // from a line across to the next
  const int row = along_x ? 3001 : 1;  // from a node of a line to the next
  std::string supported;
  for (int i = 1; i <= 3; ++i)
    supported += every(1 + (i - 1) * row, 1 + (i - 1) * row + 3000 * next, 10 * next);
  return "[plate]\nsize = " + size + "\nelements = " + size +
         "\nD = 1\nnu = 0.3\n[[support]]\nfix = 'w'\nnodes = [" + supported + "]\n[[contact]]\nnodes = [" +
         every(1 + row + 5 * next, 1 + row + 3000 * next, 500 * next) +
         "]\nsurface = 'below'\nface = -0.01\nstiffness = 100\n[[step]]\nuniform = -0.001\n";
}

nlohmann::json steps_of(const std::string& text, long most_kib) {
  const workplace here({{"large.toml", text}});
  const finished f = here.contct("run large.toml --json large.json");
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
#if !defined(__SANITIZE_ADDRESS__)
  CHECK(f.peak_kib < most_kib);
#else
  (void)most_kib;
#endif
  return here.json("large.json")["steps"];
}

}  // namespace

TEST_CASE("contct run writes the files that it names, and an output - alone on standard output") {
  const workplace here({{"pb.toml", good_problem}});
  here.check("run pb.toml --html -", 0, {"^<!DOCTYPE html>"});
  here.check("run pb.toml --csv -", 0, {"^step,increment,"});
  const finished f = here.contct("run - --json -", {good_problem, {}, false});
  CHECK(nlohmann::json::parse(f.out)["status"] == "solved");
  CHECK(here.files() == texts{"pb.toml"});  // no table of pairs is written
  here.check("run pb.toml --html o.html --csv o.csv --vtu o.vtu", 0, {"equal to the bit"});
  CHECK(here.files() == texts{"o.000.vtu", "o.001.vtu", "o.002.vtu", "o.csv", "o.html", "o.pairs.csv",
                              "o.pvd", "o.states.csv", "o.supports.csv", "o.vtu", "pb.toml"});
  here.check("run pb.toml --quiet --csv e.csv --envelope", 0, {""});
  check_words(here.read("e.envelope.csv"), {"x,w_min,w_min_step,w_max,w_max_step,moment_min"});
}

TEST_CASE("the report page has the JSON result, the structure, the states within steps and the calls") {
  for (const std::string file :
       {"pb01-cantilever-tip-stop", "pb07-three-gap-supports", "pp03d-corners-and-settled-stop-n4"}) {
    const workplace here;
    here.check("run @problems/" + file + ".toml --json o.json --html o.html", 0, {}, {"!error"});
    const auto result = here.json("o.json");
    const auto data = data_of(here.read("o.html"));
    check_like(data, result, 0.0);
    for (const char* more : {"file", "date", "words", "structure", "calls_made", "log", "log_bytes"})
      CHECK(data.contains(more));
    CHECK(data["calls"].size() == result["lockstep"]["calls"]);
    CHECK(data["structure"]["pairs"].size() == result["steps"][0]["pairs"].size());
    for (const auto& step : data["steps"]) {
      CHECK((step.contains("load") && step.contains("largest")));
      for (std::size_t i = 0; i < step["increments"].size(); ++i) {
        const auto& state = i + 1 < step["increments"].size() ? step["increments"][i] : step;
        CHECK(state["displacement"].size() == step["displacement"].size());
        CHECK(state["elements"].size() == step["elements"].size());
        CHECK(step["increments"][i].contains("displacement") == (i + 1 < step["increments"].size()));
      }
    }
  }
}

TEST_CASE("the report page has the date of the run, or the date in SOURCE_DATE_EPOCH if this is set") {
  const workplace here({{"pb.toml", good_problem}});
  std::vector<nlohmann::json> dates;
  texts pages;
  for (const process_options& o :
       {process_options{"", {{"SOURCE_DATE_EPOCH", "86460"}}}, {"", {{"SOURCE_DATE_EPOCH", "86460"}}}, {}}) {
    here.check("run pb.toml --html o.html", 0, {}, {}, o);
    pages.push_back(here.read("o.html"));
    dates.push_back(data_of(pages.back())["date"]);
  }
  CHECK(dates[0] == "1970-01-02 00:01 UTC");
  CHECK(pages[1] == pages[0]);
  CHECK(dates[2].get<std::string>().starts_with("20"));
}

TEST_CASE("if standard output is full or closed, contct run writes the output files, and has exit status 2") {
  const workplace here({{"pb.toml", good_problem}});
  for (const std::string output : {"/dev/full", "closed"}) {
    const process_options full{"", {}, false, output};
    for (const char* line :
         {"run pb.toml", "run pb.toml --json -", "kernels", "--help", "run --help", "--version"})
      here.check(line, 2, {}, {"standard output: "}, full);
    const std::string file = output.substr(output.size() - 4);
    CHECK(here.contct("run pb.toml --json " + file, full).exit == 2);
    CHECK(here.json(file)["status"] == "solved");
  }
}

TEST_CASE("contct run writes the whole report page of --html, even if a pipe to head cuts off the table") {
  std::string text = good_problem;
  for (int i = 0; i < 2000; ++i) text += "[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n";
  const workplace here({{"long.toml", text}});
  CHECK(shell("cd '" + here.path().string() +
              "' && '" CONTCT_PROGRAM
              "' run long.toml --html page.html --csv table.csv 2>errors | head -1 >table")
            .exit == 0);
  check_words(here.read("table"), {"nodes, 1 pair, 2001 steps"});
  check_words(here.read("errors"), {""});
  check_words(here.read("page.html"), {"</html>"});
  check_words(here.read("table.csv"), {"^step,"});
}

TEST_CASE("a matrix without coordinates has a page and tables, and --vtu needs coordinates of pairs") {
  const workplace here({{"K.mtx", two_by_two},
                        {"p.toml", spring_problem()},
                        {"K.dof", "a.x\n2\n"},
                        {"K.xyz", "a 1 2 3\n"},
                        {"placed.toml", spring_problem("dofs = 'K.dof'\ncoordinates = 'K.xyz'\n")}});
  here.check("run p.toml --html o.html --csv o.csv", 0);
  here.check("run p.toml --vtu o.vtu --json o.json", 2, {},
             {"--vtu: found the matrix K.mtx without coordinates; allowed:",
              "coordinates = \"FILE\" in [matrix]", "mesh = \"FILE\" in [calculix]", "--csv and --json"});
  here.check("run placed.toml --vtu p.vtu --html p.html", 0, {},
             {"warning: --vtu: 1 of 1 pairs has no cell: the coordinates of their dofs are not known"});
  check_words(here.read("o.html"), {"\"nodes\":[]", "\"dofs\":[{\"dof\":\"1\"}", "\"engine\": \"updated\""});
  check_words(here.read("o.pairs.csv"), {"\r\n1,1,1,2,below,contact,"});
  check_words(here.read("p.html"), {"1 of 2 dofs are not drawn: their labels"});
}

TEST_CASE("reports of tests count failed and skipped tests, and a test's text keeps XML and Markdown valid") {
  const check_report report{
      "contct replay",
      {"floating point: strict"},
      {{"a.trace: cpp", outcome::passed, "equal", ""},
       {"b <&> \"c\".trace: mine", outcome::failed, "1 mismatch | here", "call 1: SS(1)\n\x01 odd"},
       {"c.trace: cpp", outcome::skipped, "another precision", ""}},
      0.5};
  check_words(junit_xml(report),
              {"<testsuites tests=\"3\" failures=\"1\" errors=\"0\" time=\"0.500\">",
               " tests=\"3\" failures=\"1\" errors=\"0\" time=\"0.500\" skipped=\"1\">",
               "name=\"b &lt;&amp;&gt; &quot;c&quot;.trace: mine\"",
               "<failure message=\"1 mismatch | here\">call 1: SS(1)\n\xEF\xBF\xBD odd</failure>",
               "<skipped message=\"another precision\"/>", "!\x01"});
  check_words(junit_xml({"two\nlines", {}, {}, 0.0}), {"<testsuite name=\"two&#10;lines\" tests=\"0\""});
  check_words(markdown(report), {"^## contct replay: failed\n", "1 passed, 1 failed, 1 skipped",
                                 "| **failed** | 1 mismatch \\| here |", "```\ncall 1: SS(1)"});
}

TEST_CASE("long commands show progress on a terminal and erase it, or with --quiet show nothing") {
  const workplace here;
  here.check("new plate", 0);
  for (const auto& [line, shows] : long_works) {
    const finished f = here.contct(line, at_terminal());
    INFO(line);
    CHECK(f.exit == 0);
    check_words(f.err, {shows, "$" + erased, "!\n"});
    check_words(f.out, {"!\r"});
    here.check(line + " --quiet", 0, {""}, {""}, at_terminal());
  }
  here.check("run plate.toml", 0, {}, {},
             {"", {{"CONTCT_PROGRESS_AFTER", "0"}}});  // standard error is a file
}

TEST_CASE("on a terminal with the table, the progress is erased before each row of the table") {
  const workplace here;
  here.check("new plate", 0);
  const std::string run = "run plate.toml --kernels corrected";
  const std::string seen = here.contct(run, at_terminal(true)).out;
  check_words(seen, {"step 2 of 2, increment "});
  // The text that remains visible: an erase sequence removes the part of the line before the sequence.
  std::string screen;
  std::istringstream lines(seen.substr(0, seen.rfind('\n') + 1));
  for (std::string line; std::getline(lines, line); screen += line + "\n") {
    if (line.ends_with("\r")) line.pop_back();
    if (const std::size_t last = line.rfind(erased); last != std::string::npos) line.erase(0, last + 4);
  }
  CHECK(screen == here.contct(run).out);
}

TEST_CASE("a run of a plate of 3000 by 2 elements takes under 62 MB, as that of a plate of 2 by 3000") {
  const auto lying = steps_of(strip(true), 62'000)[0];
  const auto standing = steps_of(strip(false), 62'000)[0];
  check_like(lying, R"({"w": "== 9003", "elements": "== 6000"})");
  for (int i = 0; i < 6; ++i) {
    CHECK(lying["pairs"][i]["state"] == "contact");
    check_like(lying["pairs"][i]["force"], standing["pairs"][i]["force"], 1e-8);
  }
  for (int along = 0; along < 3001; ++along) {
    for (int across = 0; across < 3; ++across) {
      const double a = lying["w"][across * 3001 + along];
      const double b = standing["w"][along * 3 + across];
      if (std::abs(a - b) > 1e-9) FAIL("line " << along << ": " << a << " against " << b);
    }
  }
}

TEST_CASE("a plate of 100 by 100 elements takes under 462 MB, and a beam of 100,000 nodes under 200 MB",
          "[long]") {
  const auto step = steps_of(
      "[plate]\nsize = [1, 1]\nelements = [100, 100]\nD = 1\nnu = 0.3\n[[support]]\nnodes = '1..101'\n"
      "fix = ['w', 'wx']\n[[support]]\nnodes = '10101..10201'\nfix = ['w', 'wx']\n[[step]]\nuniform = -1\n",
      462'000)[0];
  // Two edges are simply supported and two free, so the plate bends along y with 0.01309 q a^4 / D in the
  // middle.
  check_like(step["w"][5100], -0.01309, 1e-3);
  CHECK(step["elements"].size() == 10000);
  const auto steps =
      steps_of("[beam]\nEI = 1.0\nx = [" + every(0, 99999, 1) + "]\n[[support]]\nfix = 'w'\nnodes = [" +
                   every(1, 100000, 9) + "]\n[[contact]]\nnodes = [" + every(5, 99999, 9000) +
                   "]\nsurface = 'below'\nface = -0.01\nstiffness = 1.0\n"
                   "[[step]]\nuniform = -0.001\n[[step]]\nuniform = 0\n",
               200'000);
  REQUIRE(steps.size() == 2);
  CHECK(steps[0]["w"].size() == 100000);
  CHECK(steps[0]["elements"].size() == 99999);
  CHECK(steps[0]["pairs"].size() == 12);
  for (const auto& pair : steps[0]["pairs"]) CHECK(pair["state"] == "contact");
  for (const auto& pair : steps[1]["pairs"]) CHECK(pair["state"] == "separated");
}

TEST_CASE("The names of supports, pairs and beds are in every output of contct run") {
  const workplace here;
  here.write(
      "named.toml",
      "project = 'Hall 3'\n[beam]\nlength = 12\nelements = 12\nEI = 1e4\n[[support]]\nx = [0, 12]\n"
      "fix = 'w'\nname = ['north', 'south']\n[[contact]]\nx = 6\nsurface = 'below'\nface = -0.001\n"
      "stiffness = 1e4\nname = 'stop'\n[[bed]]\nfrom = 1\nto = 4\nmodulus = 100\nface = 0\nname = 'soil'\n"
      "[[step]]\nuniform = -10\n");
  here.check("run named.toml --detail --csv t.csv --json t.json --html t.html", 0,
             {"make 1: stop, node 7 below", "pair 1, stop, node 7 below", "bed 1, soil", "south"});
  const std::vector<std::string> names = {"north", "south", "stop", "soil"};
  for (const auto& [file, all] : {std::pair("t.supports.csv", names),
                                  {"t.pairs.csv", {"stop", "soil"}},
                                  {"t.json", names},
                                  {"t.html", names}})
    for (const std::string& name : all) {
      INFO(file << " " << name);
      CHECK(count(here.read(file), name) > 0);
    }
  CHECK(count(here.read("t.html"), "Hall 3") > 0);
  here.check("explain named.toml", 0, {"stop, node 7"});
}

TEST_CASE("In combinations in which the 1989 rule was not followed, no increment says that it is the same") {
  const workplace here;
  here.write("places.toml",
             "[beam]\nlength = 12\nelements = 12\nEI = 1e4\n[[support]]\nx = [0, 12]\nfix = 'w'\n"
             "[[contact]]\nx = 6\nsurface = 'below'\nface = -0.001\nstiffness = 1e5\n[[train]]\n"
             "name = 'axle'\naxles = [ { at = 0, w = -10 } ]\nfrom = 0.5\nto = 11.5\nby = 0.25\n");
  const std::string some = here.contct("run places.toml --detail").out;
  CHECK(count(some, "  same  ") > 0);
  CHECK(count(some, "  -  ") > 0);
  CHECK(count(some, "  ended  ") == 0);
  const std::string whole = here.contct("run places.toml --detail --compare all").out;
  CHECK(count(whole, "  same  ") == count(some, "  same  ") + count(some, "  -  "));
  for (const std::string other : {"--kernels cpp", "--free-run", "--final-only"})
    here.check("run places.toml --compare all " + other, 2, {}, {"--compare"});
}
