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
  const auto* const b = std::get_if<beam>(&p.geometry.kind);
  const std::size_t in_elements = r.elements.elements() * static_cast<std::size_t>(r.elements.places);
  const std::size_t in_order[] = {static_cast<std::size_t>(nodes(p.geometry)),
                                  p.pairs.size(),
                                  p.supports.size(),
                                  p.beds.size(),
                                  b == nullptr ? 0 : b->hinges.size(),
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

TEST_CASE(
    "the rotation in a hinge has its digits for every stiffness, from that of a free hinge to that of none") {
  // The middle of a beam on two supports yields to a load by L^3 / 48 EI + L^2 / 16 s, and has the moment L /
  // 4 of what the pair does not carry.
  int compared = 0;
  for (int exponent = -290; exponent <= 290; exponent += 20) {
    const double s = std::pow(10.0, exponent), EI = 48, L = 2;
    const double yields = L * L * L / (48 * EI) + L * L / 16 / s;
    const a_run run(
        fmt::format("[beam]\nlength = 2\nelements = 2\nEI = 48\n[[hinge]]\nnode = 2\nstiffness = {}\n"
                    "[[support]]\nnodes = [1, 3]\nfix = \"w\"\n[[contact]]\nnode = 2\nsurface = "
                    "\"below\"\nface = 0\nstiffness = 3\n[[step]]\npoint = [ {{ node = 2, w = -1 }} ]\n",
                    s),
        "corrected");
    const double moment = L / 4 / (1 + 3 * yields);
    CAPTURE(s);
    CHECK(row_named(run.what, "hinge_rotation").values(run.results())[0] ==
          Approx(moment / s).epsilon(1e-10));
    CHECK(row_named(run.what, "hinge_moment").values(run.results())[0] ==
          Approx(moment).margin(1e-12).epsilon(1e-12));
    ++compared;
  }
  CHECK(compared == 30);
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
