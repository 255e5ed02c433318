#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "contct/model/line.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/tables.hpp"

namespace contct {
namespace {

/// Reads the load of a [[step]] or [[case]].
class step_reader {
 public:
  step_reader(const node_reader& nodes, const named_files& files, problem& p)
      : nodes_(nodes), files_(files), warnings_(p.warnings), held_(dofs(p.geometry), hold::none) {
    for (const contact_pair& c : p.pairs) {
      paired_.insert(c.node);
      if (c.other >= 0) others_.insert(c.other);
    }
    for (const support& s : p.supports) {
      hold& here = held_[s.node * nodes_.dof_names().size() + s.dof];
      here = std::max(here, s.fixed ? hold::fixed : hold::spring);
    }
  }

  [[nodiscard]] load read(const toml_value& t) const {
    const bool on_matrix = nodes_.on_matrix();
    const char* const whole = on_matrix ? "load" : "uniform";  // key of a load on the whole structure
    refuse_curvature(t);
    std::vector<std::string_view> keys = {"name", whole, "point", "settlement", "move"};
    if (of_beam() != nullptr) keys.insert(keys.begin() + 3, "curvature");
    if (!on_matrix) keys.emplace_back("self_weight");
    t.allow_only(keys);
    if (std::all_of(keys.begin() + 1, keys.end(), [&t](std::string_view key) { return !t.has(key); }))
      t.refuse("a step without a load, settlement or move",
               fmt::format("at least one of {}, point{}, settlement and move; {} removes all load", whole,
                           of_beam() != nullptr ? ", curvature" : "",
                           on_matrix ? "a load of 0 at any dof" : "uniform = 0"));
    load l;
    if (t.has("name")) l.name = t["name"].text();
    if (t.has("load")) read_vector(t, l);
    if (t.has("uniform")) read_uniform(t, l);
    if (t.has("self_weight")) read_self_weight(t["self_weight"], l);
    for (const toml_value& p : t["point"].optional_tables()) {
      read_values(p, "a point load", true, [&l](const named_place& at, int dof, double value) {
        if (at.node)
          l.points.push_back({*at.node, dof, value});
        else
          l.placed.push_back({dof == 0 ? load_kind::point : load_kind::moment, at.x, at.x, {value}});
      });
    }
    for (const toml_value& c : t["curvature"].optional_tables()) l.placed.push_back(read_curvature(c));
    read_settlements(t, l);
    read_moves(t, l);
    refuse_endless_sums(t, nodes_.structure(), l);
    return l;
  }

 private:
  [[nodiscard]] const beam* of_beam() const { return std::get_if<beam>(&nodes_.structure().kind); }
  [[nodiscard]] const plate* of_plate() const { return std::get_if<plate>(&nodes_.structure().kind); }

  /// Refuses a curvature if the structure is not a beam, and names a substitute.
  void refuse_curvature(const toml_value& t) const {
    if (!t.has("curvature") || of_beam() != nullptr) return;
    t["curvature"].refuse(
        nodes_.on_matrix() ? "curvature with a matrix" : "curvature with a plate",
        nodes_.on_matrix()
            ? "curvature along a beam; with a matrix, the loads at dofs that replace the curvature"
            : "curvature along a beam; for a uniform curvature c of a plate, apply D (1 + nu) c, a moment "
              "per "
              "length, to its free edges, as point loads wx and wy");
  }

  enum class hold : char { none, spring, fixed };

  void read_vector(const toml_value& t, load& l) const {
    const std::string path = files_.path_of(t["load"]);
    std::vector<std::string> rounded;
    const std::vector<double> values =
        parse_vector(read_input(path, "Matrix Market file", largest_matrix_file), path,
                     nodes(nodes_.structure()), &rounded);
    for (std::size_t dof = 0; dof < values.size(); ++dof) {
      if (values[dof] != 0.0) l.points.push_back({static_cast<int>(dof), 0, values[dof]});
    }
    for (std::string& w : rounded)  // once, even if several steps name the same file
      if (std::ranges::find(warnings_, w) == warnings_.end()) warnings_.push_back(std::move(w));
  }

