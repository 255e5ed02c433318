// Tests problems that were once certified with wrong numbers, not certified, called a mechanism or lost:
// their exact numbers, and their remaining errors.
#include <map>
#include <utility>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "referee/judge.hpp"

using namespace contct::referee;
using contct::path_status;
using contct::short_words;

namespace {

/// A number of the exact path: the force of pair `at` or the deflection of node `at`, from 1.
struct stated_number {
  enum class kind { force, deflection } what;
  std::size_t step, at;
  const char* value;  ///< the exact number, or its first 6 digits
};
stated_number force(std::size_t step, std::size_t pair, const char* value) {
  return {stated_number::kind::force, step, pair, value};
}
stated_number deflection(std::size_t step, std::size_t node, const char* value) {
  return {stated_number::kind::deflection, step, node, value};
}

struct stated_problem {
  const char* file;
  path_status ends;
  std::vector<stated_number> numbers;
  int values;                  ///< least number of compared values in all ways
  std::map<fault, int> known;  ///< largest number of each error in all ways; 0 if not listed
};

using enum fault;

// The numbers of errors are upper limits.
const std::vector<stated_problem>& stated_problems() {
  constexpr auto solved = path_status::solved;
  constexpr auto mechanism = path_status::mechanism;
  static const std::vector<stated_problem> all = {
      {"stiff-pair-state",
       solved,
       {force(2, 1, "0.0000999600"), deflection(3, 3, "0")},
       108,
       {{other_events, 2}}},
      {"fine-mesh", solved, {force(2, 1, "0.000275072"), force(2, 2, "0")}, 2096, {}},
      {"tipping", mechanism, {}, 0, {}},
      {"lost-path", solved, {force(1, 1, "1"), force(1, 2, "1")}, 24, {}},
      {"refused", mechanism, {}, 0, {}},
      {"nearly-in-line", solved, {force(1, 5, "3.32518"), force(1, 7, "0.666371")}, 136, {{exactly, 2}}},
      {"stiff-pair-at-its-face", solved, {force(1, 1, "1891560000000000"), force(2, 1, "0")}, 81, {}},
      {"graded-mesh", solved, {force(1, 1, "0.0174344"), force(2, 2, "0.0809105")}, 102, {{exactly, 3}}},
      {"dropped-onto-stiff-pairs",
       solved,
       {force(2, 1, "2318.92"), force(2, 5, "281.081")},
       102,
       {{exactly, 2}, {other_events, 2}}},
      {"held-by-a-hair", solved, {force(1, 2, "1e-16"), deflection(1, 4, "-1.88235")}, 33, {{exactly, 3}}},
      {"plate-on-five-pairs",
       solved,
       {force(2, 1, "50.1722"), force(2, 4, "2519.36")},
       192,
       {{exactly, 3}, {other_events, 2}}},
      {"far-from-zero", solved, {deflection(1, 2, "-1/1200"), deflection(1, 3, "-1/375")}, 36, {}},
  };
  return all;
}

std::string text_of(const stated_number& n, const exact_answer& exactly, int stride) {
  const auto& end = exactly.path.steps.at(n.step - 1);
  const auto& x = n.what == stated_number::kind::force
                      ? end.force.at(n.at - 1)
                      : end.displacement.at((n.at - 1) * static_cast<std::size_t>(stride));
  return short_words(x, 6);
}

}  // namespace

TEST_CASE("problems that were once certified wrongly now have at most the listed numbers of faults") {
  int checked = 0;
  for (const stated_problem& stated : stated_problems()) {
    INFO(stated.file);
    const contct::problem p =
        contct::read_problem(CONTCT_REFEREE_PROBLEMS "/" + std::string(stated.file) + ".toml");
    const exact_answer answer(p);
    CHECK(answer.path.status == stated.ends);
    for (const stated_number& n : stated.numbers)
      CHECK(text_of(n, answer, dofs_per_node(p.geometry)) == n.value);
    std::map<fault, int> found;
    long values = 0;
    for (const way how : {way::default_engine, way::refactor, way::final_only, way::listing}) {
      const judgement j = judge(p, answer, how);
      values += j.values;
      for (const finding& f : j.findings) {
        ++found[f.what];
        UNSCOPED_INFO(name_of(how) << ": " << name_of(f.what) << ": " << f.words);
      }
    }
    CHECK(values >= stated.values);
    for (const auto& [what, count] : found) {
      const auto known = stated.known.find(what);
      INFO(name_of(what));
      CHECK(count <= (known == stated.known.end() ? 0 : known->second));
    }
    ++checked;
  }
  CHECK(checked == 12);
}
