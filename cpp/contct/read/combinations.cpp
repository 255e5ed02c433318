#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "contct/read/tables.hpp"
#include "contct/structure/acting.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// Adds factor * part to `sum`. Each load in `sum` keeps `factor`, for exact arithmetic.
void add(load& sum, const load& part, double factor) {
  for (const auto values : nodal_values)
    for (const nodal_value& v : part.*values) (sum.*values).push_back({v.node, v.dof, v.value, factor});
  for (distributed_load d : part.distributed) {
    if (d.parts.empty()) d.parts = {{d.polynomial}};
    for (scaled_polynomial& p : d.parts) p.factor = factor;
    const std::vector<rational> exactly = coefficients_of(d);
    for (std::size_t i = 0; i < exactly.size() && factor != 1.0; ++i) d.polynomial[i] = rounded(exactly[i]);
    sum.distributed.push_back(std::move(d));
  }
  for (const placed_load& p : part.placed) sum.placed.emplace_back(p).factor = factor;
}

/// The name of a table. Refuses a table without a name, and a name that is already in `names`.
std::string unique_name(const toml_value& t, std::set<std::string>& names) {
  std::string name = t["name"].text();
  if (name.find_first_not_of(blanks) == std::string::npos) t["name"].refuse("a name");
  if (!names.insert(name).second) t["name"].refuse(in_quotes(name) + ", a second time", "each name once");
  return name;
}

/// Makes a step for each combination and for each position of a train.
class combination_reader {
 public:
  combination_reader(const toml_value& top, const node_reader& nodes, const std::vector<load>& cases)
      : nodes_(nodes), cases_(cases) {
    for (const char* kind : {"combination", "train"})
      for (const toml_value& t : top[kind].optional_tables())
        if (t.has("name")) kinds_.emplace(t["name"].text(), kind);
  }

  void read_combination(const toml_value& t) {
    t.allow_only({"name", "terms"});
    const std::string name = unique_name(t, names_);
    put(t, read_terms(t, name));
  }

  void read_train(const toml_value& t) {
    t.allow_only({"name", "axles", "from", "to", "by", "terms", "factor"});
    if (nodes_.axes().size() != 1)
      t.refuse(!nodes_.on_matrix() ? "a train on a plate" : "a train with a matrix",
               "a train on a beam; for other structures, a [[combination]] for each place of a load");
    const std::string name = unique_name(t, names_);
    std::vector<std::pair<rational, double>> axles;  // place from that of the train, force
    for (const toml_value& axle : t["axles"].tables()) {
      axle.allow_only({"at", "w"});
      axles.emplace_back(decimal_of(axle["at"].real(any_real)), axle["w"].real(any_real));
    }
    const double factor = t.has("factor") ? t["factor"].real(any_real) : 1.0;
    const load besides = t.has("terms")
                             ? read_terms(t, name)
                             : load{.points = {}, .distributed = {}, .name = name, .from_zero = true};
    const rational from = decimal_of(t["from"].real(any_real));
    const rational by = decimal_of(t["by"].real(positive_real));
    for (int k = 0, count = places_of(t, from, by); k < count; ++k) {
      const rational at = from + k * by;
      load l = besides;
      l.name = fmt::format("{} at {}", name, rounded(at));
      l.terms.push_back({name, factor, rounded(at)});
      for (const auto& [from_train, w] : axles) put_axle(at + from_train, w, factor, l);
      put(t, std::move(l));
    }
  }

  std::vector<load> steps;

 private:
  void put(const toml_value& t, load l) {
    refuse_endless_sums(t, nodes_.structure(), l);
    steps.push_back(std::move(l));
  }

