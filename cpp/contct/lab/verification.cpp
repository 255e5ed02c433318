#include "contct/lab/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/kernel/call.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/load_text.hpp"

namespace contct {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();
constexpr real_range not_negative{0.0, true, "a finite number, at least 0"};
constexpr int any_number = 1'000'000'000;

expected_number read_check(const table_reader& t) {
  t.allow_only({"step", "quantity", "node", "pair", "element", "end", "corner", "dof", "change", "from",
                "along", "value", "kind", "tolerance", "because", "source", "faithful", "reason"});
  expected_number e;
  e.step = t.integer("step", 1, any_number);
  e.quantity = t.text("quantity");
  if (t.has("node")) e.node = t.integer("node", 1, any_number);
  if (t.has("pair")) e.pair = t.integer("pair", 1, any_number);
  if (t.has("element")) e.element = t.integer("element", 1, any_number);
  if (t.has("end")) e.place = static_cast<int>(t.choice("end", {"left", "right"})) + 1;
  if (t.has("corner")) e.place = t.integer("corner", 1, 4);
  if (t.has("dof")) e.dof = t.text("dof");
  if (t.has("change")) e.change = t.choice("change", {"make", "break"}) == 0 ? "make" : "break";
  if (t.has("from")) e.from = t.real("from", any_real);
  if (t.has("along")) e.along = t.choice("along", {"edge", "diagonal"}) == 0 ? "edge" : "diagonal";
  if (e.quantity == "state") {
    e.value = t.choice("value", {"contact", "separated"}) == 0 ? in_contact : separated;
  } else {
    e.value = t.real("value", any_real);
    e.tolerance = t.real("tolerance", not_negative);
    e.because = t.text("because");
  }
  constexpr const char* kinds[] = {"published", "closed form", "recomputed"};
  e.kind = kinds[t.choice("kind", {"published", "closed form", "recomputed"})];
  e.source = t.text("source");
  if (t.has("faithful")) {
    e.faithful = t.real("faithful", any_real);
    e.reason = t.text("reason");
  }
  return e;
}

/// A node on the way along which a change of sign is looked for.
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

std::vector<verification_case> read_verification(const std::string& path) {
  const toml::table document = parse_toml(read_input(path), path);
  const table_reader top(document, "", path);
  top.allow_only({"case"});
  std::vector<verification_case> cases;
  for (const table_reader& t : top.tables("case")) {
    t.allow_only({"file", "check"});
    verification_case c{t.text("file"), {}};
    for (const table_reader& check : t.tables("check")) c.checks.push_back(read_check(check));
    cases.push_back(std::move(c));
  }
  return cases;
}

void measurement::incremented(const increment& i) {
  for (const event& e : i.events) events_.push_back({i.step, i.fraction, e});
}

void measurement::step_ended(const step_state& s) {
  const load total = load_path(problem_).at(s.step, s.fraction);
  step_record record;
  record.u.assign(s.displacement.begin(), s.displacement.end());
  record.isep.assign(s.isep.begin(), s.isep.end());
  record.elements = results_in_elements(problem_.geometry, total, s.displacement);
  record.reactions = reactions(problem_.geometry, total, problem_.supports, s.displacement);
  steps_.push_back(std::move(record));
}

double measurement::of(const expected_number& e) const {
  if (e.quantity == "event" || e.quantity == "events") return of_events(e);
  if (static_cast<std::size_t>(e.step) > steps_.size()) return not_there;
  const step_record& s = steps_[static_cast<std::size_t>(e.step - 1)];
  const auto names = dof_names(problem_.geometry);
  if (const auto at = std::find(names.begin(), names.end(), e.quantity); at != names.end())
    return s.u.at(static_cast<std::size_t>(std::max(e.node, 1) - 1) * names.size() +
                  static_cast<std::size_t>(at - names.begin()));
  if (e.quantity == "contacts")
    return static_cast<double>(std::count(s.isep.begin(), s.isep.end(), in_contact));
  if (e.quantity == "zero") return zero_right_of(e, s);
  if (e.quantity == "reaction") return of_support(e, s);
  const std::vector<std::string_view>& quantities = s.elements.names;
  if (const auto at = std::find(quantities.begin(), quantities.end(), e.quantity); at != quantities.end())
    return of_element(e, static_cast<std::size_t>(at - quantities.begin()), s);
  return of_pair(e, s);
}

double measurement::of_element(const expected_number& e, std::size_t quantity, const step_record& s) {
  if (e.element < 1 || static_cast<std::size_t>(e.element) > s.elements.elements() || e.place < 1 ||
      e.place > s.elements.places) {
    return not_there;
  }
  return s.elements.at(static_cast<std::size_t>(e.element - 1),
                       quantity)[static_cast<std::size_t>(e.place - 1)];
}

double measurement::of_support(const expected_number& e, const step_record& s) const {
  const auto names = dof_names(problem_.geometry);
  for (std::size_t i = 0; i < problem_.supports.size(); ++i) {
    const support& at = problem_.supports[i];
    if (at.node + 1 == e.node && names[static_cast<std::size_t>(at.dof)] == e.dof) return s.reactions[i];
  }
  return not_there;
}

double measurement::of_pair(const expected_number& e, const step_record& s) const {
  if (e.pair < 1 || static_cast<std::size_t>(e.pair) > problem_.pairs.size()) return not_there;
  const auto i = static_cast<std::size_t>(e.pair - 1);
  const contact_pair& p = problem_.pairs[i];
  const double w = s.u[static_cast<std::size_t>(p.node * dofs_per_node(problem_.geometry))];
  const bool closed = s.isep[i] == in_contact;
  if (e.quantity == "state") return s.isep[i];
  if (e.quantity == "force") return force_of(p, w, closed);
  if (e.quantity == "gap") return gap_of(p, w, closed);
  return not_there;
}

double measurement::of_events(const expected_number& e) const {
  int count = 0;
  for (const event_record& r : events_) {
    if (r.step != e.step) continue;
    ++count;
    const bool makes = r.what.what == change::make;
    if (e.quantity == "event" && r.what.pair + 1 == e.pair && makes == (e.change == "make"))
      return r.fraction;
  }
  return e.quantity == "events" ? count : not_there;
}

double measurement::zero_right_of(const expected_number& e, const step_record& s) const {
  const std::vector<way_point> way = way_through(problem_.geometry, e.along);
  const auto stride = static_cast<std::size_t>(dofs_per_node(problem_.geometry));
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double left = s.u[way[i].node * stride];
    const double right = s.u[way[i + 1].node * stride];
    if (way[i].s < e.from || left * right > 0 || left == right) continue;
    return way[i].s + (way[i + 1].s - way[i].s) * left / (left - right) - e.from;
  }
  return not_there;
}

bool agrees(double measured, double value, double tolerance) {
  return std::abs(measured - value) <= tolerance * (value == 0.0 ? 1.0 : std::abs(value));
}

}  // namespace contct
