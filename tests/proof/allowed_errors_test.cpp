// Tests that allowed errors are relative to the state itself, and to its path only if the state is 0.
#include "contct/proof/allowed_errors.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace contct;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Returns the errors and sizes of deflections and forces.
error_bounds bounds(double w, double w_size, double force, double force_size, bool unloaded = false) {
  error_bounds b;
  b.error[quantity::w] = w;
  b.size[quantity::w] = w_size;
  b.error[quantity::force] = force;
  b.size[quantity::force] = force_size;
  b.unloaded = unloaded;
  return b;
}

}  // namespace

TEST_CASE("the allowed error is a millionth of the state's largest number, or of its path's if unloaded") {
  const error_bounds large = bounds(1e-9, 2.0, 1e-9, 50.0);
  // The states are of one path; the errors of the last are compared with w and force.
  using row = std::tuple<const char*, std::vector<error_bounds>, double, double>;
  const row rows[] = {
      {"a state", {large}, 2e-6, 50e-6},
      {"a smaller state after it", {large, bounds(1e-9, 2e-3, 1e-9, 0.5)}, 2e-9, 0.5e-6},
      {"an unloaded state", {large, bounds(1e-12, 1e-12, 0, 0, true)}, 2e-6, 50e-6},
      {"an unloaded state alone", {bounds(1e-12, 1e-12, 0, 0, true)}, 0, 0},
      // The error 3 of the first state exceeds its deflection 2, which is not proved.
      {"an unloaded state after one with errors", {bounds(3, 2, 20, 50), bounds(1, 1, 1, 1, true)}, 0, 30e-6},
      {"a state with small errors", {bounds(1e-30, 0, 1e-30, 200)}, 0, 200e-6},
      {"a state with large errors", {bounds(1e30, 0, 1e30, 200)}, 0, 200e-6},
  };
  for (const auto& [what, states, w, force] : rows) {
    INFO(what);
    allowed_errors sizes;
    by_quantity allowed;
    for (const error_bounds& b : states) allowed = sizes.of(b, 10.0);
    CHECK(allowed[quantity::w].value() == Approx(w).margin(1e-17));
    CHECK(allowed[quantity::force].value() == Approx(force).margin(1e-17));
    CHECK_FALSE(allowed[quantity::moment]);  // the states have no moments
  }
}

TEST_CASE(
    "worst_share is the error over the allowed error, and worst_bound states the error in per cent of the "
    "largest number") {
  allowed_errors sizes;
  const error_bounds b = bounds(1e-3, 2.0, 1e-9, 50.0);
  const by_quantity allowed = sizes.of(b, 10.0);
  CHECK(worst_share(b.error, allowed) == Approx(5e-4));
  CHECK(worst_bound(b.error, allowed) ==
        "a deflection may be off by 0.001, 0.05 % of the largest of its kind");
  problem in_metres;
  in_metres.geometry.kind = beam{};
  in_metres.units = {"m", "kN"};
  CHECK(worst_bound(b.error, allowed, &in_metres) ==
        "a deflection may be off by 0.001 m, 0.05 % of the largest of its kind");
  const error_bounds good = bounds(1e-9, 2.0, 1e-9, 50.0);
  CHECK(worst_bound(good.error, sizes.of(good, 10.0)).empty());
}

TEST_CASE("an error that is NaN, or whose quantity has no allowed error, counts as infinite") {
  by_quantity error, allowed;
  error[quantity::force] = 1e-20;
  CHECK(std::isinf(worst_share(error, allowed)));
  CHECK(worst_bound(error, allowed) ==
        "a contact force may be off by 1e-20, and the state has no load or number of its kind to compare it "
        "with");
  error[quantity::force] = 0.0;
  CHECK(worst_share(error, allowed) == 0.0);
  error[quantity::w] = not_a_number;
  allowed[quantity::w] = 1.0;
  CHECK(std::isinf(worst_share(error, allowed)));
  CHECK_FALSE(worst_bound(error, allowed).empty());
  for (const double value : {1.0, not_a_number, 2.0}) error.take(quantity::force, value);
  CHECK(error[quantity::force] == std::numeric_limits<double>::infinity());
}

TEST_CASE("without forces, the allowed error of forces follows from the largest moment or settlement") {
  error_bounds couples = bounds(1e-9, 2.0, 1e-30, 0.0);
  couples.size[quantity::moment] = 40.0;
  CHECK(allowed_errors().of(couples, 10.0)[quantity::force] == Approx(0x1p-60 * 4));  // largest moment / span
  error_bounds settling = bounds(1e-9, 2.0, 1e-30, 0.0);
  settling.settling[quantity::force] = 2.0;
  CHECK(allowed_errors().of(settling, 0.0)[quantity::force] == Approx(0x1p-70 * 2));
  settling.settling[quantity::moment] = 60.0;
  CHECK(allowed_errors().of(settling, 10.0)[quantity::force] == Approx(0x1p-70 * 6));
}

TEST_CASE(
    "the allowed error of a gap is relative to the larger one of the largest deflection and the largest gap, "
    "and the size of moments is at least the largest force times the extent of the structure") {
  for (const auto& [what, size, allowed] : {std::tuple(quantity::gap, 1.0, 2.0),
                                            {quantity::gap, 30.0, 30.0},
                                            {quantity::moment, 1.0, 50.0 * 10.0},
                                            {quantity::moment, 900.0, 900.0}}) {
    error_bounds b = bounds(1e-9, 2.0, 1e-9, 50.0);
    b.error[what] = 1e-9;
    b.size[what] = size;
    CHECK(allowed_errors().of(b, 10.0)[what] == Approx(1e-6 * allowed));
  }
}
