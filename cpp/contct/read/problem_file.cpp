#include "contct/read/problem_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "contct/kernel/call.hpp"
#include "contct/read/node_reader.hpp"
#include "contct/read/tables.hpp"
#include "contct/structure/line.hpp"
#include "contct/structure/placed_loads.hpp"

namespace contct {
namespace {

/// The keys that apply to all pairs of a table.
struct facing {
  int surface;
  std::optional<bool> closed;  ///< from `state`; empty: in contact if the face is 0
};

/// Reads surface and state of pairs or of a bed. `default_surface` is 0 if the file must name the surface.
facing read_facing(const toml_value& t, int default_surface) {
  facing f{default_surface, std::nullopt};
  if (default_surface == 0 || t.has("surface"))
    f.surface = t["surface"].choice({"below", "above"}) == 0 ? face_below : face_above;
  if (t.has("state")) f.closed = t["state"].choice({"separated", "contact"}) == 1;
  return f;
}

/// Reads one file into one problem, table by table.
class problem_reader {
 public:
  /// `numbers`: numbers_in of the document.
  problem_reader(const toml::table& document, std::string_view file, reach allowed,
                 std::vector<written_number>& numbers)
      : files_(file, allowed), top_(document, file, &numbers) {}

  problem read() {
    top_.allow_only({"title", "project", "author", "revision", "units", "beam", "plate", "matrix", "calculix",
                     "hinge", "support", "contact", "bed", "step", "case", "combination", "train", "watch"});
    for (const auto& [key, text] : {std::pair("title", &problem::title),
                                    {"project", &problem::project},
                                    {"author", &problem::author},
                                    {"revision", &problem::revision}})
      if (top_.has(key)) problem_.*text = top_[key].text();
    if (top_.has("units")) read_units(top_["units"].table());
    problem_.geometry = read_model(top_, files_, problem_.warnings);
    nodes_.emplace(problem_.geometry);
    if (nodes_->on_matrix() && top_.has("bed"))
      top_["bed"].refuse("a bed with a matrix",
                         "a [[contact]] at each dof, because a matrix has no lengths or areas");
    for (const toml_value& t : top_["hinge"].optional_tables()) read_hinge(t);
    for (const toml_value& t : top_["support"].optional_tables()) read_support(t);
    for (const support& held : problem_.supports)
      if (held.fixed) fixed_.insert({held.node, held.dof});
    for (const toml_value& t : top_["contact"].optional_tables()) read_contact(t);
    if (auto* a = std::get_if<assembled>(&problem_.geometry.kind)) store_matrix(top_, problem_.pairs, *a);
    for (const toml_value& t : top_["bed"].optional_tables()) read_bed(t);
    problem_.steps = read_steps(top_, *nodes_, files_, problem_);
    for (const toml_value& t : top_["watch"].optional_tables()) read_watch(t);
    problem_.files = files_.all();
    return std::move(problem_);
  }

 private:
  [[nodiscard]] bool fixed_in_w(int node) const { return fixed_.contains({node, 0}); }

  void read_units(const toml_value& t) {
    t.allow_only({"length", "force"});
    problem_.units = {t["length"].text(), t["force"].text()};
    for (const auto& [key, text] :
         {std::pair("length", problem_.units.length), {"force", problem_.units.force}})
      if (text.find_first_not_of(blanks) == std::string::npos) t[key].refuse("the name of a unit");
  }

  /// Reads a hinge. Refuses a hinge at an end of the beam: no moment acts there unless a support holds theta.
  void read_hinge(const toml_value& t) {
    beam* const b = std::get_if<beam>(&problem_.geometry.kind);
    if (b == nullptr) t.refuse("a hinge without a beam", "a [[hinge]] of a [beam]");
    t.allow_only(nodes_->keys_with({"stiffness"}));
    const double stiffness =
        t.has("stiffness") ? t["stiffness"].real({0.0, true, "a finite number, at least 0"}) : 0.0;
    for (const int node : nodes_->read(t)) {
      if (node == 0 || node + 1 == b->nodes())
        t.refuse(fmt::format("a hinge at node {}, where the beam ends", node + 1),
                 "a node between the ends; an end carries no moment unless a [[support]] holds its theta");
      if (b->has_hinge(node))
        t.refuse(fmt::format("a second hinge at node {}", node + 1), "one hinge at each node");
      const auto at = std::ranges::lower_bound(b->hinges, node);
      b->hinge_stiffness.insert(b->hinge_stiffness.begin() + (at - b->hinges.begin()), stiffness);
      b->hinges.insert(at, node);
    }
  }

