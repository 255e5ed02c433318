// The scans by every set of instructions that this machine has, beside the plain loops.
#include "contct/kernel/wide_scan.hpp"

#include <cmath>
#include <limits>
#include <numeric>

#include "catch.hpp"
#include "contct/kernel/call_inputs.hpp"
#include "contct/kernel/contct_quick.hpp"
#include "contct/kernel/corrected.hpp"
#include "contct/numeric/bits.hpp"
#include "contct/numeric/random.hpp"

using namespace contct::app;
using contct::kernels::contct_wide;
using contct::kernels::wide_scan;
using contct::kernels::wide_scans;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double odd_numbers[] = {std::numeric_limits<double>::quiet_NaN(),
                                  inf,
                                  -inf,
                                  0.0,
                                  -0.0,
                                  std::numeric_limits<double>::denorm_min(),
                                  -1e-320,
                                  1e-300,
                                  1e308,
                                  -1e308,
                                  1e-10,
                                  -1e-10};

/// Where the dofs of the pairs are: side by side, at every second or third dof, anyhow.
void place_pairs(random_numbers& r, call_inputs<double>& in, std::size_t n) {
  const int kind = r.whole(0, 3);
  in.dof.ndofpn = kind == 3 ? r.whole(1, 3) : kind + 1;
  in.dof.indof = r.whole(1, in.dof.ndofpn);
  const int first = r.whole(1, 5);
  in.id.resize(n);
  std::iota(in.id.begin(), in.id.end(), first);
  if (kind == 3)
    for (int& id : in.id) id = r.whole(1, static_cast<int>(n));
  const std::size_t dofs = (n + 5) * in.dof.ndofpn;
  in.dd.assign(dofs, 77.0);
  in.dtest.assign(dofs, -0.5);
}

/// A call of any kind: `odd` is the chance of a number that is none, infinite, subnormal or a zero; many
/// ties, pairs at their faces and quiet ones, and a few statuses that are none.
call_inputs<double> random_call(random_numbers& r, double odd) {
  call_inputs<double> in;
  const auto n = static_cast<std::size_t>(r.chance(0.1) ? r.whole(100, 400) : r.whole(0, 70));
  place_pairs(r, in, n);
  const bool quiet = r.chance(0.5);  // no event ahead but of those that tie
  const double tie = r.unit();
  for (std::size_t i = 0; i < n; ++i) {
    in.isep.push_back(r.chance(0.5) ? separated : in_contact);
    in.isurf.push_back(r.chance(0.5) ? face_above : face_below);
    double d = 2 * r.unit() - 1;
    double d_star = r.chance(0.1) ? 0.0 : std::ldexp(2 * r.unit() - 1, r.whole(-40, 2));
    if (quiet) d_star = 1 + r.unit();
    double c = d + (r.chance(0.2) ? 0.0 : std::ldexp(2 * r.unit() - 1, r.whole(-60, 2)));
    if (quiet) c = d - d_star;
    if (r.chance(0.1)) c = d + tie * d_star * (1 + r.whole(-2, 2) * std::ldexp(1.0, -9));
    if (r.chance(odd)) d = odd_numbers[r.whole(0, 11)];
    if (r.chance(odd)) d_star = odd_numbers[r.whole(0, 11)];
    if (r.chance(odd)) c = odd_numbers[r.whole(0, 11)];
    if (r.chance(odd)) in.isep.back() = r.whole(-3, 3);
    if (r.chance(odd)) in.isurf.back() = r.whole(-3, 3);
    in.cc.push_back(c);
    in.dd[in.dof_of_pair(i)] = d;
    in.dtest[in.dof_of_pair(i)] = d_star;
  }
  return in;
}

/// Both answers of one call, and its events as data.
struct both_answers {
  call_outputs plain, wide;
  std::vector<event> plain_events, wide_events;

  [[nodiscard]] bool equal() const {
    bool all = same_bits(plain.smin, wide.smin) && plain.isep == wide.isep && plain_events == wide_events;
    for (std::size_t i = 0; i < plain.ss.size(); ++i) all = all && same_bits(plain.ss[i], wide.ss[i]);
    return all;
  }
};

both_answers by_listing(const call_inputs<double>& in, const wide_scan& scan) {
  both_answers both;
  const auto ask = [&in](call_outputs& out, std::vector<event>& events, auto rule) {
    call<double> c = out.prepare(in);
    events.resize(in.pairs());
    events.resize(static_cast<std::size_t>(rule(c, std::span<event>(events))));
    out.smin = c.smin;
  };
  ask(both.plain, both.plain_events, [](auto& c, auto e) { return contct::app::contct(c, e); });
  ask(both.wide, both.wide_events, [&scan](auto& c, auto e) { return contct_wide(c, e, scan); });
  return both;
}

