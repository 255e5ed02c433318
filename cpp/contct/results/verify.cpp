#include "contct/results/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "contct/number/rational.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/quantities.hpp"
#include "contct/results/run.hpp"

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

/// The entry of a list that `e` names, from 0, and its place in this entry; nothing if `e` names none.
std::optional<std::size_t> place_on(const problem& p, on list, std::size_t places, const expected_number& e) {
  const auto from_0 = [](int number) {
    return number > 0 ? std::optional<std::size_t>(number - 1) : std::nullopt;
  };
  if (list == on::nodes)
    return from_0(std::max(e.node, 1));  // a number of the structure is that of its first node
  if (list == on::pairs) return from_0(e.pair);
  const auto names = dof_names(p.geometry);
  if (const list_row& row = list_of(list); row.node != nullptr)
    for (std::size_t i = 0; i < row.count(p); ++i)
      if (row.node(p, i) + 1 == e.node && (list != on::supports || names[p.supports[i].dof] == e.dof))
        return i;
  if (list != on::element_ends || e.element < 1 || e.place < 1 || e.place > static_cast<int>(places))
    return {};
  return (e.element - 1) * places + e.place - 1;
}

/// In verification.toml the reaction of a slope is a reaction, and a displacement of a matrix is a "value".
bool is_meant(const quantity_row& row, const problem& p, const expected_number& e) {
  if (row.where == on::supports) return e.quantity == "reaction";
  return row.key == e.quantity || (e.quantity == dof_names(p.geometry)[0] && row.kind == quantity::w);
}

double of_row(const step_results& r, const expected_number& e) {
  for (const quantity_row* row : quantities_of(r.what)) {
    if (!is_meant(*row, r.what, e)) continue;
    const std::vector<double> values = row->values(r);
    const auto at = place_on(r.what, row->where, static_cast<std::size_t>(r.elements.places), e);
    if (at && *at < values.size() && !std::isnan(values[*at])) return values[*at];
  }
  return not_there;
}

/// An extreme such as "max moment" or "min w", or its place: "x of max moment".
double of_extreme(const step_results& s, std::string_view quantity) {
  constexpr std::string_view place = "x of ";
  const bool asks_place = quantity.starts_with(place);
  if (asks_place) quantity.remove_prefix(place.size());
  const bool most = quantity.starts_with("max ");
  if (!most && !quantity.starts_with("min ")) return not_there;
  const auto r = std::ranges::find(s.ranges(), quantity.substr(4), &value_range::name);
  if (r == s.ranges().end()) return not_there;
  const placed_value& at = most ? r->most : r->least;
  return asks_place ? at.x : at.value;
}

/// The number of events of a step, or the share of the step at which `e.pair` has the event `e.change`.
double of_events(const solved_step& s, const expected_number& e) {
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

/// The kinds of numbers whose errors are relative to the same size: deflections and gaps, forces, and others.
bool have_one_size(std::optional<quantity> a, std::optional<quantity> b) {
  const auto size = [](quantity kind) {
    const bool is_force = kind == quantity::reaction || kind == quantity::shear;
    return is_force ? quantity::force : kind == quantity::gap ? quantity::w : kind;
  };
  return a && b && size(*a) == size(*b);
}

/// The kind of `e`; nothing for places, counts and states, which certificates do not cover.
std::optional<quantity> kind_of(const problem& p, const expected_number& e) {
  std::string_view key = e.quantity;
  if (key.starts_with("max ") || key.starts_with("min ")) key.remove_prefix(4);
  if (key == "reaction") return e.dof == "w" ? quantity::reaction : quantity::moment;
  for (const quantity_row* row : quantities_of(p))
    if (row->key == key || is_meant(*row, p, e)) return row->kind;
  return {};
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
  for (const solved_step& s : path.steps) read_.emplace_back(p, s);
}

double measurement::of(const expected_number& e) const {
  if (e.step > static_cast<int>(read_.size())) return not_there;
  const solved_step& step = path_.steps[e.step - 1];
  if (e.quantity == "event" || e.quantity == "events") return of_events(step, e);
  if (e.quantity == "contacts") return static_cast<double>(std::ranges::count(step.isep, in_contact));
  if (e.quantity == "zero") return zero_right_of(problem_.geometry, step.displacement, e);
  if (e.quantity.find(' ') != std::string::npos) return of_extreme(read_[e.step - 1], e.quantity);
  if (e.quantity == "state" && e.pair <= std::ssize(step.isep)) return step.isep[e.pair - 1];
  return of_row(read_[e.step - 1], e);
}

double measurement::size_of(const expected_number& e) const {
  if (e.quantity == "event") return 1.0;
  const std::optional<quantity> kind = kind_of(problem_, e);
  double size = 0.0;
  const auto take = [&](double x) { size = std::fmax(size, std::abs(x)); };  // NaN: no number
  for (const step_results& s : read_) {
    for (const quantity_row* row : quantities_of(problem_))
      if (have_one_size(kind, row->kind) && row->kind != quantity::gap)
        std::ranges::for_each(row->values(s), take);
    for (const value_range& r : s.ranges())
      if (have_one_size(kind, row_named(problem_, r.name).kind)) take(r.largest().value);
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
    const auto& steps = path.result.record.steps;
    const std::size_t at = e.step - 1;
    return at < steps.size() && steps[at].judged ? &*steps[at].judged : nullptr;
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
  verified_case out{
      c.file, p.title, {}, listing.path.result.record.steps, compared.calls(), compared.compared().mismatches,
      ""};
  if (out.calls == 0) out.failure = "the kernels were never called";
  if (out.mismatches > 0) out.failure = "FORTRAN and C++ differ";
  if (listing.path.result.end.status != path_status::solved)
    out.failure = "FORTRAN's path does not reach the full load";
  if (corrected.path.result.end.status != path_status::solved)
    out.failure = "the corrected path does not reach the full load";
  else if (!corrected.path.result.all_certified())
    out.failure = "the corrected path has a state that is not certified";
  for (const expected_number& e : c.checks) out.numbers.push_back(judged_number(e, listing, corrected));
  return out;
}

}  // namespace contct
