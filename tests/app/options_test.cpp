// Tests the options of contct and contct-replay as parsed from a command line.
#include <algorithm>
#include <string>
#include <vector>

#include "app/commands.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

using words = std::vector<std::string>;
const words engines = {"refactor", "updated"};

std::vector<const char*> arguments_of(const words& line) {
  std::vector<const char*> arguments;
  for (const std::string& word : line) arguments.push_back(word.c_str());
  return arguments;
}

command_options parse(words line) {
  line.insert(line.begin(), "contct");
  return parse_contct(static_cast<int>(line.size()), arguments_of(line).data(), engines);
}

/// Returns the parsed options; the test fails if the line parses as another command.
template <class Options>
Options parsed(const words& line) {
  const command_options asked = parse(line);
  REQUIRE(std::holds_alternative<Options>(asked));
  return std::get<Options>(asked);
}

/// Returns the message for an invalid command line.
std::string refusal(const words& line) {
  try {
    (void)parse(line);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE(
    "a command line of contct run without options is parsed as one with no kernels and no output files") {
  const auto o = parsed<run_options>({"run", "beam.toml"});
  CHECK(o.file == "beam.toml");
  CHECK(o.kernels.empty());
  CHECK(o.engine.empty());
  CHECK(o.json.empty());
  CHECK(o.log.empty());
  CHECK(o.trace.empty());
  CHECK(o.html.empty());
  CHECK(o.vtu.empty());
  CHECK(parsed<run_options>({"run", "f", "--refine"}).refine);
  CHECK_FALSE((o.refine || o.free_run || o.final_only || o.strict || o.report.quiet));
  CHECK(o.max_increments == 0);
}

TEST_CASE("contct run accepts its options in any order") {
  const auto o = parsed<run_options>(
      {"run",     "--kernels", "cpp,corrected", "--strict", "beam.toml", "--max-increments=7",
       "--csv",   "c",         "--vtu",         "v.vtu",    "--html",    "h",
       "--json",  "j",         "--log",         "l",        "--trace",   "t",
       "--junit", "u",         "--markdown",    "m",        "--quiet",   "--engine",
       "auto",    "--free-run"});
  CHECK(o.kernels == words{"cpp", "corrected"});
  CHECK(o.file == "beam.toml");
  CHECK(words{o.csv, o.vtu, o.html} == words{"c", "v.vtu", "h"});
  CHECK(words{o.json, o.log, o.trace, o.report.junit, o.report.markdown} == words{"j", "l", "t", "u", "m"});
  CHECK((o.strict && o.free_run && o.report.quiet));
  CHECK(o.engine == "auto");
  CHECK(o.max_increments == 7);
}

TEST_CASE("contct run refuses --final-only together with any option that needs a path") {
  CHECK(parsed<run_options>({"run", "f", "--final-only", "--json", "j", "--strict"}).final_only);
  const std::vector<words> of_a_path = {{"--free-run"},   {"--kernels", "cpp"}, {"--engine", "auto"},
                                        {"--trace", "t"}, {"--log", "l"},       {"--html", "h"},
                                        {"--csv", "c"},   {"--vtu", "v.vtu"},   {"--max-increments", "3"}};
  for (const words& option : of_a_path) {
    words line = {"run", "f", "--final-only"};
    line.insert(line.end(), option.begin(), option.end());
    CHECK_THAT(refusal(line), Contains("excludes") && Contains(option[0]) && Contains("--final-only"));
  }
}

TEST_CASE("the parser distinguishes an option that is not given from an option with the value 0") {
  CHECK_FALSE(parsed<explain_options>({"explain", "f"}).step.has_value());
  CHECK(parsed<explain_options>({"explain", "f", "--step", "0"}).step == 0);
  CHECK(parsed<explain_options>({"explain", "f", "--increment", "2.1"}).increment == "2.1");
  CHECK_FALSE(parsed<fuzz_options>({"fuzz"}).problems.has_value());
  CHECK(parsed<fuzz_options>({"fuzz", "--problems", "0"}).problems == 0);
}

TEST_CASE("the options --help and --version print a text instead of running a command") {
  const auto help = parsed<printed_text>({"--help"}).text;
  for (const char* command :
       {"run", "check", "explain", "exact", "new", "verify", "fuzz", "replay", "kernels"})
    CHECK_THAT(help, Contains("\n  " + std::string(command) + " "));
  CHECK_THAT(help, Contains("Examples:\n  contct run beam.toml\n"));
  CHECK_THAT(parsed<printed_text>({"run", "--help"}).text, Contains("--max-increments"));
  CHECK_THAT(parsed<printed_text>({"--version"}).text, StartsWith("contct ") && Contains("listing sha256 "));
}

TEST_CASE("contct refuses an unknown command or option, and suggests a similar name if there is one") {
  CHECK_THAT(refusal({"rnu"}),
             StartsWith("\"rnu\" is not a command of contct (did you mean \"run\"?); the commands "
                        "are: run, check, explain, "));
  CHECK_THAT(refusal({"--versoin"}),
             StartsWith("\"--versoin\" is not an option of contct (did you mean \"--version\"?)"));
  CHECK_THAT(refusal({"crane.toml"}),
             StartsWith("\"crane.toml\" is not a command of contct; to run a problem "
                        "file: contct run crane.toml\n"));
  CHECK_THAT(refusal({"walk"}), !Contains("did you mean"));
  CHECK_THAT(refusal({}), StartsWith("a command is missing; the commands are: "));
  CHECK_THAT(refusal({"run", "f", "--josn=x"}),
             Contains("--josn=x") && Contains("(did you mean \"--json\"?)"));
  CHECK_THAT(refusal({"run"}), Contains("FILE is required") && Contains("Run with --help"));
}

TEST_CASE("contct-replay has the same options as contct replay") {
  const words after = {"--kernel", "fortran,cpp", "a.trace", "b.trace", "--junit", "j"};
  const auto of_contct = [&] {
    words line = {"replay"};
    line.insert(line.end(), after.begin(), after.end());
    return parsed<replay_options>(line);
  }();
  words line = {"contct-replay"};
  line.insert(line.end(), after.begin(), after.end());
  const auto alone =
      std::get<replay_options>(parse_contct_replay(static_cast<int>(line.size()), arguments_of(line).data()));
  for (const replay_options& o : {of_contct, alone}) {
    CHECK(o.kernels == words{"fortran", "cpp"});
    CHECK(o.traces == words{"a.trace", "b.trace"});
    CHECK(o.report.junit == "j");
  }
  const std::vector<const char*> wrong = {"contct-replay", "a.trace", "--junti", "j"};
  CHECK_THROWS_WITH(parse_contct_replay(static_cast<int>(wrong.size()), wrong.data()),
                    Contains("(did you mean \"--junit\"?)") && !Contains("the commands are"));
}
