#include "contct/lab/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/exact/exact_means.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/numeric/rational.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/read/toml_reader.hpp"

namespace contct::lab {
namespace {

constexpr real_range not_negative{0.0, true, "a finite number, at least 0"};
constexpr int any_number = 1'000'000'000;

/// The double nearest to an exact number: a fraction "p/q" in lowest terms, or a decimal. Nothing where
/// `words` are neither.
std::optional<double> nearest_to(std::string_view words) {
  const std::size_t slash = words.find('/');
  if (slash == std::string_view::npos) {
    const auto x = number_in<double>(words);
    return x && std::isfinite(*x) ? x : std::nullopt;
  }
  const auto is_whole = [](std::string_view s) {  // Boost takes a leading 0 for the mark of an octal number
    return s.find_first_not_of("0123456789") == std::string_view::npos && !s.empty() && s[0] != '0';
  };
  const std::size_t sign = words.starts_with('-') ? 1 : 0;
  const std::string top(words.substr(sign, slash - sign));
  const std::string bottom(words.substr(slash + 1));
  if (!is_whole(top) || !is_whole(bottom)) return std::nullopt;
  return (sign == 1 ? -1.0 : 1.0) * exact::rounded(rational(integer(top), integer(bottom)));
}

expected_number read_check(const table_reader& t) {
  t.allow_only({"step",   "quantity", "node",    "pair",      "element",  "end",   "corner",   "dof",
                "change", "from",     "along",   "value",     "kind",     "exact", "relation", "printed",
                "cut",    "source",   "because", "tolerance", "faithful", "reason"});
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
  (void)t.choice("kind", {"published", "closed form", "recomputed"});
  e.kind = t.text("kind");
  e.source = t.text("source");
  if (t.has("faithful")) {
    e.faithful = t.real("faithful", any_real);
    e.reason = t.text("reason");
  }
  e.exact = t.text("exact");
  if (e.quantity != "state" && !nearest_to(e.exact))
    t.refuse_key("exact", "a decimal, or a fraction \"p/q\"");
  return e;
}

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

double of_element(const measurement::step_record& s, const expected_number& e, std::size_t quantity) {
  const element_results& elements = s.read.elements;
  const bool there = e.element >= 1 && e.element <= static_cast<int>(elements.elements()) && e.place >= 1 &&
                     e.place <= elements.places;
  return there ? elements.at(e.element - 1, quantity)[e.place - 1] : not_there;
}

double of_support(const problem& p, const measurement::step_record& s, const expected_number& e) {
  const auto names = dof_names(p.geometry);
  for (std::size_t i = 0; i < p.supports.size(); ++i) {
    const support& at = p.supports[i];
    if (at.node + 1 == e.node && names[at.dof] == e.dof) return s.read.reactions[i];
  }
  return not_there;
}

double of_pair(const problem& problem, const measurement::step_record& s, const expected_number& e) {
  if (e.pair < 1 || e.pair > static_cast<int>(problem.pairs.size())) return not_there;
  const contact_pair& p = problem.pairs[e.pair - 1];
  const int dof = p.node * dofs_per_node(problem.geometry);
  const double w = s.u[dof];
  const int isep = s.isep[e.pair - 1];
  if (e.quantity == "state") return isep;
  if (e.quantity == "force") return s.read.pairs[e.pair - 1].force;
  if (e.quantity == "gap") return gap_of(p, w, isep == in_contact);
  return not_there;
}

/// "max moment", "min w", or where that is: "x of max moment".
double of_extreme(const measurement::step_record& s, std::string_view quantity) {
  constexpr std::string_view place = "x of ";
  const bool asks_place = quantity.starts_with(place);
  if (asks_place) quantity.remove_prefix(place.size());
  const bool most = quantity.starts_with("max ");
  if (!most && !quantity.starts_with("min ")) return not_there;
  const auto r = std::ranges::find(s.read.ranges, quantity.substr(4), &value_range::name);
  if (r == s.read.ranges.end()) return not_there;
  const placed_value& at = most ? r->most : r->least;
  return asks_place ? at.x : at.value;
}

double of_events(const std::vector<timed_event>& events, const expected_number& e) {
  int count = 0;
  for (const timed_event& r : events) {
    if (r.step != e.step) continue;
    ++count;
    const bool makes = r.what.what == change::make;
    if (e.quantity == "event" && r.what.pair + 1 == e.pair && makes == (e.change == "make"))
      return r.fraction;
  }
  return e.quantity == "events" ? count : not_there;
}

double zero_right_of(const model& m, const std::vector<double>& u, const expected_number& e) {
  const std::vector<way_point> way = way_through(m, e.along);
  const int stride = dofs_per_node(m);
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double left = u[way[i].node * stride];
    const double right = u[way[i + 1].node * stride];
    if (way[i].s < e.from || left * right > 0 || left == right) continue;
    return way[i].s + (way[i + 1].s - way[i].s) * left / (left - right) - e.from;
  }
  return not_there;
}

enum class kind_of_number { deflection, slope, force, moment, other };

/// What an error of this number is measured by.
kind_of_number kind_of(const expected_number& e) {
  std::string_view q = e.quantity;
  if (q.starts_with("max ") || q.starts_with("min ")) q.remove_prefix(4);
  if (q == "w" || q == "gap") return kind_of_number::deflection;
  if (q == "theta" || q == "wx" || q == "wy") return kind_of_number::slope;
  if (q == "force" || q == "shear" || (q == "reaction" && e.dof == "w")) return kind_of_number::force;
  if (q == "moment" || q == "mx" || q == "my" || q == "mxy" || q == "reaction") return kind_of_number::moment;
  return kind_of_number::other;
}

/// The place of `name` among `names`; none where it is not there.
template <class Names>
std::optional<std::size_t> place_in(const Names& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? std::nullopt : std::optional<std::size_t>(at - names.begin());
}

}  // namespace

