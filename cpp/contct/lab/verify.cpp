#include "contct/lab/verify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/certify/final_state.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/write/load_text.hpp"

namespace contct::lab {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// A node of the line along which a change of sign of w is looked for.
struct way_point {
  double s;  // a beam's x; on a plate, the distance from its lower left corner
  std::size_t node;
};

/// A beam from end to end; a plate along its lower edge, or up its diagonal through grid points (i, i).
std::vector<way_point> way_through(const model& m, const std::string& along) {
  std::vector<way_point> way;
  if (const auto* b = std::get_if<beam>(&m.kind)) {
    for (std::size_t i = 0; i < b->x.size(); ++i) way.push_back({b->x[i], i});
  }
  if (const auto* p = std::get_if<plate>(&m.kind)) {
    const bool diagonal = along == "diagonal";
    const std::size_t last = diagonal ? std::min(p->x.size(), p->y.size()) : p->x.size();
    for (std::size_t i = 0; i < last; ++i) {
      const double rise = diagonal ? p->y[i] - p->y[0] : 0.0;
      way.push_back({std::hypot(p->x[i] - p->x[0], rise), diagonal ? i * p->x.size() + i : i});
    }
  }
  return way;
}

}  // namespace

void measurement::step_ended(const step_state& s) {
  const load total = load_path(problem_).at(s.step, s.fraction);
  path_.step_ended(s);
  steps_.push_back({{s.isep.begin(), s.isep.end()},
                    results_in_elements(problem_.geometry, total, s.displacement),
                    reactions(problem_.geometry, total, problem_.supports, s.displacement)});
}

double measurement::of(const expected_number& e) const {
  if (e.quantity == "event" || e.quantity == "events") return of_events(e);
  if (e.step > static_cast<int>(steps_.size())) return not_there;
  const step_record& s = steps_[e.step - 1];
  const auto names = dof_names(problem_.geometry);
  if (const auto at = std::find(names.begin(), names.end(), e.quantity); at != names.end())
    return u(e).at((std::max(e.node, 1) - 1) * names.size() + (at - names.begin()));
  if (e.quantity == "contacts")
    return static_cast<double>(std::count(s.isep.begin(), s.isep.end(), in_contact));
  if (e.quantity == "zero") return zero_right_of(e);
  if (e.quantity == "reaction") return of_support(e);
  const std::vector<std::string_view>& quantities = s.elements.names;
  if (const auto at = std::find(quantities.begin(), quantities.end(), e.quantity); at != quantities.end())
    return of_element(e, at - quantities.begin());
  return of_pair(e);
}

double measurement::of_element(const expected_number& e, std::size_t quantity) const {
  const element_results& results = steps_[e.step - 1].elements;
  const bool there = e.element >= 1 && e.element <= static_cast<int>(results.elements()) && e.place >= 1 &&
                     e.place <= results.places;
  return there ? results.at(e.element - 1, quantity)[e.place - 1] : not_there;
}

double measurement::of_support(const expected_number& e) const {
  const auto names = dof_names(problem_.geometry);
  for (std::size_t i = 0; i < problem_.supports.size(); ++i) {
    const support& at = problem_.supports[i];
    if (at.node + 1 == e.node && names[at.dof] == e.dof) return steps_[e.step - 1].reactions[i];
  }
  return not_there;
}

double measurement::of_pair(const expected_number& e) const {
  if (e.pair < 1 || e.pair > static_cast<int>(problem_.pairs.size())) return not_there;
  const contact_pair& p = problem_.pairs[e.pair - 1];
  const int dof = p.node * dofs_per_node(problem_.geometry);
  const double w = u(e)[dof];
  const int isep = steps_[e.step - 1].isep[e.pair - 1];
  if (e.quantity == "state") return isep;
  if (e.quantity == "force") return force_of(p, w, isep == in_contact);
  if (e.quantity == "gap") return gap_of(p, w, isep == in_contact);
  return not_there;
}

double measurement::of_events(const expected_number& e) const {
  int count = 0;
  for (const timed_event& r : path_.events) {
    if (r.step != e.step) continue;
    ++count;
    const bool makes = r.what.what == change::make;
    if (e.quantity == "event" && r.what.pair + 1 == e.pair && makes == (e.change == "make"))
      return r.fraction;
  }
  return e.quantity == "events" ? count : not_there;
}

double measurement::zero_right_of(const expected_number& e) const {
  const std::vector<way_point> way = way_through(problem_.geometry, e.along);
  const int stride = dofs_per_node(problem_.geometry);
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double left = u(e)[way[i].node * stride];
    const double right = u(e)[way[i + 1].node * stride];
    if (way[i].s < e.from || left * right > 0 || left == right) continue;
    return way[i].s + (way[i + 1].s - way[i].s) * left / (left - right) - e.from;
  }
  return not_there;
}

bool agrees(double measured, double value, double tolerance) {
  return std::abs(measured - value) <= tolerance * (value == 0.0 ? 1.0 : std::abs(value));
}

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
  const auto fortran = make_kernel("fortran");
  const std::string followers[] = {"cpp"};
  lockstep compared = make_lockstep(fortran->facts(), followers);
  const path_end end = follow(p, s, "refactor", *fortran, {&compared, &judged, &listing});
  measurement corrected(p);
  certifier judged_corrected(s, loads_of(p));
  path_limits limits;
  limits.fallback = fallback_to_reference(s);
  const path_end corrected_end =
      follow(p, s, "refactor", *make_kernel("corrected"), {&judged_corrected, &corrected}, limits);

  out.calls = compared.calls();
  out.mismatches = compared.compared().mismatches;
  out.certificates = judged.steps();
  if (out.calls == 0) out.failure = "the kernels were never called";
  if (out.mismatches > 0) out.failure = "FORTRAN and C++ differ";
  if (end.status != path_status::solved) out.failure = "FORTRAN's path does not reach its end";
  if (corrected_end.status != path_status::solved) out.failure = "the corrected path does not reach its end";
  if (!judged_corrected.all_exact()) out.failure = "the corrected kernel is not certified";
  for (const expected_number& e : c.checks) {
    verified_number n{e, listing.of(e), corrected.of(e), false, false};
    const auto step = static_cast<std::size_t>(e.step - 1);
    n.certified = step < out.certificates.size() && out.certificates[step] && out.certificates[step]->exact;
    n.passed = agrees(n.computed, e.faithful.value_or(e.value), e.tolerance) &&
               agrees(n.corrected, e.value, e.tolerance);
    out.numbers.push_back(std::move(n));
  }
  return out;
}

}  // namespace contct::lab
