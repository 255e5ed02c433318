#include "contct/results/quantities.hpp"

#include <cmath>
#include <filesystem>
#include <set>

#include "catch.hpp"
#include "support/a_run.hpp"

namespace contct {
namespace {

/// The number of values that a quantity on `list` has.
std::size_t count_on(const step_results& r, on list) {
  const problem& p = r.what;
  const std::size_t in_elements = r.elements.elements() * static_cast<std::size_t>(r.elements.places);
  const std::size_t in_order[] = {static_cast<std::size_t>(nodes(p.geometry)),
                                  p.pairs.size(),
                                  p.supports.size(),
                                  p.beds.size(),
                                  in_elements,
                                  1};
  return in_order[static_cast<std::size_t>(list)];
}

}  // namespace

TEST_CASE(
    "each quantity of a reference problem has a key of its own, and a number for each entry of its list") {
  int rows = 0;
  std::set<std::string_view> met;
  for (const auto& file : std::filesystem::directory_iterator(CONTCT_REFERENCE "/problems")) {
    if (file.path().extension() != ".toml") continue;
    const a_run run = reference_run(file.path().stem().string());
    const step_results read = run.results();
    std::set<std::string_view> keys;
    for (const quantity_row* row : quantities_of(run.what)) {
      CAPTURE(run.what.title, row->key);
      const std::vector<double> values = row->values(read);
      CHECK(values.size() == count_on(read, row->where));
      CHECK(std::ranges::any_of(values, [](double x) { return std::isfinite(x); }));
      CHECK(keys.insert(row->key).second);
      ++rows;
    }
    met.insert(keys.begin(), keys.end());
  }
  CHECK(rows >= 500);
  CHECK(met.size() >= 20);
}

TEST_CASE("each range of a state is a range of a quantity, whose numbers are within it") {
  for (const char* name : {"pb07-three-gap-supports", "pp06-plate-over-settling-line"}) {
    const a_run run = reference_run(name);
    const step_results read = run.results();
    for (const value_range& range : read.ranges()) {
      CAPTURE(name, range.name);
      const quantity_row& row = row_named(run.what, range.name);
      for (const double x : row.values(read)) {
        CHECK(x >= range.least.value);
        CHECK(x <= range.most.value);
      }
    }
  }
}

}  // namespace contct
