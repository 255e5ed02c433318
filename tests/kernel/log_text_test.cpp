#include "contct/kernel/log_text.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "catch.hpp"
#include "contct/kernel/fortran.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

/// Returns the texts of gfortran and C++ for one pair at `node` with this gap and response.
template <class Real>
std::pair<std::string, std::string> texts(Real gap, Real response, int node) {
  small_call<Real> c({{Real(0), response, gap, separated, face_above}});
  c.dd.assign(static_cast<std::size_t>(node), Real(0));
  c.dtest.assign(static_cast<std::size_t>(node), response);
  c.id = {node};
  fortran::unit_26 log;
  call<Real> f = c.arguments();
  fortran::contct(f);
  c.isep = {separated};
  c.ask();
  call<Real> answered = c.arguments();
  answered.smin = c.smin;
  std::string cpp;
  append_log_text(answered, std::span<const event>(c.events), cpp);
  return {log.take(), cpp};
}

}  // namespace

TEST_CASE("the C++ kernel writes the text of an event byte for byte as gfortran does") {
  const auto [f, cpp] = texts(0.25, 1.0, 7);
  CHECK(f ==
        "  ******* MAKING CONTACT ********\n"
        "   CONTACT PAIR:   1 NODE:   7 SURFACE:   1 SCALE FACTOR =  0.2500E+00\n");
  CHECK(cpp == f);
}

TEST_CASE("the C++ kernel writes the text of a call without events byte for byte as gfortran does") {
  const auto [f, cpp] = texts(3.0, 1.0, 1);
  CHECK(f == "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n");
  CHECK(cpp == f);
  CHECK(texts(3.0F, 1.0F, 1) == std::pair(f, f));
}

TEST_CASE("for a node above 999, FORMAT I3 prints asterisks in gfortran and in C++") {
  const auto [f, cpp] = texts(0.25, 1.0, 1000);
  CHECK(f.find("NODE: *** SURFACE") != std::string::npos);
  CHECK(cpp == f);
}

TEST_CASE("gfortran and C++ print an exponent of three digits without the letter E") {
  const auto [f, cpp] = texts(1.0, 3e200, 1);
  CHECK(f.find("SCALE FACTOR =  0.3333-200") != std::string::npos);
  CHECK(cpp == f);
}

TEMPLATE_TEST_CASE("the C++ kernel rounds printed numbers as gfortran does, from the smallest subnormal to 1",
                   "", float, double) {
  using Real = TestType;
  std::vector<Real> factors = {std::numeric_limits<Real>::denorm_min(),
                               std::numeric_limits<Real>::min(),
                               Real(0.99995),
                               Real(0.999949),
                               Real(0.09999499),
                               Real(0.099995),
                               Real(0.12345),
                               Real(0.12355),
                               Real(0.00012345),
                               Real(1) - std::numeric_limits<Real>::epsilon() / 2};
  for (int e = 1; e < std::numeric_limits<Real>::max_exponent10; ++e)
    factors.push_back(Real(1) / Real(3) * std::pow(Real(10), Real(-e)));
  // Ties of the decimal rounding: multiples of 2^-17, whose decimals continue with a 5 after the fourth
  // digit.
  for (int i = 1; i < 400; ++i)
    factors.push_back(static_cast<Real>(i) / Real(131072) * Real(4) + Real(0.0078125));
  int checked = 0;
  for (const Real s : factors) {
    if (!(s > Real(0) && s < Real(1))) continue;
    const auto [f, cpp] = texts(Real(1), Real(1) / s, 1);  // a gap of 1 is never stationary
    REQUIRE(cpp == f);
    ++checked;
  }
  CHECK(checked > 400);
}
