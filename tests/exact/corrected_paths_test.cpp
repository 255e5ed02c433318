// The corrected rule in doubles, and its certificate, against the exact path on random problems.
#include "catch.hpp"
#include "exact/random_comparison.hpp"

using namespace contct::exact;

namespace {

comparison_counts compare(std::uint64_t seed, std::uint64_t problems,
                          const contct::lab::random_problem_kind& kind) {
  comparison_counts counts;
  for (std::uint64_t number = 0; number < problems; ++number)
    compare_one(
        number, contct::lab::make_random_problem(seed, number, kind), counts,
        [](std::uint64_t n, const std::string& words) { UNSCOPED_INFO("problem " << n << ": " << words); });
  return counts;
}

}  // namespace

TEST_CASE("exact ends of random problems are equilibria, and the corrected rule ends where they do") {
  contct::lab::random_problem_kind kind;
  kind.most_elements = 8;
  kind.most_lines = 2;
  const comparison_counts counts = compare(2026, 300, kind);
  CHECK(counts.problems == 300);
  CHECK(counts.steps > 700);
  CHECK(counts.mechanisms > 10);
  CHECK(counts.not_equilibrium == 0);
  CHECK(counts.false_mechanism == 0);
  CHECK(counts.false_solution == 0);
  // Ceilings: what is left of these is a matter of the certificate.
  CHECK(counts.beyond_tolerance == 0);
  CHECK(counts.other_events <= 20);
  CHECK(counts.fewest_digits > 9);
}
