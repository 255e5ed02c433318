#include "contct/io/verification.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/io/input_text.hpp"
#include "contct/io/load_text.hpp"
#include "contct/io/toml_reader.hpp"
#include "contct/kernel/call.hpp"

namespace contct {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();
constexpr real_range not_negative{0.0, true, "a finite number, at least 0"};
constexpr int any_number = 1'000'000'000;

expected_number read_check(const table_reader& t) {
  t.allow_only({"step", "quantity", "node", "pair", "element", "end", "dof", "change", "from", "value",
                "kind", "tolerance", "because", "source", "faithful", "reason"});
  expected_number e;
  e.step = t.integer("step", 1, any_number);
  e.quantity = t.text("quantity");
  if (t.has("node")) e.node = t.integer("node", 1, any_number);
  if (t.has("pair")) e.pair = t.integer("pair", 1, any_number);
  if (t.has("element")) e.element = t.integer("element", 1, any_number);
  if (t.has("end")) e.end = t.choice("end", {"left", "right"}) == 0 ? "left" : "right";
  if (t.has("dof")) e.dof = t.text("dof");
  if (t.has("change")) e.change = t.choice("change", {"make", "break"}) == 0 ? "make" : "break";
  if (t.has("from")) e.from = t.real("from", any_real);
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
  record.forces = forces_in_elements(problem_.geometry, total, s.displacement);
  record.reactions = reactions(problem_.geometry, total, problem_.supports, s.displacement);
  steps_.push_back(std::move(record));
}

double measurement::of(const expected_number& e) const {
  if (e.quantity == "event" || e.quantity == "events") return of_events(e);
  if (static_cast<std::size_t>(e.step) > steps_.size()) return not_there;
  const step_record& s = steps_[static_cast<std::size_t>(e.step - 1)];
  const auto node = static_cast<std::size_t>(std::max(e.node, 1) - 1);
  if (e.quantity == "w") return s.u.at(2 * node);
  if (e.quantity == "theta") return s.u.at(2 * node + 1);
  if (e.quantity == "contacts")
    return static_cast<double>(std::count(s.isep.begin(), s.isep.end(), in_contact));
  if (e.quantity == "zero") return zero_right_of(e.from, s);
  if (e.quantity == "moment" || e.quantity == "shear") {
    const element_forces& f = s.forces.at(static_cast<std::size_t>(e.element - 1));
    const std::size_t end = e.end == "left" ? 0 : 1;
    return e.quantity == "moment" ? f.moment[end] : f.shear[end];
  }
  if (e.quantity == "reaction") {
    for (std::size_t i = 0; i < problem_.supports.size(); ++i) {
      const support& at = problem_.supports[i];
      if (at.node + 1 == e.node && beam_dof_names[at.dof] == e.dof) return s.reactions[i];
    }
    return not_there;
  }
  return of_pair(e, s);
}

double measurement::of_pair(const expected_number& e, const step_record& s) const {
  const auto i = static_cast<std::size_t>(e.pair - 1);
  const contact_pair& p = problem_.pairs.at(i);
  const double w = s.u[2 * static_cast<std::size_t>(p.node)];
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

double measurement::zero_right_of(double from, const step_record& s) const {
  const std::vector<double>& x = problem_.geometry.x;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double left = s.u[2 * i];
    const double right = s.u[2 * i + 2];
    if (x[i] < from || left * right > 0 || left == right) continue;
    return x[i] + (x[i + 1] - x[i]) * left / (left - right) - from;
  }
  return not_there;
}

bool agrees(double measured, double value, double tolerance) {
  return std::abs(measured - value) <= tolerance * (value == 0.0 ? 1.0 : std::abs(value));
}

}  // namespace contct