both_answers by_corrected_rule(const call_inputs<double>& in, const wide_scan& scan, int at_rest) {
  both_answers both;
  const auto ask = [&in, at_rest](call_outputs& out, auto rule) {
    call<double> c = out.prepare(in);
    c.at_rest = at_rest;
    rule(c);
    out.smin = c.smin;
  };
  ask(both.plain, [](auto& c) { contct_corrected(c); });
  ask(both.wide, [&scan](auto& c) { contct_corrected_quick(c, scan); });
  return both;
}

}  // namespace

TEST_CASE("wide scan: the 1989 rule, to the bit by every set of instructions that this machine has") {
  for (const wide_scan& scan : wide_scans()) {
    random_numbers r(2201);
    int pairs = 0;
    int events = 0;
    int ties = 0;
    int no_numbers = 0;
    for (int round = 0; round < 20000; ++round) {
      const call_inputs<double> in = random_call(r, r.chance(0.5) ? 0.03 : 0.0);
      const both_answers both = by_listing(in, scan);
      INFO(scan.name << ", call " << round);
      REQUIRE(both.equal());
      pairs += static_cast<int>(in.pairs());
      events += both.plain_events.empty() ? 0 : 1;
      ties += both.plain_events.size() > 1 ? 1 : 0;
      for (const double s : both.plain.ss) no_numbers += std::isnan(s) ? 1 : 0;
    }
    INFO(scan.name);
    CHECK(pairs > 900'000);
    CHECK(events > 14'000);
    CHECK(ties > 3000);
    CHECK(no_numbers > 2000);
  }
}

TEST_CASE("wide scan: the corrected rule, to the bit by every set of instructions that this machine has") {
  for (const wide_scan& scan : wide_scans()) {
    random_numbers r(2202);
    int events = 0;
    int at_faces = 0;
    for (int round = 0; round < 20000; ++round) {
      const call_inputs<double> in = random_call(r, r.chance(0.5) ? 0.03 : 0.0);
      const both_answers both = by_corrected_rule(in, scan, r.chance(0.5) ? 10000 : 0);
      INFO(scan.name << ", call " << round);
      REQUIRE(both.equal());
      events += both.plain.smin < 1.0 ? 1 : 0;
      at_faces += both.plain.smin == 0.0 ? 1 : 0;
    }
    INFO(scan.name);
    CHECK(events > 15'000);
    CHECK(at_faces > 10'000);
  }
}

TEST_CASE("wide scan: an event of any single pair is found, wherever it is among those that are quiet") {
  for (const wide_scan& scan : wide_scans()) {
    for (std::size_t n = 1; n <= 5 * scan.lanes; ++n) {
      for (std::size_t at = 0; at < n; ++at) {
        call_inputs<double> in;
        in.dd.assign(n, 0.0);
        in.dtest.assign(n, 1.0);
        in.cc.assign(n, 2.0);
        in.cc[at] = 0.25;
        in.id.resize(n);
        std::iota(in.id.begin(), in.id.end(), 1);
        in.isep.assign(n, separated);
        in.isurf.assign(n, face_above);
        INFO(scan.name << ", pair " << at << " of " << n);
        const both_answers listing = by_listing(in, scan);
        REQUIRE(listing.equal());
        REQUIRE(listing.wide_events == std::vector<event>{{static_cast<int>(at), change::make}});
        const both_answers corrected = by_corrected_rule(in, scan, 0);
        REQUIRE(corrected.equal());
        REQUIRE(corrected.wide.isep[at] == in_contact);
      }
    }
  }
}

TEST_CASE("wide scan: two lanes are there on any processor, and the widest is what the kernels take") {
  REQUIRE_FALSE(wide_scans().empty());
  std::size_t lanes = 1;
  for (const wide_scan& scan : wide_scans()) {
    CHECK(scan.lanes == 2 * lanes);
    lanes = scan.lanes;
    CHECK(scan.whole(2 * lanes) == 2 * lanes);
    CHECK(scan.whole(2 * lanes - 1) == 0);
  }
  CHECK(&contct::kernels::widest_scan() == &wide_scans().back());
#if defined(__x86_64__) && defined(__linux__)
  if (__builtin_cpu_supports("avx2")) CHECK(wide_scans().size() >= 2);
  if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    CHECK(wide_scans().size() == 3);
#endif
}
