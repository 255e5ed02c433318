#include "contct/lab/verified.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/certify/fallback.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct {
namespace {

path_end follow_listing(const problem& p, const linear_structure& s, measurement& m, certifier& judged,
                        verified_case& out) {
  const auto leader = make_kernel("fortran");
  const std::vector<std::string> followers = {"cpp"};
  lockstep compared = make_lockstep(leader->facts(), followers);
  const path_end end = follow(p, s, "refactor", *leader, {&compared, &judged, &m});
  out.calls = compared.calls();
  out.mismatches = compared.compared().mismatches;
  return end;
}

}  // namespace

double verified_number::difference() const {
  const double off = computed - expected.value;
  return expected.value == 0.0 ? off : off / std::abs(expected.value);
}

bool verified_case::passed() const {
  return failure.empty() && !numbers.empty() &&
         std::all_of(numbers.begin(), numbers.end(), [](const verified_number& n) { return n.passed; });
}

verified_case verify_case(const verification_case& c, const problem& p) {
  verified_case out;
  out.file = c.file;
  out.title = p.title;
  const linear_structure s = structure_of(p);
  measurement listing(p);
  certifier judged(s, loads_of(p));
  const path_end end = follow_listing(p, s, listing, judged, out);
  measurement corrected(p);
  certifier judged_corrected(s, loads_of(p));
  path_limits limits;
  limits.fallback = fallback_to_reference(s);
  const path_end corrected_end =
      follow(p, s, "refactor", *make_kernel("corrected"), {&judged_corrected, &corrected}, limits);

  out.certificates = judged.steps();
  if (out.calls == 0) out.failure = "the kernels were never called";
  if (out.mismatches > 0) out.failure = "FORTRAN and C++ differ";
  if (end.status != path_status::solved) out.failure = "FORTRAN's path does not reach its end";
  if (corrected_end.status != path_status::solved) out.failure = "the corrected path does not reach its end";
  if (!judged_corrected.all_exact()) out.failure = "the corrected kernel is not certified";
  for (const expected_number& e : c.checks) {
    verified_number n;
    n.expected = e;
    n.computed = listing.of(e);
    n.corrected = corrected.of(e);
    const auto step = static_cast<std::size_t>(e.step - 1);
    n.certified = step < out.certificates.size() && out.certificates[step] && out.certificates[step]->exact;
    n.passed = agrees(n.computed, e.faithful.value_or(e.value), e.tolerance) &&
               agrees(n.corrected, e.value, e.tolerance);
    out.numbers.push_back(std::move(n));
  }
  return out;
}

std::string quantity_words(const expected_number& e) {
  if (e.quantity == "event") return fmt::format("pair {} {}s", e.pair, e.change);
  if (e.quantity == "events") return "toggles";
  if (e.quantity == "contacts") return "pairs in contact";
  if (e.quantity == "zero") return e.along.empty() ? "w = 0 at x" : fmt::format("w = 0 along {}", e.along);
  if (e.quantity == "reaction") return fmt::format("reaction {}, node {}", e.dof, e.node);
  if (e.pair > 0) return fmt::format("{}, pair {}", e.quantity, e.pair);
  if (e.element > 0) return fmt::format("{}, element {}.{}", e.quantity, e.element, e.place);
  return fmt::format("{}, node {}", e.quantity, e.node);
}

}  // namespace contct