  /// Reads the key "name" of a table with `count` places: one name for all, or one for each. Refuses a name
  /// that another place or table of the same kind has. [count]; empty texts if the table has no name.
  [[nodiscard]] static std::vector<std::string> read_names(const toml_value& t, std::size_t count,
                                                           const std::vector<std::string>& others) {
    if (!t.has("name")) return std::vector<std::string>(count);
    const std::string allowed = fmt::format("text, or a list of {}", counted(count, "text"));
    std::vector<std::string> names;
    const auto given = t["name"].each(allowed);
    for (const toml_value& one : given) {
      names.push_back(one.text(allowed));
      if (names.back().find_first_not_of(blanks) == std::string::npos) one.refuse(allowed);
      if (std::ranges::count(names, names.back()) > 1 || std::ranges::count(others, names.back()) > 0)
        one.refuse(fmt::format("{} again", one.found()), "a name that no other has");
    }
    if (!t["name"].is_array()) names.resize(count, names.front());
    if (names.size() != count) t["name"].refuse(allowed);
    return names;
  }

  void read_support(const toml_value& t) {
    const std::size_t first = problem_.supports.size();
    read_dofs_of_support(t);
    // Each dof, fixed or on a spring, is one after the other at every place.
    const std::size_t places = nodes_->read(t).size();
    const std::vector<std::string> names = read_names(t, places, problem_.names.supports);
    for (std::size_t i = first; i < problem_.supports.size(); ++i)
      problem_.names.supports.push_back(names[(i - first) % places]);
  }

  void read_dofs_of_support(const toml_value& t) {
    t.allow_only(nodes_->keys_with({"name", "fix", "spring"}));
    const bool fixed = t.has("fix");
    const bool sprung = t.has("spring");
    if (nodes_->on_matrix()) {
      if (fixed == sprung) t.refuse(fixed ? "both fix and spring" : "neither fix nor spring", "one of them");
      if (fixed && t["fix"].required("true").value_exact<bool>() != true) t["fix"].refuse("true");
      const double spring = fixed ? 0.0 : t["spring"].real(positive_real);
      for (const int dof : nodes_->read(t)) problem_.supports.push_back({dof, 0, fixed, spring});
      return;
    }
    const std::vector<named_place> at = nodes_->places(t, false);
    if (!fixed && !sprung) t.refuse("neither fix nor spring", "at least one of them");
    if (fixed)
      for (const int dof : read_fix(t))
        for (const named_place& place : at) {
          nodes_->refuse_hinge(t["fix"], *place.node, dof);
          problem_.supports.push_back({*place.node, dof, true});
        }
    if (!sprung) return;
    const toml_value springs = t["spring"].table();
    springs.allow_only(nodes_->dof_names());
    nodes_->read_values(springs, "an empty table", positive_real, at,
                        [this](const toml_value&, const named_place& place, int dof, double stiffness) {
                          problem_.supports.push_back({*place.node, dof, false, stiffness});
                        });
  }

  [[nodiscard]] std::vector<int> read_fix(const toml_value& t) const {
    const auto& names = nodes_->dof_names();
    const std::string allowed =
        fmt::format(R"(one of "{0}", or an array of "{0}", each at most once)", fmt::join(names, "\", \""));
    std::vector<int> fixed;
    for (const toml_value& entry : t["fix"].each(allowed)) {
      const auto name = std::ranges::find(names, entry.text(allowed));
      const auto dof = static_cast<int>(name - names.begin());
      if (name == names.end() || std::ranges::count(fixed, dof) != 0) entry.refuse(allowed);
      fixed.push_back(dof);
    }
    return fixed;
  }

