// Tests the comparison of the 1989 rule with the corrected rule: different events, and wrong states.
#include "contct/session/rule_1989.hpp"

#include <fmt/format.h>

#include <string>

#include "catch.hpp"
#include "contct/number/random.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/words.hpp"
#include "read/bad_inputs.hpp"

using namespace contct;
using Catch::Matchers::Contains;

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

std::string divergence(const std::string& name) {
  return read_input(CONTCT_REFERENCE "/problems/divergences/" + name + ".toml");
}

/// Returns a plate on a bed with this number of elements along each side.
std::string square(int elements) {
  const std::string n = std::to_string(elements);
  return "[plate]\nsize = [1, 1]\nelements = [" + n + ", " + n +
         "]\nD = 1\nnu = 0.3\n[[bed]]\nmodulus = 1\nface = 0\n[[step]]\nuniform = -1\n";
}

/// Random structures without pairs, on which the 1989 rule has no decision to make.
class without_pairs {
 public:
  explicit without_pairs(std::uint64_t seed) : random_(seed) {}

  /// A beam clamped at one end, on two supports, or, if not determinate, clamped and on two supports.
  std::string beam(bool determinate) {
    const int n = 3 + below(12);
    std::string text =
        fmt::format("[beam]\nlength = {}\nelements = {}\nEI = {}\n[[support]]\n", size(2), n, size(6));
    const bool clamped = !determinate || below(2) == 0;
    const int end = clamped ? 1 : 2 + below(n - 1);
    text +=
        clamped ? "node = 1\nfix = [\"w\", \"theta\"]\n" : fmt::format("nodes = [1, {}]\nfix = \"w\"\n", end);
    if (!determinate) text += fmt::format("[[support]]\nnodes = [{}, {}]\nfix = \"w\"\n", n / 2 + 1, n + 1);
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
        "fix = \"w\"\n[[step]]\npoint = [ {{ node = 2, wx = {} }} ]\nsettlement = [ {{ node = 1, w = {} }} "
        "]\n",
        size(1), size(1), n, n, size(5), n + 1, (n + 1) * (n + 1), number(), number());
  }

  /// A chain of springs, whose last dof is fixed and settles.
  problem chain() {
    assembled a;
    a.stiffness.order = 2 + below(20);
    double before = 0.0;
    for (int i = 0; i < a.stiffness.order; ++i) {
      const double spring = i + 1 < a.stiffness.order ? size(2) : 0.0;
      a.stiffness.entries.push_back({i, i, before + spring});
      if (i > 0) a.stiffness.entries.push_back({i, i - 1, -before});
      before = spring;
    }
    problem p;
    p.geometry = {a};
    p.supports = {{a.stiffness.order - 1, 0, true}};
    load& l = p.steps.emplace_back();
    l.points = {{0, 0, number()}};
    l.settlements = {{a.stiffness.order - 1, 0, number()}};
    return p;
  }

 private:
  random_numbers random_;
  int below(int n) { return random_.whole(0, n - 1); }
  double size(int decades) { return std::pow(10.0, decades * (2 * random_.unit() - 1)); }
  double number() { return (2 * random_.unit() - 1) * size(2); }
};

}  // namespace

TEST_CASE(
    "on 700 structures without pairs, the 1989 rule differs by rounding, and no step of it is called wrong") {
  without_pairs random(1);
  int compared = 0;
  int rounded = 0;  // steps with a difference above a millionth of the largest number of the kind
  const auto take = [&](const both_rules& r) {
    CHECK(r.wrong().empty());
    for (const state_difference& d : r.beside().differences) {
      rounded += d.but_for_rounding ? 1 : 0;
      if (d.but_for_rounding)
        CHECK_THAT(rule_1989_words(r.run.result).at(0),
                   Contains(", but for numbers that are only rounding: ") && Contains(" other "));
    }
    compared += static_cast<int>(r.beside().differences.size());
  };
  for (int i = 0; i < 500; ++i) take(both_rules(random.beam(true)));
  for (int i = 0; i < 100; ++i) take(both_rules(random.beam(false)));
  for (int i = 0; i < 50; ++i) take(both_rules(random.plate()));
  for (int i = 0; i < 50; ++i) take(both_rules(random.chain()));
  CHECK(compared > 1000);
  CHECK(rounded > 100);
}

TEST_CASE("events at the same share in another order do not count as a difference of the 1989 rule") {
  const both_rules pb7(read_input(CONTCT_REFERENCE "/problems/pb07-three-gap-supports.toml"));
  CHECK(pb7.run.result.kernels == std::vector<std::string>{"corrected", "fortran", "cpp"});
  CHECK(pb7.beside().same_events);
  CHECK(pb7.beside().differences.size() == 4);
  CHECK(pb7.wrong().empty());
  CHECK(pb7.beside().compared.calls() == 8);
  CHECK(pb7.beside().compared.compared().mismatches == 0);
  CHECK_THAT(rule_1989_words(pb7.run.result).at(0), Contains("comes to the same states: every number"));
}

