// The hunt: its calls stand on the listing's thresholds, are the same everywhere, and fall into shards.
#include "contct/lab/call_campaign.hpp"

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "catch.hpp"
#include "contct/kernel/contct.hpp"

using namespace contct;

namespace {

/// A number that says whether two calls are the same.
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

TEMPLATE_TEST_CASE("adversarial calls stand on every threshold, and one ULP to either side of it", "", float,
                   double) {
  using Real = TestType;
  adversarial_calls<Real> source(1989);
  std::map<branch, std::array<int, 3>> near;  // exactly on it; true and false by one ULP
  std::vector<Real> ss;
  std::vector<int> isep;
  std::vector<event> events;
  for (std::uint64_t n = 1; n <= 40'000; ++n) {
    const call_inputs<Real>& in = source.at(n);
    ss.resize(in.pairs());
    isep = in.isep;
    events.resize(in.pairs());
    call<Real> c{in.dd, in.dtest, in.cc, ss, Real(0), in.id, isep, in.isurf, in.dof};
    (void)contct::contct(c, std::span<event>(events));
    for (const decision& d : decisions_of<Real>(c, in.isep)) {
      near[d.what][0] += d.ulps == 0;
      near[d.what][1] += d.ulps == 1 && d.outcome;
      near[d.what][2] += d.ulps == 1 && !d.outcome;
    }
  }
  for (const branch b : {branch::no_response, branch::stationary, branch::s_positive, branch::s_is_smallest,
                         branch::no_events}) {
    INFO(branch_names[static_cast<std::size_t>(b)]);
    CHECK(near[b][0] >= 20);
    CHECK(near[b][1] + near[b][2] >= 20);
  }
  CHECK(near[branch::within_epsmul][0] >=
        20);  // DIFF has a finer grid than SS: one ULP of SS is many of DIFF
  CHECK(near[branch::check_positive][0] >= 20);
}

TEST_CASE("a call is a function of the seed and its number alone") {
  for (const int real_bytes : {4, 8}) {
    call_source forwards(7, real_bytes);
    call_source backwards(7, real_bytes);
    std::map<std::uint64_t, std::uint64_t> seen;
    for (std::uint64_t n = 1; n <= 200; ++n) seen[n] = digest(forwards.at(n));
    for (std::uint64_t n = 200; n >= 1; --n) CHECK(digest(backwards.at(n)) == seen[n]);
    call_source other(8, real_bytes);
    int same = 0;
    for (std::uint64_t n = 1; n <= 200; ++n) same += digest(other.at(n)) == seen[n];
    CHECK(same < 10);  // but for calls without pairs
  }
}

TEST_CASE("nobody's dofs are NaN, so that who reads there is found out") {
  call_source source(1989, 8);
  for (std::uint64_t n = 1; n <= 50; ++n) {
    const call_inputs<double>& in = source.at(n);
    std::vector<char> watched(in.dd.size(), 0);
    for (std::size_t i = 0; i < in.pairs(); ++i) watched[in.dof_of_pair(i)] = 1;
    int wrong = 0;
    for (std::size_t dof = 0; dof < in.dd.size(); ++dof)
      wrong += watched[dof] == 0 && !(std::isnan(in.dd[dof]) && std::isnan(in.dtest[dof]));
    CHECK(wrong == 0);
  }
}

TEST_CASE("shards together put the calls of the whole run") {
  std::vector<branch_counts> counts;
  std::vector<std::int64_t> calls;
  for (const std::uint64_t stride : {1, 3}) {
    counts.emplace_back();
    calls.push_back(0);
    for (std::uint64_t shard = 1; shard <= stride; ++shard) {
      call_campaign h("fortran", {"cpp"}, 5);
      h.put(shard, 3000, stride);
      counts.back().add(h.branches());
      calls.back() += h.calls();
      CHECK(h.followers()[0].compared.mismatches == 0);
      CHECK(h.followers()[0].compared.values > 3 * h.calls());
    }
  }
  CHECK(calls == std::vector<std::int64_t>{3000, 3000});
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true})
      CHECK(counts[0].of(static_cast<branch>(b), outcome) == counts[1].of(static_cast<branch>(b), outcome));
  }
}

TEST_CASE("a hunt refuses kernels that cannot be equal") {
  CHECK_THROWS_AS(call_campaign("fortran", {"corrected"}, 1), std::invalid_argument);
  CHECK_THROWS_AS(call_campaign("fortran", {"cpp-r4"}, 1), std::invalid_argument);
  CHECK_THROWS_AS(call_campaign("fortran", {"nobody"}, 1), std::invalid_argument);
}