  /// The sum of the cases that the key terms lists, each times its factor.
  [[nodiscard]] load read_terms(const toml_value& t, const std::string& name) const {
    const toml_value terms = t["terms"].table();
    std::vector<std::string> known;
    for (const load& c : cases_) known.push_back(printable(c.name));
    const toml::table& listed = *terms.required("").as_table();
    if (listed.empty()) terms.refuse("an empty table", "at least one case with its factor: { G = 1.35 }");
    for (const auto& [key, value] : listed) {
      const std::string term = printable(key.str());
      if (std::ranges::find(known, term) == known.end())
        terms[key.str()].refuse(kinds_.contains(term)
                                    ? fmt::format("a [[{}]], which has terms of its own", kinds_.at(term))
                                    : "no [[case]] of this name" + did_you_mean(term, known),
                                known.empty() ? "the name of a [[case]]; the file has no [[case]]"
                                              : "the name of a [[case]]: " + joined(known, ", "));
    }
    load sum{.points = {}, .distributed = {}, .name = name, .from_zero = true};
    for (const load& c : cases_) {
      if (!terms.has(c.name)) continue;
      sum.terms.push_back({c.name, terms[c.name].real(any_real)});
      add(sum, c, sum.terms.back().factor);
    }
    return sum;
  }

  /// The number of positions of a train from `from` to `to`.
  [[nodiscard]] static int places_of(const toml_value& t, const rational& from, const rational& by) {
    constexpr int most = 10'000;
    const rational way = decimal_of(t["to"].real(any_real)) - from;
    if (way < 0)
      t["to"].refuse(fmt::format("a number of at least {}, where the train begins", rounded(from)));
    const rational steps = way / by;
    if (steps >= most)
      t["by"].refuse(fmt::format("{}, which makes more than {} places", t["by"].found(), most),
                     fmt::format("at most {} places of a train", most));
    return static_cast<int>(rounded(rational(numerator(steps) / denominator(steps)))) + 1;
  }

  /// Adds the force factor * w at the exact place `at`, unless it is beyond the beam.
  void put_axle(const rational& at, double w, double factor, load& l) const {
    const line<rational>& points = nodes_.axes()[0].points();
    if (at < points.at(0) || at > points.at(points.size() - 1)) return;
    line_place x(rounded(at));
    if (const std::optional<int> node = nodes_.axes()[0].find(at, x.x)) {
      l.points.push_back({*node, 0, w, factor});
      return;
    }
    rational rest = at - decimal_of(x.x);
    while (rounded(rest) != 0.0) {  // ends, because every number takes digits of a decimal away
      x.more.push_back(rounded(rest));
      rest -= decimal_of(x.more.back());
    }
    l.placed.push_back({load_kind::point, x, x, {w}, {}, factor});
  }

  const node_reader& nodes_;
  const std::vector<load>& cases_;
  std::set<std::string> names_;  // names of combinations and trains
  std::map<std::string, const char*> kinds_;
};

/// Refuses [[step]] beside [[combination]] or [[train]], and [[case]] without [[combination]] and [[train]].
void refuse_mixed(const toml_value& top) {
  constexpr const char* allowed =
      "[[step]]s, each of which continues the step before, or [[combination]]s and [[train]]s of [[case]]s, "
      "which start from the unloaded structure";
  for (const char* key : {"combination", "train"})
    if (top.has(key)) return top.refuse_beside({"step"}, key, allowed);
  if (top.has("case"))
    top["case"].refuse("cases, but neither a [[combination]] nor a [[train]]",
                       "at least one of them, such as [[combination]] with terms = { NAME = 1.0 }; a load "
                       "that acts alone is a [[step]]");
}

}  // namespace

std::vector<load> read_steps(const toml_value& top, const node_reader& nodes, const named_files& files,
                             problem& p) {
  refuse_mixed(top);
  if (!top.has("combination") && !top.has("train")) return read_loads(top["step"].tables(), nodes, files, p);
  const std::vector<toml_value> cases = top["case"].optional_tables();
  std::set<std::string> names;
  for (const toml_value& t : cases) (void)unique_name(t, names);
  p.cases = read_loads(cases, nodes, files, p);
  combination_reader reader(top, nodes, p.cases);
  for (const toml_value& t : top["combination"].optional_tables()) reader.read_combination(t);
  for (const toml_value& t : top["train"].optional_tables()) reader.read_train(t);
  return std::move(reader.steps);
}

}  // namespace contct
