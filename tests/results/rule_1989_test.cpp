// Tests the comparison of the 1989 rule with the corrected rule: different events, and wrong states.
#include "contct/results/rule_1989.hpp"

#include <fmt/format.h>

#include "catch.hpp"
#include "contct/number/random.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/envelope.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/words.hpp"
#include "support/words.hpp"

using namespace contct;

namespace {

/// A problem, and its run by both rules.
struct both_rules {
  const problem what;
  const linear_structure structure = structure_of(what);
  contct::run run{what, structure, {.file = "p.toml", .both_rules = true}};

  explicit both_rules(problem p, const run_outputs& outputs = {}) : what(std::move(p)) { run.go(outputs); }
  explicit both_rules(const std::string& text, const run_outputs& outputs = {})
      : both_rules(parse_problem(text, "p.toml"), outputs) {}

  [[nodiscard]] const rule_1989& beside() const { return *run.result.beside; }
  [[nodiscard]] std::vector<state_difference> wrong() const {
    std::vector<state_difference> all;
    for (const state_difference& d : beside().differences)
      if (d.is_wrong()) all.push_back(d);
    return all;
  }
};

/// Random structures without pairs, on which the 1989 rule has no decision to make.
class without_pairs {
 public:
  /// A beam, clamped or on two supports, and on two more supports if it is not determinate.
  std::string beam(bool determinate) {
    const int n = 3 + below(12);
    std::string text = fmt::format("[beam]\nlength = {}\nelements = {}\nEI = {}\n", size(2), n, size(6));
    text += !determinate || below(2) == 0
                ? "[[support]]\nnode = 1\nfix = ['w', 'theta']\n"
                : fmt::format("[[support]]\nnodes = [1, {}]\nfix = 'w'\n", 2 + below(n - 1));
    if (!determinate) text += fmt::format("[[support]]\nnodes = [{}, {}]\nfix = 'w'\n", n / 2 + 1, n + 1);
    for (int steps = 1 + below(3); steps > 0; --steps) {
      text += fmt::format("[[step]]\npoint = [ {{ node = {}, theta = {} }}, {{ node = {}, theta = {} }} ]\n",
                          1 + below(n + 1), number(), 1 + below(n + 1), number());
      if (below(2) == 0) text += fmt::format("settlement = [ {{ node = 1, w = {} }} ]\n", number());
      if (below(2) == 0) text += fmt::format("curvature = [ {{ value = {} }} ]\n", number());
      if (below(4) == 0) text += fmt::format("uniform = {}\n", number());
    }
    return text;
  }

  std::string plate() {
    const int n = 1 + below(4);
    return fmt::format(
        "[plate]\nsize = [{}, {}]\nelements = [{}, {}]\nD = {}\nnu = 0.3\n[[support]]\nnodes = [1, {}, {}]\n"
        "fix = 'w'\n[[step]]\npoint = [ {{ node = 2, wx = {} }} ]\nsettlement = [ {{ node = 1, w = {} }} ]\n",
        size(1), size(1), n, n, size(5), n + 1, (n + 1) * (n + 1), number(), number());
  }

  /// A chain of springs, whose last dof is fixed and settles.
  problem chain() {
    assembled a;
    const int n = a.stiffness.order = 2 + below(20);
    double before = 0.0;
    for (int i = 0; i < n; ++i) {
      const double spring = i + 1 < n ? size(2) : 0.0;
      a.stiffness.entries.push_back({i, i, before + spring});
      if (i > 0) a.stiffness.entries.push_back({i, i - 1, -before});
      before = spring;
    }
    problem p;
    p.geometry = {a};
    p.supports = {{n - 1, 0, true}};
    load& l = p.steps.emplace_back();
    l.points = {{0, 0, number()}};
    l.settlements = {{n - 1, 0, number()}};
    return p;
  }

 private:
  random_numbers random_{1};
  int below(int n) { return random_.whole(0, n - 1); }
  double size(int decades) { return std::pow(10.0, decades * (2 * random_.unit() - 1)); }
  double number() { return (2 * random_.unit() - 1) * size(2); }
};

}  // namespace

TEST_CASE("on 300 structures without pairs, the 1989 rule differs by rounding, and no step is called wrong") {
  without_pairs random;
  int compared = 0;
  int rounded = 0;  // steps with a difference above a millionth of the largest number of the kind
  const auto take = [&](const both_rules& r) {
    CHECK(r.wrong().empty());
    for (const state_difference& d : r.beside().differences) {
      rounded += d.but_for_rounding ? 1 : 0;
      if (d.but_for_rounding)
        check_words(rule_1989_words(r.run.result).at(0),
                    {", but for numbers that are only rounding: ", " other "});
    }
    compared += static_cast<int>(r.beside().differences.size());
  };
  for (int i = 0; i < 180; ++i) take(both_rules(random.beam(true)));
  for (int i = 0; i < 60; ++i) take(both_rules(random.beam(false)));
  for (int i = 0; i < 30; ++i) take(both_rules(random.plate()));
  for (int i = 0; i < 30; ++i) take(both_rules(random.chain()));
  CHECK(compared > 400);
  CHECK(rounded > 40);
}