  void read_uniform(const toml_value& t, load& l) const {
    const toml_value uniform = t["uniform"];
    if (uniform.required("").is_number()) {
      l.distributed.push_back({{uniform.real(any_real)}, {}});
      return;
    }
    if (!uniform.is_array()) uniform.refuse("a number, or an array of tables");
    // Loads on the same elements are added up, because each load takes a pass over its elements, and a file
    // may have thousands of loads on "all".
    std::map<std::vector<int>, std::size_t> place;
    for (const toml_value& table : uniform.tables()) {
      table.allow_only({"value", "polynomial", "elements", "from", "to"});
      if (table.has("from") || table.has("to")) {
        l.placed.push_back(read_part(table));
        continue;
      }
      distributed_load part = read_distributed(table);
      const auto [at, is_new] = place.try_emplace(part.elements, l.distributed.size());
      if (is_new) {
        part.parts = {{part.polynomial}};
        l.distributed.push_back(std::move(part));
      } else {
        distributed_load& sum = l.distributed[at->second];
        add_polynomial(sum.polynomial, part.polynomial, 1.0);
        sum.parts.push_back({std::move(part.polynomial)});
      }
    }
  }

  /// Adds weight per volume times area or thickness: one load for each run of elements of equal weight.
  void read_self_weight(const toml_value& t, load& l) const {
    const std::optional<bool> acts = t.required("true or false").value_exact<bool>();
    if (!acts) t.refuse("true or false");
    if (!*acts) return;
    const auto add = [&l](double weight, double times, std::vector<int> elements) {
      l.distributed.push_back(
          {{product_of<double>(-weight, times)}, std::move(elements), {{{-weight}, 1.0, times}}, true});
    };
    if (const plate* const p = of_plate()) {
      if (p->weight == 0.0)
        t.refuse("a plate without weight", "self_weight with E, thickness and weight in [plate]");
      return add(p->weight, p->thickness, {});
    }
    const std::vector<beam_section>& all = of_beam()->sections;
    if (all.empty() || all[0].weight == 0.0 || all[0].A == 0.0)
      t.refuse("a beam without weight or area", "self_weight with A and weight in section of [beam]");
    for (std::size_t e = 0; e < all.size();) {
      std::vector<int> alike;
      const beam_section& s = all[e];
      for (; e < all.size() && all[e].weight == s.weight && all[e].A == s.A; ++e)
        alike.push_back(static_cast<int>(e));
      if (alike.size() == all.size()) alike.clear();
      add(s.weight, s.A, std::move(alike));
    }
  }

  [[nodiscard]] distributed_load read_distributed(const toml_value& t) const {
    distributed_load d;
    d.polynomial = read_intensity(t);
    const int all = elements(nodes_.structure());
    if (t.has("elements")) d.elements = t["elements"].numbers(all);
    if (static_cast<int>(d.elements.size()) == all) d.elements.clear();  // empty means all elements
    return d;
  }

  [[nodiscard]] std::vector<double> read_intensity(const toml_value& t) const {
    if (t.has("value") == t.has("polynomial"))
      t.refuse("both or neither of value and polynomial", "one of them");
    if (t.has("value")) return {t["value"].real(any_real)};
    return read_polynomial(t, nodes_.structure(), "value; a polynomial is allowed only for a beam's load");
  }

  /// Reads a distributed load on a part of a beam, or on a rectangle of a plate.
  [[nodiscard]] placed_load read_part(const toml_value& t) const {
    t.refuse_beside({"elements"}, "from or to", "either elements, or from and to");
    placed_load p{load_kind::force, 0.0, 0.0, read_intensity(t)};
    read_extent(t, p);
    return p;
  }

  [[nodiscard]] placed_load read_curvature(const toml_value& t) const {
    t.allow_only({"value", "from", "to"});
    placed_load p{load_kind::curvature, 0.0, 0.0, {t["value"].real(any_real)}};
    read_extent(t, p);
    return p;
  }

