#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "contct/read/matrix_files.hpp"
#include "contct/read/tables.hpp"
#include "contct/structure/statics.hpp"
#include "contct/text/strings.hpp"

namespace contct {

void refuse_endless_sums(const toml_value& t, const model& m, const load& l) {
  std::vector<double> sums = nodal_loads(m, l).force;  // in doubles, as the path adds loads up
  const resultant r = resultant_of(m, l);
  sums.push_back(r.force);
  sums.insert(sums.end(), r.moments.begin(), r.moments.end());
  for (const prescribed_displacement& g : l.settlements)
    sums.push_back(product_of<double>(g.value, g.factor));
  if (!std::ranges::all_of(sums, [](double x) { return std::isfinite(x); }))
    t.refuse("loads whose sum or moment is not finite", "loads within the range of double precision");
}

namespace {

/// Reads the load of a [[step]] or [[case]].
class step_reader {
 public:
  step_reader(const node_reader& nodes, const named_files& files, problem& p)
      : nodes_(nodes), files_(files), warnings_(p.warnings) {
    for (const contact_pair& c : p.pairs) {
      paired_.insert(c.node);
      others_.insert(c.other);
    }
    for (const bed& b : p.beds)
      for (const contact_pair& c : b.held) paired_.insert(c.node);
    for (const support& s : p.supports) (s.fixed ? fixed_ : sprung_).insert({s.node, s.dof});
  }

  [[nodiscard]] load read(const toml_value& t) const {
    constexpr load_key rows[] = {{"load", matrices, &step_reader::read_vector},
                                 {"uniform", beams | plates, &step_reader::read_uniform},
                                 {"point", all_structures, &step_reader::read_points},
                                 {"moment", plates, &step_reader::read_moments},
                                 {"curvature", beams, &step_reader::read_curvatures},
                                 {"settlement", all_structures, &step_reader::read_settlements},
                                 {"move", all_structures, &step_reader::read_moves},
                                 {"self_weight", beams | plates, &step_reader::read_self_weight}};
    refuse_curvature(t);
    std::vector<std::string_view> keys = {"name"};
    for (const load_key& k : rows)
      if (nodes_.on(k.structures)) keys.push_back(k.name);
    t.allow_only(keys);
    if (std::none_of(keys.begin() + 1, keys.end(), [&t](std::string_view name) { return t.has(name); }))
      t.refuse("a step without a load, settlement or move",
               fmt::format("at least one of {} and move; {} removes all load",
                           fmt::join(keys.begin() + 1, std::ranges::find(keys, "move"), ", "),
                           nodes_.on_matrix() ? "a load of 0 at any dof" : "uniform = 0"));
    load l;
    if (t.has("name")) l.name = t["name"].text();
    for (const load_key& k : rows)
      if (t.has(k.name)) (this->*k.read)(t[k.name], l);
    refuse_endless_sums(t, nodes_.structure(), l);
    return l;
  }

 private:
  /// A key of a [[step]] or [[case]]: the structures that have it, and the function that reads its value.
  struct load_key {
    std::string_view name;
    unsigned structures;
    void (step_reader::*read)(const toml_value& value, load& l) const;
  };

  /// Refuses a curvature if the structure is not a beam, and names a substitute.
  void refuse_curvature(const toml_value& t) const {
    if (!t.has("curvature") || nodes_.on(beams)) return;
    t["curvature"].refuse(
        nodes_.on_matrix() ? "curvature with a matrix" : "curvature with a plate",
        nodes_.on_matrix()
            ? "curvature along a beam; with a matrix, the loads at dofs that replace the curvature"
            : "curvature along a beam; for a uniform curvature c of a plate, apply D (1 + nu) c, a moment "
              "per length, to its free edges, as point loads wx and wy");
  }

