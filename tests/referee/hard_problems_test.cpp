#include "referee/hard_problems.hpp"

#include <algorithm>
#include <set>

#include "catch.hpp"
#include "referee/problem_text.hpp"

using namespace contct::referee;
using contct::structure::problem;

namespace {

constexpr std::uint64_t tried = 200;

/// How many of the problems of a kind `holds` is true of.
template <class Holds>
std::uint64_t count_of(hard_kind kind, Holds holds) {
  std::uint64_t n = 0;
  for (std::uint64_t number = 0; number < tried; ++number)
    n += holds(make_hard_problem(3, number, kind)) ? 1 : 0;
  return n;
}

double stiffest(const problem& p) {
  double k = 0.0;
  for (const auto& c : p.pairs) k = std::max(k, c.stiffness);
  return k;
}

}  // namespace

TEST_CASE("hard problems are the same from a seed and a number, and no two of them are alike") {
  std::set<std::string> texts;
  for (int kind = 0; kind < hard_kinds; ++kind) {
    for (std::uint64_t number = 0; number < 20; ++number) {
      const auto k = static_cast<hard_kind>(kind);
      const std::string text = text_of(make_hard_problem(3, number, k)).toml;
      CHECK(text == text_of(make_hard_problem(3, number, k)).toml);
      texts.insert(text);
    }
  }
  CHECK(texts.size() >= 20 * hard_kinds - 15);  // soft matrices differ in their files
}

TEST_CASE("each hard kind has what it is named for") {
  const auto is_free = [](const problem& p) { return p.supports.empty(); };
  const auto is_held = [](const problem& p) { return !p.supports.empty(); };
  CHECK(count_of(hard_kind::stiff_pairs, is_held) == tried);
  CHECK(count_of(hard_kind::stiff_pairs, [](const problem& p) {
          return stiffest(p) > 1e12 * std::get<contct::structure::beam>(p.geometry.kind).EI[0];
        }) > tried / 10);
  CHECK(count_of(hard_kind::drops, is_free) == tried);
  CHECK(count_of(hard_kind::drops, [](const problem& p) {
          const auto& b = std::get<contct::structure::beam>(p.geometry.kind);
          return p.pairs[0].face < -10.0 * b.x.back();
        }) > tried / 3);
  CHECK(count_of(hard_kind::small_after_large, [](const problem& p) {
          return std::abs(p.steps[1].points[0].value) < 1e-3 * std::abs(p.steps[0].points[0].value);
        }) == tried);
  CHECK(count_of(hard_kind::cancelling_loads, [](const problem& p) {
          const auto& points = p.steps[0].points;
          return std::abs(points[3].value) < 1e-3 * points[0].value && points[1].value < -points[0].value;
        }) == tried);
  CHECK(count_of(hard_kind::graded_meshes, [](const problem& p) {
          const auto& b = std::get<contct::structure::beam>(p.geometry.kind);
          std::vector<double> h;
          for (std::size_t e = 0; e < b.EI.size(); ++e) h.push_back(b.length_of(e));
          const auto [least, most] = std::minmax_element(h.begin(), h.end());
          return *most > 100 * *least || b.x.front() > 1e6 * *most;
        }) > tried / 2);
  CHECK(count_of(hard_kind::pairs_alone, is_free) == tried);
  CHECK(count_of(hard_kind::near_tipping, is_free) == tried);
  CHECK(count_of(hard_kind::soft_matrices, [](const problem& p) {
          return std::holds_alternative<contct::structure::assembled>(p.geometry.kind);
        }) == tried);
  CHECK(count_of(hard_kind::spring_decades, is_held) == tried);
}
