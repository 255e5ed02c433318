// Tests problems that were once certified with wrong numbers, not certified, called a mechanism or lost:
// their exact numbers, and their remaining errors.
#include <map>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "referee/judge.hpp"

using namespace contct::referee;
using contct::path_status;

namespace {

/// A number of the exact path, by its first 6 digits: "f1" is the force of pair 1, and "w2" the deflection of
/// node 2.
struct stated_number {
  std::size_t step;
  const char* what;
  const char* value;
};

using enum path_status;

struct stated_problem {  // NOLINT(clang-analyzer-optin.performance.Padding): in the order of the tables
  const char* file;
  path_status ends;
  std::vector<stated_number> numbers;
  int values;  ///< least number of compared values in all ways
  /// Largest numbers of these errors in all ways; other errors are not allowed.
  int exactly_ended, other_events;
};

const stated_problem stated_problems[] = {
    {"stiff-pair-state", solved, {{2, "f1", "0.0000999600"}, {3, "w3", "0"}}, 108, 0, 2},
    {"fine-mesh", solved, {{2, "f1", "0.000275072"}, {2, "f2", "0"}}, 2096, 0, 0},
    {"tipping", mechanism, {}, 0, 0, 0},
    {"lost-path", solved, {{1, "f1", "1"}, {1, "f2", "1"}}, 24, 0, 0},
    {"refused", mechanism, {}, 0, 0, 0},
    {"nearly-in-line", solved, {{1, "f5", "3.32518"}, {1, "f7", "0.666371"}}, 136, 2, 0},
    {"stiff-pair-at-its-face", solved, {{1, "f1", "1891560000000000"}, {2, "f1", "0"}}, 81, 0, 0},
    {"graded-mesh", solved, {{1, "f1", "0.0174344"}, {2, "f2", "0.0809105"}}, 102, 3, 0},
    {"dropped-onto-stiff-pairs", solved, {{2, "f1", "2318.92"}, {2, "f5", "281.081"}}, 102, 2, 2},
    {"held-by-a-hair", solved, {{1, "f2", "1e-16"}, {1, "w4", "-1.88235"}}, 33, 3, 0},
    {"plate-on-five-pairs", solved, {{2, "f1", "50.1722"}, {2, "f4", "2519.36"}}, 192, 3, 2},
    {"far-from-zero", solved, {{1, "w2", "-1/1200"}, {1, "w3", "-1/375"}}, 36, 0, 0},
};

}  // namespace

TEST_CASE("problems that were once certified wrongly now have at most the listed numbers of faults") {
  for (const stated_problem& stated : stated_problems) {
    INFO(stated.file);
    const contct::problem p =
        contct::read_problem(CONTCT_REFEREE_PROBLEMS "/" + std::string(stated.file) + ".toml");
    const exact_answer answer(p);
    CHECK(answer.path.status() == stated.ends);
    for (const stated_number& n : stated.numbers) {
      const auto& end = answer.path.steps.at(n.step - 1);
      const std::size_t at = std::stoul(n.what + 1) - 1;
      const auto& x =
          n.what[0] == 'f' ? end.force.at(at) : end.displacement.at(at * dofs_per_node(p.geometry));
      CHECK(contct::short_words(x, 6) == n.value);
    }
    std::map<fault, int> found;
    long values = 0;
    for (const way how : {way::default_engine, way::refactor, way::final_only, way::listing}) {
      const judgement j = judge(p, answer, how);
      values += j.values;
      for (const finding& f : j.findings) {
        ++found[f.what];
        UNSCOPED_INFO(way_names[static_cast<int>(how)] << ": " << f.words);
      }
    }
    CHECK(values >= stated.values);
    for (const auto& [what, count] : found) {
      INFO(fault_names[static_cast<int>(what)]);
      CHECK(count <= (what == fault::exactly        ? stated.exactly_ended
                      : what == fault::other_events ? stated.other_events
                                                    : 0));
    }
  }
}