  /// Makes a pair of the table `t` at `node` with face `face`, face number `i` (from 0) of the table. Refuses
  /// a face inside the structure, and the state "contact" at a face other than 0.
  [[nodiscard]] contact_pair pair_at(const toml_value& t, const facing& f, int node, double face,
                                     std::size_t i) const {
    const std::string found = fmt::format("{:g} at {}", face, place_words(problem_.geometry, node));
    if (f.surface * face < 0) {
      const auto faces = t["face"].each("");
      faces[std::min(i, faces.size() - 1)].refuse(
          found + ": the face is inside the undeformed structure",
          fmt::format("at {} 0 for a face {}; to push the structure, write face = 0 and move in a [[step]]",
                      f.surface < 0 ? "most" : "least", f.surface < 0 ? "below" : "above"));
    }
    if (f.closed == true && face != 0)
      t["state"].refuse(fmt::format("\"contact\" with face {}", found),
                        "\"contact\" only if face = 0: the undeformed structure touches no other face");
    return {node, f.surface, face, 0.0, f.closed.value_or(face == 0)};
  }

  /// The dof that carries the face of each pair of a table [pairs]; -1 if the face is fixed.
  [[nodiscard]] std::vector<int> read_others(const toml_value& t, const std::vector<int>& at) const {
    std::vector<int> none(at.size(), -1);
    if (!t.has("other")) return none;
    const toml_value other = t["other"];
    if (!nodes_->on_matrix())
      other.refuse(R"(the key "other" with a beam or a plate)",
                   R"(the key "face"; for a gap between two structures, one [matrix] of both)");
    std::vector<int> others = nodes_->labelled(other, at.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      if (others[i] == at[i])
        other.refuse(place_words(problem_.geometry, at[i]) + ", which is also the pair's dof", "another dof");
      for (const int dof : {at[i], others[i]})
        if (fixed_in_w(dof))
          other.refuse(
              place_words(problem_.geometry, dof) + ", which a support fixes, in a pair of two dofs",
              "dofs that no support fixes; for contact with a fixed dof, omit the key other, and if that dof "
              "settles, use the key move in [[step]]");
    }
    return others;
  }

  void read_contact(const toml_value& t) {
    std::vector<std::string_view> keys = {"name", "surface", "face", "stiffness", "state"};
    if (nodes_->on_matrix() || t.has("other")) keys.emplace_back("other");
    t.allow_only(nodes_->keys_with(keys));
    const std::vector<int> at = nodes_->read(t);
    const std::vector<int> others = read_others(t, at);
    std::ranges::move(read_names(t, at.size(), problem_.names.pairs),
                      std::back_inserter(problem_.names.pairs));
    const facing common = read_facing(t, 0);
    const toml_value face = t["face"];
    const toml_value stiffness = t["stiffness"];
    const std::vector<double> faces = face.reals_for(any_real, at.size(), "pair");
    const std::vector<double> springs = stiffness.reals_for(positive_real, at.size(), "pair");
    for (std::size_t i = 0; i < at.size(); ++i) {
      contact_pair& pair = problem_.pairs.emplace_back(pair_at(t, common, at[i], faces[i], i));
      pair.other = others[i];
      pair.stiffness = springs[i];
      problem_.keys.push_back({face.name_of(i), stiffness.name_of(i)});
      if (fixed_in_w(at[i]))
        problem_.warnings.push_back(fmt::format(
            "{}: {} is fixed{}; the pair cannot change the deflections, and the support carries its force, "
            "but the 1989 rule may change its status",
            t.where(), place_words(problem_.geometry, at[i]), nodes_->on_matrix() ? "" : " in w"));
    }
  }

  /// Reads the faces of a bed: one for all nodes `at`, or one for each node, including nodes that are fixed
  /// in w. If the face is a polynomial, also writes its coefficients.
  [[nodiscard]] std::vector<double> read_faces(const toml_value& t, const std::vector<int>& at,
                                               std::vector<double>& coefficients) const {
    const toml_value face = t["face"];
    if (!face.is_table()) return face.reals_for(any_real, at.size(), "node of the bed, fixed or not");
    face.allow_only({"polynomial"});
    coefficients = read_polynomial(face, problem_.geometry,
                                   "numbers for face; a polynomial is allowed only along a beam");
    std::vector<double> values = values_at<double>(std::get<beam>(problem_.geometry.kind), coefficients, at);
    if (!std::ranges::all_of(values, [](double c) { return std::isfinite(c); }))
      face["polynomial"].refuse("coefficients of a polynomial that is finite at every node");
    return values;
  }