  void read_vector(const toml_value& named, load& l) const {
    const std::string path = files_.path_of(named);
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

  void read_uniform(const toml_value& uniform, load& l) const {
    if (uniform.required("").is_number()) {
      l.distributed.push_back({{uniform.real(any_real)}, {}});
      return;
    }
    if (!uniform.is_array()) uniform.refuse("a number, or an array of tables");
    // Loads on the same elements are added up, because each load takes a pass over its elements, and a file
    // may have thousands of loads on "all".
    std::map<std::vector<int>, std::size_t> place;
    const auto all = static_cast<std::size_t>(elements(nodes_.structure()));
    for (const toml_value& t : uniform.tables()) {
      t.allow_only({"value", "polynomial", "elements", "from", "to"});
      const bool is_placed = t.has("from") || t.has("to");
      if (is_placed) t.refuse_beside({"elements"}, "from or to", "either elements, or from and to");
      std::vector<double> intensity = read_intensity(t);
      if (is_placed) {
        l.placed.push_back(read_part(t, load_kind::force, std::move(intensity)));
        continue;
      }
      std::vector<int> on;  // empty means all elements
      if (t.has("elements")) on = t["elements"].numbers(static_cast<int>(all));
      if (on.size() == all) on.clear();
      const auto [at, is_new] = place.try_emplace(on, l.distributed.size());
      if (is_new)
        l.distributed.push_back({intensity, std::move(on)});
      else
        add_polynomial(l.distributed[at->second].polynomial, intensity, 1.0);
      l.distributed[at->second].parts.push_back({std::move(intensity)});
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
    if (const plate* const p = std::get_if<plate>(&nodes_.structure().kind)) {
      if (p->weight == 0.0)
        t.refuse("a plate without weight", "self_weight with E, thickness and weight in [plate]");
      return add(p->weight, p->thickness, {});
    }
    const std::vector<beam_section>& all = std::get<beam>(nodes_.structure().kind).sections;
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

  [[nodiscard]] std::vector<double> read_intensity(const toml_value& t) const {
    if (t.has("value") == t.has("polynomial"))
      t.refuse("both or neither of value and polynomial", "one of them");
    if (t.has("value")) return {t["value"].real(any_real)};
    return read_polynomial(t, nodes_.structure(), "value; a polynomial is allowed only for a beam's load");
  }

  [[nodiscard]] placed_load read_part(const toml_value& t, load_kind kind,
                                      std::vector<double> intensity) const {
    const auto [from, to] = nodes_.read_area(t);
    return {kind, from[0], to[0], std::move(intensity), {from[1], to[1]}};
  }

  void read_curvatures(const toml_value& all, load& l) const {
    for (const toml_value& t : all.tables()) {
      t.allow_only({"value", "from", "to"});
      l.placed.push_back(read_part(t, load_kind::curvature, {t["value"].real(any_real)}));
    }
  }

  /// Reads the moments over areas of a plate.
  void read_moments(const toml_value& all, load& l) const {
    for (const toml_value& t : all.tables()) {
      t.allow_only({"wx", "wy", "from", "to"});
      if (!t.has("wx") && !t.has("wy")) t.refuse("a moment without wx or wy", "at least one of them");
      const auto total = [&t](const char* slope) { return t.has(slope) ? t[slope].real(any_real) : 0.0; };
      l.placed.push_back(read_part(t, load_kind::moment, {total("wx"), total("wy")}));
    }
  }

  /// Reads the tables `all` of places and dofs.
  void read_values(const toml_value& all, std::string_view what, bool between_nodes,
                   const node_reader::taker& take) const {
    const auto& names = nodes_.dof_names();
    const std::string found = fmt::format("{} without {}", what, fmt::join(names, " or "));
    for (const toml_value& t : all.tables()) {
      t.allow_only(nodes_.keys_with(names));
      nodes_.read_values(t, found, any_real, nodes_.places(t, between_nodes), take);
    }
  }

  void read_points(const toml_value& all, load& l) const {
    read_values(
        all, "a point load", true, [&l](const toml_value&, const named_place& at, int dof, double value) {
          if (at.node)
            l.points.push_back({*at.node, dof, value});
          else
            l.placed.push_back({dof == 0 ? load_kind::point : load_kind::moment, at.x, at.x, {value}});
        });
  }

  /// Refuses a settlement of a dof that no support fixes, even if a support holds the dof by a spring.
  void refuse_unfixed(const toml_value& named, int node, int dof) const {
    if (fixed_.contains({node, dof})) return;
    const bool sprung = sprung_.contains({node, dof});
    const std::string what = nodes_.on_matrix() ? "which" : fmt::format("whose {}", nodes_.dof_names()[dof]);
    named.refuse(
        fmt::format("a settlement of {}, {} {}, so that its displacement is a result",
                    place_words(nodes_.structure(), node), what, sprung ? "has a spring" : "is free"),
        fmt::format("a dof that a [[support]] fixes{}",
                    paired_.contains(node) && dof == 0
                        ? "; to move the face of a pair, use move, written like settlement"
                    : sprung ? "; if the base of a spring k moves by d, apply the load k d"
                             : ""));
  }

  void read_settlements(const toml_value& all, load& l) const {
    std::set<std::pair<int, int>> moved;
    read_values(all, "a settlement", false,
                [&](const toml_value& named, const named_place& at, int dof, double value) {
                  refuse_unfixed(named, *at.node, dof);
                  if (!moved.insert({*at.node, dof}).second)
                    named.refuse(place_words(nodes_.structure(), *at.node) + ", a second time in this step",
                                 "each dof once: the value is the whole displacement");
                  l.settlements.push_back({*at.node, dof, value});
                });
  }

  /// Reads the moves of faces. A face moves in the direction of the deflection, on which pairs act.
  void read_moves(const toml_value& all, load& l) const {
    const std::string_view name = nodes_.dof_names().front();
    std::set<int> moved;
    for (const toml_value& m : all.tables()) {
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
  std::set<std::pair<int, int>> fixed_, sprung_;  // nodes and dofs that supports fix, or hold by springs
  std::set<int> paired_;                          // nodes with pairs
  std::set<int> others_;                          // nodes that carry the face of a pair; and -1
};

}  // namespace

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
  std::vector<load> all;
  all.reserve(tables.size());
  for (const toml_value& t : tables) all.push_back(reader.read(t));
  return all;
}

}  // namespace contct