TEST_CASE(
    "an error of the 1989 rule that remains after unloading is reported, with the wrong and the right "
    "value") {
  const both_rules near(divergence("near-tie"));
  REQUIRE(near.wrong().size() == 2);
  const state_difference unloaded = near.wrong()[1];
  CHECK(unloaded.step == 2);
  CHECK(unloaded.what == quantity::w);
  CHECK(unloaded.at == "node 3");
  CHECK(unloaded.value == Approx(0.5 * 8 / 30000).epsilon(1e-9));
  CHECK(unloaded.right == 0.0);
  CHECK(near.run.result.judged.all_certified());
  CHECK(near.run.exit() == exit_status::solved);
}

TEST_CASE("if the 1989 rule has an event at another share, the report gives the share of this event") {
  const both_rules near(divergence("near-tie"));
  const std::vector<row_of_1989>& first = near.beside().rows.at(0);
  CHECK(first.at(0).otherwise.empty());
  REQUIRE(first.at(1).otherwise.size() == 1);
  CHECK(first[1].otherwise[0].what == event{1, change::make});
  CHECK(first[1].otherwise[0].at.value_or(0) ==
        Approx(0.25));  // the load is 15 of 60 when the stop is reached
  CHECK_FALSE(near.beside().same_events);
}

TEST_CASE(
    "if only the 1989 rule has an event, the report gives the event with the next increment of the corrected "
    "rule") {
  const both_rules marked(divergence("mark-toggled"));
  const row_of_1989& first = marked.beside().rows.at(0).at(0);
  REQUIRE(first.otherwise.size() == 1);
  CHECK(first.otherwise[0].what == event{0, change::make});
  REQUIRE(marked.wrong().size() == 1);
  CHECK(marked.wrong()[0].at == "pair 1");
  CHECK(marked.wrong()[0].value == Approx(-5e4));  // stiffness 5e4 times distance 1
  CHECK(marked.wrong()[0].right == 0.0);
}

TEST_CASE(
    "if the path of the 1989 rule ends early, the report says so, and the corrected answer does not change") {
  const both_rules lost(divergence("standstill"));
  CHECK(lost.run.exit() == exit_status::solved);
  CHECK(lost.beside().end.status == path_status::path_ended);
  CHECK_FALSE(lost.beside().rows.at(0).back().reached);
  CHECK(lost.beside().differences.empty());
  const std::string words = rule_1989_words(lost.run.result).at(0);
  CHECK_THAT(words, Contains("the path of the 1989 rule ends early") && Contains("There is an equilibrium") &&
                        !Contains("--kernels"));
}

TEST_CASE("the ends of all steps, and the events up to the first end, are compared with the 1989 rule") {
  const std::string hinged =
      "[beam]\nlength = 1\nelements = 1\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n[[contact]]\nnode = 2\n"
      "surface = \"below\"\nstiffness = 10\nface = ";
  const std::string down = "[[step]]\npoint = [ { node = 2, w = -1 } ]\n";
  const std::string up = "[[step]]\npoint = [ { node = 2, w = 1 } ]\n";
  const std::string combined =
      "[[case]]\nname = \"G\"\npoint = [ { node = 2, w = -1 } ]\n[[combination]]\nname = \"up\"\nterms = { G "
      "= -1 }\n"
      "[[combination]]\nname = \"down\"\nterms = { G = 1 }\n";
  const std::string same_way = "ends in the same way";
  const std::tuple<std::string, std::string, bool> all[] = {
      {"0\n" + down + up, same_way, true},
      {"0\n" + up, same_way, true},
      {"0\n" + combined, same_way, true},
      {"-1\n" + combined, "ends early (the answer does not depend on it): combination \"down\"", false},
      {"-1\n" + down, "ends early (the answer does not depend on it): step 1", false}};
  for (const auto& [text, words, same_events] : all) {
    INFO(text);
    const both_rules r(hinged + text);
    REQUIRE(r.beside().end.status != path_status::solved);
    const std::vector<std::string> lines = rule_1989_words(r.run.result);
    CHECK_THAT(lines.at(0), Contains(words));
    CHECK(std::ranges::count_if(lines, [&](const auto& line) { return line.find(same_way) != line.npos; }) ==
          (words == same_way ? 1 : 0));
    CHECK(r.beside().same_events == same_events);
    for (const std::string& line : lines) CHECK_THAT(line, !Contains("by other events"));
  }
}

TEST_CASE(
    "the 1989 rule uses the engine refactor, or a faster engine on a large problem if its calls are not "
    "kept") {
  CHECK(both_rules(square(4)).beside().engine == "refactor");
  const std::string large = square(40);
  CHECK(both_rules(large).beside().engine == "updated");
  std::string trace;
  output_file to(&trace);
  CHECK(both_rules(large, {.trace = &to}).beside().engine == "refactor");
  CHECK_THAT(trace, Contains("\nkernel fortran\n"));
}