  /// Reads `from` and `to`: places along a beam, or two corners of a rectangle of a plate. A missing `from`
  /// is the start of the beam or the lower left corner of the plate, a missing `to` the opposite end or
  /// corner.
  void read_extent(const toml_value& t, placed_load& p) const {
    const std::vector<coordinate_row>& axes = nodes_.axes();
    const auto coordinates = [&](const char* key) {
      return axes.size() == 1 ? std::vector{t[key]}
                              : t[key].entries("a corner of the rectangle, [x, y]", 2, 2);
    };
    std::array<line_place, 2> from{};
    std::array<line_place, 2> to{};
    for (std::size_t i = 0; i < axes.size(); ++i)
      from[i] = t.has("from") ? axes[i].place_of(coordinates("from")[i]) : axes[i].place(0);
    for (std::size_t i = 0; i < axes.size(); ++i)
      to[i] =
          t.has("to") ? axes[i].place_of(coordinates("to")[i]) : axes[i].place(axes[i].points().size() - 1);
    for (std::size_t i = 0; i < axes.size(); ++i)
      if (axes[i].points().place(from[i]) >= axes[i].points().place(to[i]))
        coordinates(t.has("to") ? "to" : "from")[i].refuse(
            fmt::format("{}", to[i].x), fmt::format("more than {}, where this part begins", from[i].x));
    p.from = from[0];
    p.to = to[0];
    p.across = {from[1], to[1]};
  }

  /// A node, or a place between nodes of a beam.
  struct named_place {
    std::optional<int> node;
    double x = 0.0;
  };

  /// The places that a table names, each once; with `between_nodes`, also places between the nodes of a beam.
  [[nodiscard]] std::vector<named_place> read_places(const toml_value& t, bool between_nodes) const {
    std::vector<named_place> all;
    const beam* const b = between_nodes && t.has("x") ? of_beam() : nullptr;
    if (b == nullptr) {
      for (const int node : nodes_.read(t)) all.push_back({node});
      return all;
    }
    t.refuse_beside({"node", "nodes"}, "x", "either x, or node or nodes");
    std::set<line_place> seen;
    for (const toml_value& named : t["x"].each("a number, or a list of numbers")) {
      const double x = named.real(any_real);
      const std::optional<int> node = nodes_.axes()[0].find(named);
      if (!seen.insert(node ? nodes_.axes()[0].place(*node) : line_place(x)).second)
        named.refuse(node ? place_words(nodes_.structure(), *node) + ", a second time"
                          : fmt::format("{} a second time", x),
                     "each place once");
      all.push_back({node, x});
    }
    return all;
  }

  /// Calls take(place, dof, value) for every dof in the table and every place that the table names.
  template <class Take>
  void read_values(const toml_value& t, std::string_view what, bool between_nodes, const Take& take) const {
    const auto& names = nodes_.dof_names();
    t.allow_only(nodes_.keys_with(names));
    const std::vector<named_place> places = read_places(t, between_nodes);
    for (const int dof : nodes_.dofs_in(t, fmt::format("{} without {}", what, fmt::join(names, " or ")))) {
      const double value = t[names[dof]].real(any_real);
      for (const named_place& at : places) {
        if (at.node) nodes_.refuse_hinge(t[names[dof]], *at.node, dof);
        take(at, dof, value);
      }
    }
  }

  /// Refuses a settlement of a dof that no support fixes, even if a support holds the dof by a spring.
  void refuse_unfixed(const toml_value& t, int node, int dof) const {
    const std::string_view name = nodes_.dof_names()[dof];
    const hold here = held_[node * nodes_.dof_names().size() + dof];
    if (here == hold::fixed) return;
    const std::string what = nodes_.on_matrix() ? "which" : fmt::format("whose {}", name);
    t[name].refuse(
        fmt::format("a settlement of {}, {} {}", place_words(nodes_.structure(), node), what,
                    here == hold::spring ? "has a spring, so that its displacement is a result"
                                         : "is free, so that its displacement is a result"),
        paired_.contains(node) && dof == 0
            ? "a dof that a [[support]] fixes; to move the face of a pair, use "
              "move, written like settlement"
        : here == hold::spring
            ? "a dof that a [[support]] fixes; if the base of a spring k moves by d, apply the load k d"
            : "a dof that a [[support]] fixes");
  }

