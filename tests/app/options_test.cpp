// Tests options as parsed from a command line, and the messages and exit statuses for the end of a path,
// without running the program.
#include <tuple>

#include "app/commands.hpp"
#include "app/problem_runs.hpp"
#include "app/process.hpp"
#include "catch.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;

namespace {

/// Parses the words of a line after the name of the program.
template <class Parse>
auto parsed_by(Parse parser, const std::string& line) {
  const texts all = words_of("contct " + line);
  std::vector<const char*> arguments;
  for (const std::string& word : all) arguments.push_back(word.c_str());
  return parser(static_cast<int>(arguments.size()), arguments.data());
}

command_options parse(const std::string& line) {
  const auto parser = [](int n, const char* const* a) { return parse_contct(n, a, {"refactor", "updated"}); };
  return parsed_by(parser, line);
}

/// Returns the parsed options; the test fails if the line parses as another command.
template <class Options>
Options parsed(const std::string& line) {
  const command_options asked = parse(line);
  REQUIRE(std::holds_alternative<Options>(asked));
  return std::get<Options>(asked);
}

/// A beam with pairs at nodes 2 to 11.
const char* const ten_pairs =
    "[beam]\nlength = 10\nelements = 10\nEI = 1\n[[support]]\nnode = 1\nfix = ['w', 'theta']\n[[contact]]\n"
    "nodes = '2..6'\nsurface = 'below'\nface = -1\nstiffness = 1\n[[contact]]\nnodes = '7..11'\n"
    "surface = 'above'\nface = 1\nstiffness = 1\n[[step]]\nuniform = 1\n";

}  // namespace

TEST_CASE("contct run accepts its options in any order, and an option that is not given has no value") {
  const auto all_of = [](const run_options& o) {
    return std::tuple(o.file, o.kernels, o.engine, o.max_increments,
                      texts{o.csv, o.vtu, o.html, o.json, o.log, o.trace, o.report.junit, o.report.markdown},
                      std::vector<bool>{o.strict, o.free_run, o.report.quiet, o.refine, o.final_only});
  };
  CHECK(all_of(parsed<run_options>("run beam.toml")) ==
        std::tuple("beam.toml", texts{}, "", 0, texts(8), std::vector<bool>(5)));
  CHECK(all_of(parsed<run_options>(
            "run --kernels cpp,corrected --strict beam.toml --max-increments=7 --csv c --vtu v.vtu --html h "
            "--json j --log l "
            "--trace t --junit u --markdown m --quiet --engine auto --free-run --refine")) ==
        std::tuple("beam.toml", texts{"cpp", "corrected"}, "auto", 7,
                   texts{"c", "v.vtu", "h", "j", "l", "t", "u", "m"},
                   std::vector<bool>{true, true, true, true, false}));
  CHECK(parsed<run_options>("run f --final-only --json j --strict").final_only);
  CHECK_FALSE(parsed<explain_options>("explain f").step.has_value());
  CHECK(parsed<explain_options>("explain f --step 0").step == 0);
  CHECK(parsed<explain_options>("explain f --increment 2.1").increment == "2.1");
  CHECK_FALSE(parsed<fuzz_options>("fuzz").problems.has_value());
  CHECK(parsed<fuzz_options>("fuzz --problems 0").problems == 0);
}

TEST_CASE("contct refuses an unknown command or option, and suggests a similar name if there is one") {
  for (const auto& [line, message] :
       {std::pair(
            "rnu",
            "\"rnu\" is not a command of contct (did you mean \"run\"?); the commands are: run, check, "),
        {"--versoin", "\"--versoin\" is not an option of contct (did you mean \"--version\"?)"},
        {"crane.toml",
         "\"crane.toml\" is not a command of contct; to run a problem file: contct run crane.toml\n"},
        {"walk", "\"walk\" is not a command of contct; the commands are: "},
        {"", "a command is missing; the commands are: "}})
    CHECK_THROWS_WITH(parse(line), StartsWith(message));
  CHECK_THROWS_WITH(parse("run f --josn=x"), Contains("--josn=x") && Contains("(did you mean \"--json\"?)"));
  CHECK_THROWS_WITH(parse("run"), Contains("FILE is required") && Contains("Run with --help"));
  // A run without a path has none of these options.
  for (const std::string option : {"--free-run", "--kernels cpp", "--engine auto", "--trace t", "--log l",
                                   "--html h", "--csv c", "--vtu v.vtu", "--max-increments 3"})
    CHECK_THROWS_WITH(parse("run f --final-only " + option),
                      Contains("excludes") && Contains(words_of(option)[0]) && Contains("--final-only"));
}