std::vector<verification_case> read_verification(const std::string& path) {
  const std::string text = read_input(path);
  const toml::table document = parse_toml(text, path);
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

std::string quantity_words(const expected_number& e) {
  if (e.quantity == "event") return fmt::format("pair {} {}s", e.pair, e.change);
  if (e.quantity == "events") return "toggles";
  if (e.quantity == "contacts") return "pairs in contact";
  if (e.quantity == "zero") return e.along.empty() ? "w = 0 at x" : fmt::format("w = 0 along {}", e.along);
  if (e.quantity == "reaction") return fmt::format("reaction {}, node {}", e.dof, e.node);
  if (e.pair > 0) return fmt::format("{}, pair {}", e.quantity, e.pair);
  if (e.node == 0 && e.quantity.find(' ') != std::string::npos) return e.quantity;
  if (e.element > 0) return fmt::format("{}, element {}.{}", e.quantity, e.element, e.place);
  return fmt::format("{}, node {}", e.quantity, e.node);
}

void measurement::step_ended(const step_state& s) {
  const load total = load_path(problem_).at(s.step, s.fraction);
  steps_.push_back({{s.displacement.begin(), s.displacement.end()},
                    {s.isep.begin(), s.isep.end()},
                    results_of(problem_, total, s, deflecting_)});
}

double measurement::of(const expected_number& e) const {
  if (e.quantity == "event" || e.quantity == "events") return of_events(path_.events, e);
  if (e.step > static_cast<int>(steps_.size())) return not_there;
  const step_record& s = steps_[e.step - 1];
  const auto names = dof_names(problem_.geometry);
  if (const auto dof = place_in(names, e.quantity))
    return s.u.at((std::max(e.node, 1) - 1) * names.size() + *dof);
  if (e.quantity == "contacts")
    return static_cast<double>(std::count(s.isep.begin(), s.isep.end(), in_contact));
  if (e.quantity == "zero") return zero_right_of(problem_.geometry, s.u, e);
  if (e.quantity == "reaction") return of_support(problem_, s, e);
  if (e.quantity.find(' ') != std::string::npos) return of_extreme(s, e.quantity);
  if (const auto quantity = place_in(s.read.elements.names, e.quantity)) return of_element(s, e, *quantity);
  return of_pair(problem_, s, e);
}

double measurement::size_of(const expected_number& e) const {
  if (e.quantity == "event") return 1.0;
  const kind_of_number kind = kind_of(e);
  double size = 0.0;
  const auto take = [&](double x) { size = std::max(size, std::abs(x)); };
  const std::size_t stride = dof_names(problem_.geometry).size();
  for (const step_record& s : steps_) {
    for (std::size_t dof = 0; dof < s.u.size(); ++dof)
      if (kind == (dof % stride == 0 ? kind_of_number::deflection : kind_of_number::slope)) take(s.u[dof]);
    for (const value_range& r : s.read.ranges)
      if (r.name != "w" && kind == (r.name == "shear" ? kind_of_number::force : kind_of_number::moment))
        take(r.largest().value);
    if (kind != kind_of_number::force) continue;
    for (const pair_reading& p : s.read.pairs) take(p.force);
    for (std::size_t i = 0; i < s.read.reactions.size(); ++i)
      if (problem_.supports[i].dof == 0) take(s.read.reactions[i]);
  }
  return size;
}

std::string exact_disagreement(const expected_number& e, double computed, double allowed) {
  if (e.exact.empty()) return {};
  if (e.quantity == "state")
    return e.exact == (e.value == in_contact ? "contact" : "separated") ? ""
                                                                        : "the exact state is " + e.exact;
  const double exactly = nearest_to(e.exact).value();
  if (allowed == 0.0) allowed = e.tolerance * (exactly == 0.0 ? 1.0 : std::abs(exactly));
  if (!(std::abs(computed - exactly) <= allowed))
    return fmt::format("computed {:.17g}, exactly {}; allowed: {:.0e} apart", computed, e.exact, allowed);
  if (!agrees(exactly, e.value, e.tolerance))
    return fmt::format("exactly {}; allowed: {:.0e} of {}", e.exact, e.tolerance, e.value);
  return {};
}

bool agrees(double measured, double value, double tolerance) {
  return std::abs(measured - value) <= tolerance * (value == 0.0 ? 1.0 : std::abs(value));
}

namespace {

/// A path's numbers, and the certificate of the step that is asked about; null where there is none.
struct followed_path {
  const measurement& measured;
  const certificate* certified;
};

verified_number judged_number(const expected_number& e, const followed_path& listing,
                              const followed_path& corrected) {
  verified_number n{e, listing.measured.of(e), corrected.measured.of(e), false, false, "", 0};
  n.certified = listing.certified != nullptr && listing.certified->certified;
  const auto compare = [&](double found, const followed_path& path) {
    if (e.exact.empty() || path.certified == nullptr || !n.apart.empty()) return;
    n.apart = exact_disagreement(e, found, certified_share * path.measured.size_of(e));
    ++n.exact_comparisons;
  };
  compare(n.corrected, corrected);
  if (n.certified && !e.faithful) compare(n.computed, listing);
  n.passed = n.apart.empty() && agrees(n.computed, e.faithful.value_or(e.value), e.tolerance) &&
             agrees(n.corrected, e.value, e.tolerance);
  return n;
}

}  // namespace

verified_case verify_case(const verification_case& c, const problem& p) {
  verified_case out;
  out.file = c.file;
  out.title = p.title;
  const linear_structure s = structure_of(p);
  measurement listing(p);
  certifier judged(p, s, exact::exact_means_of(p));
  const auto fortran = make_kernel("fortran");
  const std::string followers[] = {"cpp"};
  lockstep_on_path compared(fortran->facts(), followers);
  const path_end end = follow(p, s, "refactor", *fortran, {&compared, &judged, &listing});
  measurement corrected(p);
  const problem_result right = try_structure(p, s, *make_kernel("corrected"), "refactor", {&corrected});

  out.calls = compared.calls();
  out.mismatches = compared.compared().mismatches;
  out.certificates = judged.steps();
  if (out.calls == 0) out.failure = "the kernels were never called";
  if (out.mismatches > 0) out.failure = "FORTRAN and C++ differ";
  if (end.status != path_status::solved) out.failure = "FORTRAN's path does not reach its end";
  if (right.came_to == verdict::wrong)
    out.failure = "the corrected kernel is not certified";
  else if (right.came_to != verdict::certified)
    out.failure = "the corrected path does not reach its end";
  for (const expected_number& e : c.checks) {
    const std::size_t at = e.step - 1;
    const bool reached = at < out.certificates.size() && out.certificates[at];
    out.numbers.push_back(
        judged_number(e, {listing, reached ? &*out.certificates[at] : nullptr},
                      {corrected, at < right.certificates.size() ? &right.certificates[at] : nullptr}));
  }
  return out;
}

}  // namespace contct::lab
