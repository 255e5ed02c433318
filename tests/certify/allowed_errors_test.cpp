// Tests that allowed errors are relative to the state itself, and to its path only if the state is 0.
#include "contct/certify/allowed_errors.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"

using namespace contct;

namespace {

error_bounds bounds(double w, double w_size, double force, double force_size) {
  error_bounds b;
  b.error[quantity::w] = w;
  b.size[quantity::w] = w_size;
  b.error[quantity::force] = force;
  b.size[quantity::force] = force_size;
  return b;
}

}  // namespace

TEST_CASE(
    "the allowed error of a quantity is a millionth of the largest number of this quantity in the same "
    "state") {
  allowed_errors sizes;
  const by_quantity of_large = sizes.of(bounds(1e-9, 2.0, 1e-9, 50.0), 10.0);
  CHECK(of_large[quantity::w] == Approx(2e-6));
  CHECK(of_large[quantity::force] == Approx(50e-6));
  CHECK_FALSE(of_large[quantity::moment]);  // the state has no moments
  const by_quantity of_small = sizes.of(bounds(1e-9, 2e-3, 1e-9, 0.5), 10.0);
  CHECK(of_small[quantity::w] == Approx(2e-9));  // not relative to the path's 2.0
}

TEST_CASE(
    "the allowed error of an unloaded state is relative to the largest numbers of the path before this "
    "state") {
  allowed_errors sizes;
  (void)sizes.of(bounds(1e-9, 2.0, 1e-9, 50.0), 10.0);
  error_bounds nothing = bounds(1e-12, 1e-12, 0.0, 0.0);
  nothing.unloaded = true;
  const by_quantity allowed = sizes.of(nothing, 10.0);
  CHECK(allowed[quantity::w] == Approx(2e-6));
  allowed_errors fresh;
  CHECK(fresh.of(nothing, 10.0)[quantity::w].value() < 1e-17);  // the first step has no earlier numbers
}

TEST_CASE(
    "in an unloaded state, neither the state's errors nor earlier unproved states change the allowed error") {
  allowed_errors sizes;
  (void)sizes.of(bounds(3.0, 2.0, 20.0, 50.0), 10.0);
  error_bounds nothing = bounds(1.0, 1.0, 1.0, 1.0);
  nothing.unloaded = true;
  const by_quantity allowed = sizes.of(nothing, 10.0);
  CHECK(allowed[quantity::w] == 0.0);
  CHECK(allowed[quantity::force] == Approx(30e-6));
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
  const error_bounds good = bounds(1e-9, 2.0, 1e-9, 50.0);
  problem in_metres;
  in_metres.geometry.kind = beam{};
  in_metres.units = {"m", "kN"};
  CHECK(worst_bound(b.error, allowed, &in_metres) ==
        "a deflection may be off by 0.001 m, 0.05 % of the largest of its kind");
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
  error[quantity::w] = std::numeric_limits<double>::quiet_NaN();
  allowed[quantity::w] = 1.0;
  CHECK(std::isinf(worst_share(error, allowed)));
  CHECK_FALSE(worst_bound(error, allowed).empty());
}

TEST_CASE("larger error bounds of a state do not increase the allowed error") {
  for (const double bound : {1e-30, 1.0, 1e30}) {
    allowed_errors sizes;
    const by_quantity allowed = sizes.of(bounds(bound, 0.0, bound, 200.0), 2.0);
    CHECK(allowed[quantity::w] == 0.0);
    CHECK(allowed[quantity::force] == Approx(200e-6));
  }
}

TEST_CASE(
    "under couples alone, the allowed error of a beam's forces is 2^-60 times (largest moment / span)") {
  error_bounds b = bounds(1e-9, 2.0, 1e-30, 0.0);
  b.size[quantity::moment] = 40.0;
  allowed_errors sizes;
  CHECK(sizes.of(b, 10.0)[quantity::force] == Approx(0x1p-60 * 4));
}

TEST_CASE(
    "if only supports settle, the allowed error of forces is 2^-70 times the force that settles one "
    "support") {
  error_bounds b = bounds(1e-9, 2.0, 1e-30, 0.0);
  b.settling[quantity::force] = 2.0;
  allowed_errors of_matrix;
  CHECK(of_matrix.of(b, 0.0)[quantity::force] == Approx(0x1p-70 * 2));
  b.settling[quantity::moment] = 60.0;
  allowed_errors of_beam;
  CHECK(of_beam.of(b, 10.0)[quantity::force] == Approx(0x1p-70 * 6));
}

TEST_CASE(
    "the allowed error of a gap is relative to the larger one of the largest deflection and the largest "
    "gap") {
  error_bounds b = bounds(1e-9, 2.0, 1e-9, 50.0);
  b.error[quantity::gap] = 1e-9;
  b.size[quantity::gap] = 1.0;
  allowed_errors sizes;
  CHECK(sizes.of(b, 10.0)[quantity::gap] == Approx(2e-6));
  b.size[quantity::gap] = 30.0;
  CHECK(sizes.of(b, 10.0)[quantity::gap] == Approx(30e-6));
}

TEST_CASE("a NaN error is recorded as infinite, and later errors of the same quantity do not replace it") {
  by_quantity error;
  for (const double value : {1.0, std::numeric_limits<double>::quiet_NaN(), 2.0})
    error.take(quantity::force, value);
  CHECK(error[quantity::force] == std::numeric_limits<double>::infinity());
}
