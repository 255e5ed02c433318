#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "catch.hpp"
#include "contct/session/step_results.hpp"
#include "read/bad_plates.hpp"
#include "support/a_run.hpp"

using namespace contct;

namespace {

/// A beam of length 6 on two supports, EI = 1000, under 12 at x = 2, and then under 12 at x = 4.
const std::string load_in_two_places =
    "[beam]\nlength = 6.0\nelements = 3\nEI = 1000.0\n[[support]]\nnodes = [1, 4]\nfix = [\"w\"]\n"
    "[[step]]\npoint = [ { node = 2, w = -12.0 } ]\n[[step]]\npoint = [ { node = 3, w = -12.0 } ]\n";

/// Returns the moment at x of a beam of length 6 on two supports under P = 12 at `a`; deflection_at returns
/// its deflection.
double moment_at(double x, double a) {
  return x < a ? 12 * (6 - a) * x / 6 : 12 * a * (6 - x) / 6;
}
double deflection_at(double x, double a) {
  const auto left_of_load = [](double at, double b) {
    return -12 * b * at * (36 - b * b - at * at) / (6 * 6 * 1000.0);
  };
  return x < a ? left_of_load(x, 6 - a) : left_of_load(6 - x, a);
}

}  // namespace

TEST_CASE(
    "At each point, the envelope of a load at two places has the extreme moments and deflections of the two "
    "states") {
  const a_run run(load_in_two_places, "corrected");
  const envelope_curves all = curves_of(run.result);
  REQUIRE(all.curves.size() == 3);
  CHECK(all.x.size() > 300);
  for (std::size_t i = 0; i < all.x.size(); ++i) {
    const double x = all.x[i];
    const auto& [w, moment, shear] = std::tie(all.curves[0].at[i], all.curves[1].at[i], all.curves[2].at[i]);
    CAPTURE(x);
    CHECK(moment.most.value == Approx(std::max(moment_at(x, 2), moment_at(x, 4))).margin(1e-9));
    CHECK(moment.least.value == Approx(std::min(moment_at(x, 2), moment_at(x, 4))).margin(1e-9));
    CHECK(w.least.value == Approx(std::min(deflection_at(x, 2), deflection_at(x, 4))).margin(1e-12));
    if (x > 0.1 && x < 2.9) CHECK(moment.most.step == 1);
    if (x > 3.1 && x < 5.9) CHECK(moment.most.step == 2);
    if (x > 0.1 && x < 2.9) CHECK(moment.least.step == 2);
  }
}

TEST_CASE("Envelope curves have the shear on both sides of a jump, and each value has its step") {
  const a_run run(load_in_two_places, "corrected");
  const envelope_curves all = curves_of(run.result);
  const auto at_node = std::find(all.x.begin(), all.x.end(), 2.0);
  const std::size_t left = at_node - all.x.begin();
  REQUIRE(all.x.at(left + 1) == 2.0);
  const auto& shear = all.curves.at(2).at;
  CHECK(shear[left].most.value == Approx(8.0));  // 12 * 4 / 6, of step 1
  CHECK(shear[left].most.step == 1);
  CHECK(shear[left].least.value == Approx(4.0));  // 12 * 2 / 6, of step 2
  CHECK(shear[left + 1].most.value == Approx(4.0));
  CHECK(shear[left + 1].most.step == 2);
  CHECK(shear[left + 1].least.value == Approx(-4.0));  // 8 - 12, of step 1
}

TEST_CASE("A plate has no envelope curves") {
  const a_run run(std::string(good_plate), "corrected");
  CHECK(curves_of(run.result).x.empty());
}
