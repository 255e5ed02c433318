// Tests that the listing and the C++ kernel are equal to the bit: exhaustively for one pair and for two
// pairs, and at random for up to 64 pairs, in both precisions. `contct prove` proves this equality for every
// input; these tests also cover the wrapper and the text.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "catch.hpp"
#include "contct/lab/random_calls.hpp"
#include "support/side_by_side.hpp"

using namespace contct;

namespace {

template <class Real>
std::vector<Real> interesting_numbers() {
  using limits = std::numeric_limits<Real>;
  const Real gap = sizeof(Real) == 4 ? static_cast<Real>(1.E-10F) : static_cast<Real>(1.E-10);
  std::vector<Real> positive = {Real(0),
                                limits::denorm_min(),
                                limits::min(),
                                static_cast<Real>(1e-20),
                                std::nextafter(gap, Real(0)),
                                gap,
                                std::nextafter(gap, Real(1)),
                                Real(0.5),
                                std::nextafter(Real(1), Real(0)),
                                Real(1),
                                std::nextafter(Real(1), Real(2)),
                                Real(3),
                                static_cast<Real>(1e30),
                                limits::max(),
                                limits::infinity()};
  std::vector<Real> all = positive;
  for (const Real x : positive) all.push_back(-x);
  all.push_back(limits::quiet_NaN());
  return all;
}

template <class Real>
call_inputs<Real> pairs_at_one_dof_each(std::size_t pairs) {
  call_inputs<Real> in;
  in.dd.assign(pairs, Real(0));
  in.dtest.assign(pairs, Real(0));
  in.cc.assign(pairs, Real(0));
  in.isep.assign(pairs, separated);
  in.isurf.assign(pairs, face_above);
  for (std::size_t i = 0; i < pairs; ++i) in.id.push_back(static_cast<int>(i) + 1);
  return in;
}

template <class Real>
void require_no_mismatch(side_by_side<Real>& both) {
  both.compare_gathered_text();
  INFO(both.first_difference().value_or("no difference"));
  REQUIRE(both.compared().mismatches == 0);
}

}  // namespace

TEMPLATE_TEST_CASE(
    "FORTRAN and C++ give equal answers for one pair, with 31 values each of D, d* and c, and all statuses",
    "", float, double) {
  using Real = TestType;
  const std::vector<Real> numbers = interesting_numbers<Real>();
  REQUIRE(numbers.size() == 31);
  side_by_side<Real> both;
  call_inputs<Real> in = pairs_at_one_dof_each<Real>(1);
  for (const Real d : numbers) {
    for (const Real d_star : numbers) {
      for (const Real c : numbers) {
        for (const int isep : {1, -1, 0, 2}) {  // for 0 and 2 the listing takes its ELSE branches
          for (const int isurf : {1, -1}) {
            in.dd[0] = d;
            in.dtest[0] = d_star;
            in.cc[0] = c;
            in.isep[0] = isep;
            in.isurf[0] = isurf;
            both.put(in);
          }
        }
      }
    }
  }
  require_no_mismatch(both);
  // Every IF had both outcomes, except IF (DIFF.LT.EPSMUL), which is always true for a single pair.
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true}) {
      const bool impossible = branch_names[b] == "within_epsmul" && !outcome;
      INFO(branch_names[b] << " " << outcome);
      CHECK((both.branches().of(static_cast<branch>(b), outcome) > 100) != impossible);
    }
  }
  CHECK(both.calls() == 31 * 31 * 31 * 8);
  CHECK(both.compared().values >= 3 * both.calls());
}

TEMPLATE_TEST_CASE(
    "FORTRAN and C++ give equal answers for two pairs at a tie, at a DIFF of EPSMUL, and one ULP to either "
    "side",
    "", float, double) {
  using Real = TestType;
  const Real half = Real(0.5);
  const Real edge = half + half / Real(256);
  const std::vector<Real> faces = {half,
                                   edge,
                                   std::nextafter(edge, Real(0)),
                                   std::nextafter(edge, Real(1)),
                                   Real(0),
                                   Real(0.75),
                                   -half,
                                   static_cast<Real>(5e-11),
                                   Real(0.996)};
  const std::vector<Real> responses = {Real(0),
                                       Real(1),
                                       Real(-1),
                                       Real(2),
                                       half,
                                       static_cast<Real>(1e-3),
                                       std::numeric_limits<Real>::quiet_NaN()};
  side_by_side<Real> both;
  call_inputs<Real> in = pairs_at_one_dof_each<Real>(2);
  std::array<int, 4> near_ties{};  // an exact tie; below, at and above EPSMUL
  for (const Real c1 : faces) {
    for (const Real c2 : faces) {
      for (const Real d1 : responses) {
        for (const Real d2 : responses) {
          for (int statuses = 0; statuses < 16; ++statuses) {
            in.cc = {c1, c2};
            in.dtest = {d1, d2};
            in.isep = {(statuses & 1) != 0 ? 1 : -1, (statuses & 2) != 0 ? 1 : -1};
            in.isurf = {(statuses & 4) != 0 ? 1 : -1, (statuses & 8) != 0 ? 1 : -1};
            both.put(in);
            const Real difference = std::abs(both.last_ss()[1] - both.last_smin()) / both.last_smin();
            const Real eps = Real(1) / Real(256);
            if (both.last_smin() == Real(1) || both.last_ss()[0] != both.last_smin()) continue;
            near_ties[0] += difference == Real(0);
            near_ties[1] += difference > eps / 2 && difference < eps;
            near_ties[2] += difference == eps;
            near_ties[3] += difference > eps && difference < 2 * eps;
          }
        }
      }
    }
  }
  require_no_mismatch(both);
  CHECK(both.branches().rarest() > 100);
  CHECK(both.calls() == 9 * 9 * 7 * 7 * 16);
  for (const int reached : near_ties) CHECK(reached >= 16);
}

TEMPLATE_TEST_CASE(
    "FORTRAN and C++ give equal answers in 100,000 random calls with up to 64 pairs and every dof layout", "",
    float, double) {
  using Real = TestType;
  constexpr int calls = 100'000;
  random_calls<Real> source(1989);
  side_by_side<Real> both;
  std::set<std::pair<int, int>> layouts;
  std::int64_t shared_nodes = 0;
  std::size_t most_pairs = 0;
  for (int i = 0; i < calls; ++i) {
    const call_inputs<Real>& in = source.random(i);
    both.put(in);
    layouts.insert({in.dof.indof, in.dof.ndofpn});
    most_pairs = std::max(most_pairs, in.id.size());
    shared_nodes += in.id.size() > 1 && in.id[0] == in.id[1];
  }
  require_no_mismatch(both);
  CHECK(both.calls() == calls);
  CHECK(both.compared().values > 3'000'000);
  CHECK(both.branches().rarest() > 5'000);
  CHECK(layouts.size() == 9);
  CHECK(most_pairs == 64);
  CHECK(shared_nodes > 1'000);
}