  /// Reads the parts of a bed with from, to or pieces of modulus; none if the bed is given by nodes.
  [[nodiscard]] std::vector<bed_part> read_parts(const toml_value& t) const {
    const bool in_pieces = nodes_->on(beams) && has_pieces(t, "modulus");
    if (!in_pieces && !t.has("from") && !t.has("to")) return {};
    if (nodes_->named_in(t))
      t.refuse("from, to or pieces of modulus beside the nodes of the bed", "either nodes, or from and to");
    if (t["face"].is_array()) t["face"].refuse("one number, or a polynomial; a list belongs to nodes");
    auto [from, to] = nodes_->read_area(t);
    if (!in_pieces) return {{from, to, t["modulus"].real(positive_real)}};
    const coordinate_row& x = nodes_->axes().front();
    const auto reaches = [&x](const line_place& a, const line_place& b) {
      return x.points().place(a) >= x.points().place(b);
    };
    std::vector<bed_part> parts;
    for (const toml_value& piece : t["modulus"].tables()) {
      piece.allow_only({"to", "value"});
      const line_place end = x.place_of(piece["to"]);
      if (reaches(from[0], end))
        piece["to"].refuse(fmt::format("more than {}, where this piece begins", from[0].x));
      parts.push_back({from, {end, 0.0}, piece["value"].real(positive_real)});
      from[0] = end;
    }
    if (!reaches(from[0], to[0]) || !reaches(to[0], from[0]))
      t["modulus"].refuse(fmt::format("pieces that end at {}", from[0].x),
                          fmt::format("a last piece to {}, where the bed ends", to[0].x));
    return parts;
  }

  /// Adds a pair at every node of a bed that can deflect.
  void read_bed(const toml_value& t) {
    t.allow_only(nodes_->keys_with({"name", "from", "to", "modulus", "surface", "face", "state"}));
    problem_.names.beds.push_back(read_names(t, 1, problem_.names.beds).front());
    const facing common = read_facing(t, face_below);
    bed made{0.0, {}, problem_.pairs.size(), {}, common.closed, {}, read_parts(t)};
    const bed_springs springs = springs_of(problem_.geometry, made.parts);
    std::vector<int> at(nodes(problem_.geometry));
    std::iota(at.begin(), at.end(), 0);
    if (nodes_->named_in(t)) at = nodes_->read(t);
    if (made.parts.empty()) {
      made.modulus = t["modulus"].real(positive_real);
      made.nodes = at;
      std::ranges::sort(made.nodes);
    } else {
      made.modulus = std::ranges::max(made.parts, {}, &bed_part::modulus).modulus;
      std::erase_if(at, [&springs](int node) { return springs.share[node] == 0; });
    }
    const std::vector<double> faces = read_faces(t, at, made.face);
    if (shares_.empty()) shares_ = tributary_shares(problem_.geometry);
    if (exact_shares_.empty()) exact_shares_ = exact_shares(problem_.geometry);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const int node = at[i];
      const bool is_held = fixed_in_w(node);
      if (is_held && common.surface * faces[i] < 0) {
        problem_.warnings.push_back(
            fmt::format("{}: {} is fixed, and its face is inside the structure; the face is not used",
                        t.where(), place_words(problem_.geometry, node)));
        continue;
      }
      contact_pair p =
          is_held ? contact_pair{node, common.surface, faces[i], 0.0} : pair_at(t, common, node, faces[i], i);
      p.stiffness = made.parts.empty() ? made.modulus * shares_[node] : rounded(springs.stiffness[node]);
      if (!std::isnormal(p.stiffness))
        t.refuse(fmt::format("a stiffness of {:g} at node {}", p.stiffness, node + 1),
                 "modulus times tributary length, or area, within the range of double precision");
      (is_held ? made.held : problem_.pairs).push_back(p);
      (is_held ? made.held_share : made.share)
          .push_back(made.parts.empty() ? exact_shares_[node] : rounded(springs.share[node]));
    }
    if (made.share.empty()) t.refuse("only nodes that are fixed in w", "at least one node that can deflect");
    if (const auto* b = std::get_if<beam>(&problem_.geometry.kind)) warn_of_ends(t, *b, made);
    problem_.beds.push_back(std::move(made));
  }

