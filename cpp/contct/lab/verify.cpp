#include "contct/lab/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/number/rational.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/session/run.hpp"

namespace contct {
namespace {

constexpr real_range not_negative{0.0, true, "a finite number, at least 0"};
constexpr int any_number = 1'000'000'000;

/// The double nearest to a fraction "p/q" in lowest terms, or to a decimal; nothing if `words` is neither.
std::optional<double> nearest_to(std::string_view words) {
  const std::size_t slash = words.find('/');
  if (slash == std::string_view::npos) {
    const auto x = number_in<double>(words);
    return x && std::isfinite(*x) ? x : std::nullopt;
  }
  const auto is_whole = [](std::string_view s) {  // Boost reads a number with a leading 0 as octal
    return s.find_first_not_of("0123456789") == std::string_view::npos && !s.empty() && s[0] != '0';
  };
  const std::size_t sign = words.starts_with('-') ? 1 : 0;
  const std::string top(words.substr(sign, slash - sign));
  const std::string bottom(words.substr(slash + 1));
  if (!is_whole(top) || !is_whole(bottom)) return std::nullopt;
  return (sign == 1 ? -1.0 : 1.0) * contct::rounded(rational(integer(top), integer(bottom)));
}

/// Reads the keys that identify a number of a problem.
expected_number read_place(const toml_value& t) {
  expected_number e;
  e.step = t["step"].integer(1, any_number);
  e.quantity = t["quantity"].text();
  if (t.has("node")) e.node = t["node"].integer(1, any_number);
  if (t.has("pair")) e.pair = t["pair"].integer(1, any_number);
  if (t.has("element")) e.element = t["element"].integer(1, any_number);
  if (t.has("end")) e.place = static_cast<int>(t["end"].choice({"left", "right"})) + 1;
  if (t.has("corner")) e.place = t["corner"].integer(1, 4);
  if (t.has("dof")) e.dof = t["dof"].text();
  if (t.has("change")) e.change = t["change"].choice({"make", "break"}) == 0 ? "make" : "break";
  if (t.has("from")) e.from = t["from"].real(any_real);
  if (t.has("along")) e.along = t["along"].choice({"edge", "diagonal"}) == 0 ? "edge" : "diagonal";
  return e;
}

expected_number read_check(const toml_value& t) {
  t.allow_only({"step",   "quantity", "node",    "pair",      "element",  "end",   "corner",   "dof",
                "change", "from",     "along",   "value",     "kind",     "exact", "relation", "printed",
                "cut",    "source",   "because", "tolerance", "faithful", "reason"});
  expected_number e = read_place(t);
  if (e.quantity == "state") {
    e.value = t["value"].choice({"contact", "separated"}) == 0 ? in_contact : separated;
  } else {
    e.value = t["value"].real(any_real);
    e.tolerance = t["tolerance"].real(not_negative);
    e.because = t["because"].text();
  }
  (void)t["kind"].choice({"published", "closed form", "recomputed"});
  e.kind = t["kind"].text();
  e.source = t["source"].text();
  if (t.has("faithful")) {
    e.faithful = t["faithful"].real(any_real);
    e.reason = t["reason"].text();
  }
  e.exact = t["exact"].text();
  if (e.quantity != "state" && !nearest_to(e.exact)) t["exact"].refuse("a decimal, or a fraction \"p/q\"");
  return e;
}

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// A node of the line along which zeros of w are searched.
struct way_point {
  double s;  // x of a beam; distance from the lower left corner of a plate
  std::size_t node;
};

/// The nodes of a beam from end to end, of a plate's lower edge, or of its diagonal of grid points (i, i).
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

double of_element(const element_results& elements, const expected_number& e, std::size_t quantity) {
  const bool there = e.element >= 1 && e.element <= static_cast<int>(elements.elements()) && e.place >= 1 &&
                     e.place <= elements.places;
  return there ? elements.at(e.element - 1, quantity)[e.place - 1] : not_there;
}

double of_support(const problem& p, const step_results& s, const expected_number& e) {
  const auto names = dof_names(p.geometry);
  for (std::size_t i = 0; i < p.supports.size(); ++i) {
    const support& at = p.supports[i];
    if (at.node + 1 == e.node && names[at.dof] == e.dof) return s.reactions[i];
  }
  return not_there;
}

double of_pair(const structure_state& end, const step_results& s, const expected_number& e) {
  const std::size_t pair = e.pair - std::size_t{1};
  if (pair >= s.pairs.size()) return not_there;
  if (e.quantity == "state") return end.isep[pair];
  if (e.quantity == "force") return s.pairs[pair].force;
  if (e.quantity != "gap") return not_there;
  return s.pairs[pair].gap;
}

/// An extreme such as "max moment" or "min w", or its place: "x of max moment".
double of_extreme(const step_results& s, std::string_view quantity) {
  constexpr std::string_view place = "x of ";
  const bool asks_place = quantity.starts_with(place);
  if (asks_place) quantity.remove_prefix(place.size());
  const bool most = quantity.starts_with("max ");
  if (!most && !quantity.starts_with("min ")) return not_there;
  const auto r = std::ranges::find(s.ranges, quantity.substr(4), &value_range::name);
  if (r == s.ranges.end()) return not_there;
  const placed_value& at = most ? r->most : r->least;
  return asks_place ? at.x : at.value;
}

/// The number of events of a step, or the share of the step at which `e.pair` has the event `e.change`.
double of_events(const step_record& s, const expected_number& e) {
  std::size_t count = 0;
  for (const increment_record& i : s.increments) {
    count += i.events.size();
    for (const event& at : i.events)
      if (e.quantity == "event" && at.pair + 1 == e.pair && (at.what == change::make) == (e.change == "make"))
        return i.fraction;
  }
  return e.quantity == "events" ? static_cast<double>(count) : not_there;
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

/// The index of `name` in `names`; nothing if it is missing.
/// The kinds of numbers. An error is relative to the largest number of its kind.
enum class kind_of_number { deflection, slope, force, moment, other };

kind_of_number kind_of(const expected_number& e) {
  std::string_view q = e.quantity;
  if (q.starts_with("max ") || q.starts_with("min ")) q.remove_prefix(4);
  if (q == "w" || q == "gap") return kind_of_number::deflection;
  if (q == "theta" || q == "wx" || q == "wy") return kind_of_number::slope;
  if (q == "force" || q == "shear" || (q == "reaction" && e.dof == "w")) return kind_of_number::force;
  if (q == "moment" || q == "mx" || q == "my" || q == "mxy" || q == "reaction") return kind_of_number::moment;
  return kind_of_number::other;
}

/// The double nearest to the exact number, or `value` for a state.
double exact_value(const expected_number& e) {
  return e.quantity == "state" ? e.value : nearest_to(e.exact).value();
}

template <class Names>
std::optional<std::size_t> place_in(const Names& names, const std::string& name) {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? std::nullopt : std::optional<std::size_t>(at - names.begin());
}

}  // namespace

std::vector<verification_case> read_verification(const std::string& path) {
  const std::string text = read_input(path);
  const toml::table document = parse_toml(text, path);
  const toml_value top(document, path);
  top.allow_only({"case"});
  std::vector<verification_case> cases;
  for (const toml_value& t : top["case"].tables()) {
    t.allow_only({"file", "check"});
    verification_case c{t["file"].text(), {}};
    for (const toml_value& check : t["check"].tables()) c.checks.push_back(read_check(check));
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

measurement::measurement(const problem& p, const run_recorder& path) : problem_(p), path_(path) {
  const load_path loads(p);
  for (const step_record& s : path.steps)
    read_.push_back(results_of(p, loads.at(s.end.step, s.end.fraction), s.end));
}

double measurement::of(const expected_number& e) const {
  if (e.step > static_cast<int>(read_.size())) return not_there;
  const step_record& step = path_.steps[e.step - 1];
  const step_results& read = read_[e.step - 1];
  const std::vector<double>& u = step.end.displacement;
  const auto names = dof_names(problem_.geometry);
  if (e.quantity == "event" || e.quantity == "events") return of_events(step, e);
  if (const auto dof = place_in(names, e.quantity))
    return u.at((std::max(e.node, 1) - 1) * names.size() + *dof);
  if (e.quantity == "contacts") return static_cast<double>(std::ranges::count(step.end.isep, in_contact));
  if (e.quantity == "zero") return zero_right_of(problem_.geometry, u, e);
  if (e.quantity == "reaction") return of_support(problem_, read, e);
  if (e.quantity.find(' ') != std::string::npos) return of_extreme(read, e.quantity);
  if (const auto quantity = place_in(read.elements.names, e.quantity))
    return of_element(read.elements, e, *quantity);
  return of_pair(step.end, read, e);
}

double measurement::size_of(const expected_number& e) const {
  if (e.quantity == "event") return 1.0;
  const kind_of_number kind = kind_of(e);
  double size = 0.0;
  const auto take = [&](double x) { size = std::max(size, std::abs(x)); };
  const std::size_t stride = dof_names(problem_.geometry).size();
  for (const step_record& s : path_.steps)
    for (std::size_t dof = 0; dof < s.end.displacement.size(); ++dof)
      if (kind == (dof % stride == 0 ? kind_of_number::deflection : kind_of_number::slope))
        take(s.end.displacement[dof]);
  for (const step_results& s : read_) {
    for (const value_range& r : s.ranges)
      if (r.name != "w" && kind == (r.name == "shear" ? kind_of_number::force : kind_of_number::moment))
        take(r.largest().value);
    if (kind != kind_of_number::force) continue;
    for (const pair_reading& p : s.pairs) take(p.force);
    for (std::size_t i = 0; i < s.reactions.size(); ++i)
      if (problem_.supports[i].dof == 0) take(s.reactions[i]);
  }
  return size;
}

std::string exact_disagreement(const expected_number& e, double computed, double allowed) {
  if (e.exact.empty()) return {};
  if (e.quantity == "state")
    return e.exact == (e.value == in_contact ? "contact" : "separated") ? ""
                                                                        : "the exact state is " + e.exact;
  const double exactly = exact_value(e);
  if (allowed == 0.0) allowed = e.tolerance * (exactly == 0.0 ? 1.0 : std::abs(exactly));
  if (!(std::abs(computed - exactly) <= allowed))
    return fmt::format("computed {:.17g}, exact value {}; allowed: a difference of {:.0e}", computed, e.exact,
                       allowed);
  if (!agrees(exactly, e.value, e.tolerance))
    return fmt::format("exact value {}; allowed: a relative difference of {:.0e} from the expected {}",
                       e.exact, e.tolerance, e.value);
  return {};
}

bool agrees(double measured, double value, double tolerance) {
  return std::abs(measured - value) <= tolerance * (value == 0.0 ? 1.0 : std::abs(value));
}

namespace {

/// A run of the kernels with the engine "refactor", the method of the paper, and the numbers of the path.
struct verified_run {
  verified_run(const problem& p, const linear_structure& s, std::vector<std::string> kernels)
      : path(p, s, {.kernels = std::move(kernels), .engine = "refactor"}) {
    path.go({});
    measured.emplace(p, path.result.record);
  }

  /// The certificate of the step of `e`; null if the step has none.
  [[nodiscard]] const certificate* certified(const expected_number& e) const {
    const auto& steps = path.result.judged.steps();
    const std::size_t at = e.step - 1;
    return at < steps.size() && steps[at] ? &*steps[at] : nullptr;
  }

  run path;
  std::optional<measurement> measured;
};

verified_number judged_number(const expected_number& e, const verified_run& listing,
                              const verified_run& corrected) {
  verified_number n{e, listing.measured->of(e), corrected.measured->of(e), false, false, "", 0};
  n.certified = listing.certified(e) != nullptr && listing.certified(e)->certified;
  const auto compare = [&](double found, const verified_run& by) {
    if (e.exact.empty() || by.certified(e) == nullptr || !n.apart.empty()) return;
    n.apart = exact_disagreement(e, found, certified_share * by.measured->size_of(e));
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
  const linear_structure s = structure_of(p);
  const verified_run listing(p, s, {"fortran", "cpp"});
  const verified_run corrected(p, s, {"corrected"});
  const lockstep_on_path& compared = *listing.path.result.compared;
  verified_case out{c.file,
                    p.title,
                    {},
                    listing.path.result.judged.steps(),
                    compared.calls(),
                    compared.compared().mismatches,
                    ""};
  if (out.calls == 0) out.failure = "the kernels were never called";
  if (out.mismatches > 0) out.failure = "FORTRAN and C++ differ";
  if (listing.path.result.end.status != path_status::solved)
    out.failure = "FORTRAN's path does not reach the full load";
  if (corrected.path.result.end.status != path_status::solved)
    out.failure = "the corrected path does not reach the full load";
  else if (!corrected.path.result.judged.all_certified())
    out.failure = "the corrected path has a state that is not certified";
  for (const expected_number& e : c.checks) out.numbers.push_back(judged_number(e, listing, corrected));
  return out;
}

}  // namespace contct