TEST_CASE("contct-replay has the same options as contct replay") {
  const std::string line = "--kernel fortran,cpp a.trace b.trace --junit j --json f";
  for (const replay_options& o : {parsed<replay_options>("replay " + line),
                                  std::get<replay_options>(parsed_by(parse_contct_replay, line))}) {
    CHECK(std::tuple(o.kernels, o.traces, o.report.junit, o.json) ==
          std::tuple(texts{"fortran", "cpp"}, texts{"a.trace", "b.trace"}, "j", "f"));
  }
  CHECK_THROWS_WITH(parsed_by(parse_contct_replay, "a.trace --junti j"),
                    Contains("(did you mean \"--junit\"?)") && !Contains("the commands are"));
}

TEST_CASE("the message about a path that fails has the step, the share, the pairs and the remedy") {
  const auto ended = [](path_status status, std::vector<int> pairs = {}, bool by_1989_rule = false,
                        std::optional<bool> has_equilibrium = {}) {
    path_end end;
    end.status = status;
    end.step = 3;
    end.fraction = 0.25;
    end.pairs = std::move(pairs);
    end.by_1989_rule = by_1989_rule;
    end.has_equilibrium = has_equilibrium;
    return end;
  };
  const std::vector<int> eight = {0, 1, 2, 3, 4, 5, 6, 7}, ten = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::pair<path_end, texts> rows[] = {
      {ended(path_status::mechanism, {0, 9}),
       {"no equilibrium", "pair 1 (node 2, below), pair 10 (node 11, above)"}},
      {ended(path_status::mechanism), {"a rigid-body motion", "Add a support", "!--kernels"}},
      {ended(path_status::cycle, {9}), {"pair 10 (node 11, above)"}},
      {ended(path_status::cycle, ten), {"pair 8 (", " and 2 more", "!pair 9 ("}},
      {ended(path_status::cycle, eight), {"pair 8 (", "!more"}},
      {ended(path_status::iteration_limit), {"$the limit of increments (--max-increments) is reached"}},
      {ended(path_status::not_factored), {"ill-conditioned"}},
      {ended(path_status::path_ended, {0}, true),
       {"when pair 1 (node 2, below) separated, nothing held the structure", "!--kernels",
        "$is not decided"}},
      {ended(path_status::path_ended, {0}, true, true),
       {"$There is an equilibrium under the load of this step: --kernels corrected reaches it"}},
      {ended(path_status::path_ended, {0}, false, true),
       {"$There is an equilibrium under the load of this step"}},
      {ended(path_status::cycle, {9}, false, false),
       {"$There is no equilibrium under the load of this step"}}};
  for (const auto& [end, pieces] : rows) {
    const std::string text = end_words(parse_problem(ten_pairs, "ten.toml"), end);
    check_words(text, {"^step 3, at share 0.25 of its load: "});
    check_words(text, pieces);
  }
}

TEST_CASE("contct run has the same exit status for every path that ends before its load is applied") {
  for (const path_status status : {path_status::path_ended, path_status::cycle, path_status::iteration_limit})
    CHECK(status_of(status) == exit_status::iteration_limit);
}

TEST_CASE("if a step has fewer than five correct digits, contct run warns about the step with the fewest") {
  run_recorder seen;
  for (const auto& [step, rcond, words] : {std::tuple(1, 1e-3, ""),
                                           {2, 1e-13, "step 2: "},
                                           {3, 1e-9, "step 2: "},
                                           {4, 1e-17, "step 4: no digit "}}) {
    seen.take({{{.step = step, .fraction = 1.0}}});
    seen.steps.back().rcond = rcond;
    const std::string warning = digit_warning(seen.steps);
    check_words(warning, {"^" + std::string(words)});
    CHECK(warning.empty() == (step == 1));
    CHECK((warning.find("rcond 1.0e-13") != std::string::npos) == (step == 2 || step == 3));
  }
}