  void read_settlements(const toml_value& t, load& l) const {
    std::set<std::pair<int, int>> moved;
    for (const toml_value& s : t["settlement"].optional_tables()) {
      read_values(s, "a settlement", false, [&](const named_place& at, int dof, double value) {
        refuse_unfixed(s, *at.node, dof);
        if (!moved.insert({*at.node, dof}).second)
          s[nodes_.dof_names()[dof]].refuse(
              place_words(nodes_.structure(), *at.node) + ", a second time in this step",
              "each dof once: the value is the whole displacement");
        l.settlements.push_back({*at.node, dof, value});
      });
    }
  }

  /// Reads the moves of faces. A face moves in the direction of the deflection, on which pairs act.
  void read_moves(const toml_value& t, load& l) const {
    const std::string_view name = nodes_.dof_names().front();
    std::set<int> moved;
    for (const toml_value& m : t["move"].optional_tables()) {
      m.allow_only(nodes_.keys_with({name}));
      const std::vector<int> at = nodes_.read(m);
      const double value = m[name].real(any_real);
      for (const int node : at) {
        const std::string place = place_words(nodes_.structure(), node);
        if (others_.contains(node))
          m.refuse(place + R"(, which is "other" of a pair)",
                   R"("dof" of the pair; to move this side, exchange "dof" and "other" in the [[contact]])");
        if (!paired_.contains(node))
          m.refuse("no pair at " + place, "places at which a [[contact]] or a [[bed]] has a pair");
        if (!moved.insert(node).second)
          m[name].refuse(place + ", a second time in this step",
                         "each place once: the value is the whole distance");
        l.moves.push_back({node, 0, value});
      }
    }
  }

  const node_reader& nodes_;
  const named_files& files_;
  std::vector<std::string>& warnings_;
  std::vector<hold> held_;  // [dofs] how supports hold the dof
  std::set<int> paired_;    // nodes with pairs
  std::set<int> others_;    // nodes that carry the face of a pair
};

}  // namespace

void refuse_endless_sums(const toml_value& t, const model& m, const load& l) {
  std::vector<double> sums(dofs(m), 0.0);  // in doubles, as the path adds loads up
  add_consistent_loads(m, l, sums);
  const resultant r = resultant_of(m, l);
  sums.push_back(r.force);
  sums.insert(sums.end(), r.moments.begin(), r.moments.end());
  for (const prescribed_displacement& g : l.settlements)
    sums.push_back(product_of<double>(g.value, g.factor));
  if (!std::ranges::all_of(sums, [](double x) { return std::isfinite(x); }))
    t.refuse("loads whose sum or moment is not finite", "loads within the range of double precision");
}

std::vector<double> read_polynomial(const toml_value& t, const model& m, std::string_view elsewhere) {
  const toml_value polynomial = t["polynomial"];
  if (!std::holds_alternative<beam>(m.kind)) polynomial.refuse(elsewhere);
  constexpr std::size_t most_coefficients = 21;
  std::vector<double> coefficients = polynomial.reals(any_real, 1);
  if (coefficients.size() > most_coefficients)
    polynomial.refuse(fmt::format("at most {} coefficients", most_coefficients));
  return coefficients;
}

std::vector<load> read_loads(const std::vector<toml_value>& tables, const node_reader& nodes,
                             const named_files& files, problem& p) {
  const step_reader reader(nodes, files, p);
  std::vector<load> loads;
  loads.reserve(tables.size());
  for (const toml_value& t : tables) loads.push_back(reader.read(t));
  return loads;
}

}  // namespace contct
