#include "contct/solve/inverse_columns.hpp"

#include "catch.hpp"
#include "support/beam_over_stops.hpp"

using namespace contct::app;

namespace {

constexpr int length_in_elements = 30;

/// K^-1 e at the pairs by a new factor.
std::vector<double> column_by_factor(const linear_structure& s, const std::vector<char>& closed, int pair) {
  std::vector<double> e(s.dofs());
  e[s.dof_of_pair(pair)] = 1.0;
  return response_by_factor(s, closed, e);
}

}  // namespace

TEST_CASE("columns are those of K with the springs taken in since its factor, alone or in blocks") {
  const linear_structure s = cantilever_over_stops(length_in_elements);
  std::vector<double> near(s.pairs.size(), 1.0);
  for (const int pair : {3, 29, 12, 13, 20}) near[pair] = 0.5;
  for (const std::vector<double>& last_s : {std::vector<double>{}, near}) {
    std::vector<char> closed(s.pairs.size());
    factored_stiffness k(s);
    k.factor(closed);
    inverse_columns columns(s, k);
    for (const int pair : {3, 12, 29, 12, 20, 5}) {
      const std::span<const double> c = columns.column(pair, last_s);
      CHECK(relative_difference(column_by_factor(s, closed, pair), c) <= 1e-10);
      const double sigma = closed[pair] == 0 ? 1.0 : -1.0;
      const double c_p = c[pair];
      const double sigma_k = sigma * s.pairs[pair].stiffness;
      CHECK(columns.take_in(pair, sigma_k) == sigma_k / (1 + sigma_k * c_p));
      closed[pair] = closed[pair] == 0 ? 1 : 0;
    }
    CHECK(columns.toggles() == 6);
    // Blocks: one with 3, 12, 29, 20 (and 13); 12 again and 5 are in none that is left.
    CHECK(columns.passes() == (last_s.empty() ? 6 : 3));
    std::vector<double> load(s.dofs(), 1.0);
    std::vector<double> at_pairs = response_by_factor(s, std::vector<char>(s.pairs.size()), load);
    columns.correct(at_pairs);
    CHECK(relative_difference(response_by_factor(s, closed, load), at_pairs) <= 1e-10);
  }
}

TEST_CASE("with a new factor all toggles are forgotten") {
  const linear_structure s = cantilever_over_stops(4);
  factored_stiffness k(s);
  k.factor(std::vector<char>(4));
  inverse_columns columns(s, k);
  (void)columns.column(2, {});
  columns.take_in(2, 100.0);
  CHECK(columns.all_toggles()[0].pair == 2);
  columns.start_anew();
  CHECK(columns.toggles() == 0);
  std::vector<double> unchanged = {1, 2, 3, 4};
  columns.correct(unchanged);
  CHECK(unchanged == std::vector<double>{1, 2, 3, 4});
}