  /// Reads a part to watch: a range of places, or names of supports, pairs and beds.
  void read_watch(const toml_value& t) {
    t.allow_only({"name", "from", "to", "names"});
    watched_part w;
    for (const watched_part& other : problem_.watches) w.names.push_back(other.name);
    (void)t["name"].required("the name of this part");
    w.name = read_names(t, 1, w.names).front();
    w.names.clear();
    const bool in_range = t.has("from") || t.has("to");
    if (in_range == t.has("names"))
      t.refuse(in_range ? "both a range and names" : "neither a range nor names", "from and to, or names");
    if (in_range && nodes_->on_matrix())
      t.refuse("a range of a matrix", "names, because a matrix has no places");
    if (in_range) {
      const auto [from, to] = nodes_->read_area(t);
      w.from = {from[0].x, from[1].x};
      w.to = {to[0].x, to[1].x};
      const auto* const on = std::get_if<plate>(&problem_.geometry.kind);
      const auto has_line = [&w](const std::vector<double>& lines, std::size_t axis) {
        return std::ranges::any_of(lines, [&](double x) { return w.from[axis] <= x && x <= w.to[axis]; });
      };
      if (on != nullptr && !(has_line(on->x, 0) && has_line(on->y, 1)))
        t["from"].refuse("a rectangle without a node",
                         "a rectangle with a node: extremes of plates are at nodes");
    }
    for (const toml_value& one :
         in_range ? std::vector<toml_value>() : t["names"].each("text, or a list of texts"))
      w.names.push_back(read_named(one));
    problem_.watches.push_back(std::move(w));
  }

  /// Reads the name of a support, pair or bed.
  [[nodiscard]] std::string read_named(const toml_value& one) const {
    std::vector<std::string> known;
    for (const auto* list : {&problem_.names.supports, &problem_.names.pairs, &problem_.names.beds})
      for (const std::string& name : *list)
        if (!name.empty() && std::ranges::count(known, name) == 0) known.push_back(name);
    std::string name = one.text("text, the name of a support, pair or bed");
    if (std::ranges::count(known, name) == 0)
      one.refuse(in_quotes(name) + did_you_mean(name, known),
                 known.empty() ? "names that supports, pairs or beds have by the key name"
                               : "one of " + joined(known, ", "));
    return name;
  }

  /// Warns if a bed by nodes ends inside the beam, half an element beyond its last node, or meets another one
  /// at a node, whose half elements then belong to both.
  void warn_of_ends(const toml_value& t, const beam& b, const bed& made) {
    const auto in = [](const bed& of, int node) { return std::ranges::binary_search(of.nodes, node); };
    for (const int node : made.nodes)
      for (const int next : {node - 1, node + 1}) {
        if (next < 0 || next >= b.nodes() || in(made, next)) continue;
        problem_.warnings.push_back(fmt::format(
            "{}: the bed acts to x = {:.6g}, half an element beyond node {}; from and to end it at a place",
            t.where(), b.x[node] + (b.x[next] - b.x[node]) / 2, node + 1));
        const auto meets = [&](const bed& other) {
          const bool is_beside = in(other, next) && in(other, node);
          return is_beside &&
                 problem_.pairs[other.first_pair].surface == problem_.pairs[made.first_pair].surface;
        };
        if (std::ranges::any_of(problem_.beds, meets))
          problem_.warnings.back() +=
              fmt::format("; the half elements at node {} belong to another bed too", node + 1);
        return;
      }
  }

  named_files files_;
  toml_value top_;
  problem problem_;
  std::optional<node_reader> nodes_;     // set once the structure is known
  std::set<std::pair<int, int>> fixed_;  // nodes and dofs
  std::vector<double> shares_;           // [nodes] tributary lengths or areas; empty until a bed needs them
  std::vector<double> exact_shares_;     // likewise
};

}  // namespace

problem parse_problem(std::string_view text, std::string_view file, reach allowed) {
  const toml::table document = parse_toml(text, file);
  std::vector<written_number> numbers = numbers_in(document, text);
  problem p = problem_reader(document, file, allowed, numbers).read();
  std::ranges::move(rounding_warnings(numbers, file), std::back_inserter(p.warnings));
  return p;
}

problem read_problem(const std::string& path, reach allowed) {
  const std::string file = path == "-" ? "standard input" : path;
  return parse_problem(read_input(path), file, allowed);
}

}  // namespace contct
