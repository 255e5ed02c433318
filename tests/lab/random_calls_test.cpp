// Tests that adversarial calls are near the listing's thresholds, and that calls are the same on every
// machine.
#include "contct/lab/random_calls.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <map>

#include "catch.hpp"
#include "contct/compare/branches.hpp"
#include "contct/kernel/contct.hpp"

using namespace contct;

namespace {

/// Returns a hash of a call.
std::uint64_t digest(const call_inputs<double>& in) {
  std::uint64_t sum = in.pairs();
  const auto mix = [&sum](double x) {
    sum = (sum ^ (std::isnan(x) ? 1 : std::bit_cast<std::uint64_t>(x))) * 0x9e3779b97f4a7c15;
  };
  for (std::size_t i = 0; i < in.pairs(); ++i) {
    mix(in.dd[in.dof_of_pair(i)]);
    mix(in.dtest[in.dof_of_pair(i)]);
    mix(in.cc[i]);
    mix(in.isep[i] * 8 + in.isurf[i] + 64 * in.id[i]);
  }
  return sum;
}

}  // namespace

TEMPLATE_TEST_CASE(
    "adversarial random calls reach the threshold of every IF of the listing exactly, and most within one "
    "ULP",
    "", float, double) {
  using Real = TestType;
  random_calls<Real> source(1989);
  // Counts of IFs whose sides are equal, differ by one ULP and are true, differ by one ULP and are false.
  std::map<branch, std::array<int, 3>> near;
  std::vector<Real> ss;
  std::vector<int> isep;
  std::vector<event> events;
  for (std::uint64_t n = 1; n <= 60'000; ++n) {
    const call_inputs<Real>& in = source.adversarial(n);
    ss.resize(in.pairs());
    isep = in.isep;
    events.resize(in.pairs());
    call<Real> c{in.dd, in.dtest, in.cc, ss, Real(0), in.id, isep, in.isurf, in.dof};
    (void)contct::contct(c, std::span<event>(events));
    for_each_decision(c, in.isep, [&near](branch b, std::size_t, bool outcome, Real left, Real right) {
      const std::uint64_t ulps = margin_between(left, right);
      near[b][0] += ulps == 0;
      near[b][1] += ulps == 1 && outcome;
      near[b][2] += ulps == 1 && !outcome;
    });
  }
  for (const branch b : {branch::no_response, branch::stationary, branch::s_positive, branch::s_is_smallest,
                         branch::no_events}) {
    INFO(branch_names[index_of(b)]);
    CHECK(near[b][0] >= 20);
    CHECK(near[b][1] + near[b][2] >= 20);
  }
  // One ULP of SS changes DIFF by many ULPs, so DIFF is rarely one ULP from EPSMUL.
  CHECK(near[branch::within_epsmul][0] >= 20);
  CHECK(near[branch::check_positive][0] >= 20);
}

TEST_CASE("a random call depends only on its seed and its number") {
  for (const int real_bytes : {4, 8}) {
    call_source forwards(7, real_bytes);
    call_source backwards(7, real_bytes);
    std::map<std::uint64_t, std::uint64_t> seen;
    for (std::uint64_t n = 1; n <= 200; ++n) seen[n] = digest(forwards.at(n));
    for (std::uint64_t n = 200; n >= 1; --n) CHECK(digest(backwards.at(n)) == seen[n]);
    call_source other(8, real_bytes);
    int same = 0;
    for (std::uint64_t n = 1; n <= 200; ++n) same += digest(other.at(n)) == seen[n] ? 1 : 0;
    CHECK(same < 10);  // calls without pairs are equal
  }
}

TEST_CASE("a random call has NaN at every dof without a pair, which exposes a kernel that reads such a dof") {
  call_source source(1989, 8);
  for (std::uint64_t n = 1; n <= 50; ++n) {
    const call_inputs<double>& in = source.at(n);
    std::vector<char> watched(in.dd.size(), 0);
    for (std::size_t i = 0; i < in.pairs(); ++i) watched[in.dof_of_pair(i)] = 1;
    int wrong = 0;
    for (std::size_t dof = 0; dof < in.dd.size(); ++dof)
      if (watched[dof] == 0 && !(std::isnan(in.dd[dof]) && std::isnan(in.dtest[dof]))) ++wrong;
    CHECK(wrong == 0);
  }
}