TEST_CASE("the report has an event of the 1989 rule alone with the next increment of the corrected rule") {
  const both_rules marked(read_input(CONTCT_REFERENCE "/problems/divergences/mark-toggled.toml"));
  const row_of_1989& first = marked.beside().rows.at(0).at(0);
  REQUIRE(first.otherwise.size() == 1);
  CHECK(first.otherwise[0].what == event{0, change::make});
  REQUIRE(marked.wrong().size() == 1);
  CHECK((marked.wrong()[0].at == "pair 1" && marked.wrong()[0].right == 0.0));
  CHECK(marked.wrong()[0].value == Approx(-5e4));  // stiffness 5e4 times distance 1
}

TEST_CASE("the ends of all steps, and the events up to the first end, are compared with the 1989 rule") {
  const std::string hinged =
      "[beam]\nlength = 1\nelements = 1\nEI = 1\n[[support]]\nnode = 1\nfix = 'w'\n[[contact]]\nnode = 2\n"
      "surface = 'below'\nstiffness = 10\nface = ";
  const std::string down = "point = [ { node = 2, w = -1 } ]\n";
  const std::string up = "[[step]]\npoint = [ { node = 2, w = 1 } ]\n";
  const std::string combined = "[[case]]\nname = 'G'\n" + down +
                               "[[combination]]\nname = 'up'\nterms = { G = -1 }\n"
                               "[[combination]]\nname = 'down'\nterms = { G = 1 }\n";
  const std::string same_way = "ends in the same way";
  for (const auto& [text, words] :
       {std::pair("0\n[[step]]\n" + down + up, same_way),
        {"0\n" + up, same_way},
        {"0\n" + combined, same_way},
        {"-1\n" + combined, "ends early (the answer does not depend on it): combination \"down\""},
        {"-1\n[[step]]\n" + down, "ends early (the answer does not depend on it): step 1"}}) {
    INFO(text);
    const both_rules r(hinged + text);
    REQUIRE(r.beside().end.status != path_status::solved);
    std::string lines;
    for (const std::string& line : rule_1989_words(r.run.result)) lines += line + "\n";
    check_words(lines.substr(0, lines.find('\n')), {words});
    CHECK((lines.find(same_way) == lines.rfind(same_way) &&
           (lines.find(same_way) < lines.size()) == (words == same_way)));
    CHECK(r.beside().same_events == (words == same_way));
    check_words(lines, {"!by other events"});
  }
}

TEST_CASE("the 1989 rule uses the engine refactor, but a faster one on large problems without a trace") {
  const auto square = [](int n) {
    return fmt::format(
        "[plate]\nsize = [1, 1]\nelements = [{0}, {0}]\nD = 1\nnu = 0.3\n[[bed]]\nmodulus = 1\nface = 0\n"
        "[[step]]\nuniform = -1\n",
        n);
  };
  CHECK(both_rules(square(4)).beside().engine == "refactor");
  const std::string large = square(40);
  CHECK(both_rules(large).beside().engine == "updated");
  std::string trace;
  output_file to(&trace);
  CHECK(both_rules(large, {.trace = &to}).beside().engine == "refactor");
  check_words(trace, {"\nkernel fortran\n"});
}

TEST_CASE(
    "Of more than 20 combinations the rules are compared in 20, the governing ones first, or in all on "
    "request") {
  const std::string text =
      "[beam]\nlength = 12\nelements = 12\nEI = 1e4\n[[support]]\nx = [0, 12]\nfix = 'w'\n[[contact]]\n"
      "x = 6\nsurface = 'below'\nface = -0.001\nstiffness = 1e5\n[[train]]\nname = 'axle'\n"
      "axles = [ { at = 0, w = -10 } ]\nfrom = 0\nto = 12\nby = 0.5\n";
  const both_rules some(text);
  const std::set<int>& only = some.beside().only;
  CHECK(only.size() == 20);
  CHECK(some.beside().record.steps.size() == 20);
  CHECK(some.beside().differences.size() == 20);
  REQUIRE(some.run.result.record.steps.size() == 25);
  const envelope e = envelope_of(some.run.result);
  for (const auto& v : e.values)
    CHECK((only.contains(v.at[0].least.step) && only.contains(v.at[0].most.step)));
  for (const solved_step& s : some.run.result.record.steps)
    CHECK(some.beside().rows[s.step - 1].empty() == !only.contains(s.step));
  const std::vector<std::string> lines = rule_1989_words(some.run.result);
  REQUIRE(lines.size() == 1);
  check_words(lines[0], {"in 20 of 25 combinations (all: --compare all)"});

  const problem p = parse_problem(text, "p.toml");
  const linear_structure s = structure_of(p);
  contct::run whole(p, s, {.file = "p.toml", .both_rules = true, .compare_all = true});
  whole.go({});
  CHECK(whole.result.beside->only.empty());
  CHECK(whole.result.beside->differences.size() == 25);
  check_words(rule_1989_words(whole.result)[0],
              {"in 25 combinations the 1989 rule comes to the same states"});
}
