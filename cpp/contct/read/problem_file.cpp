#include "contct/read/problem_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "contct/kernel/call.hpp"
#include "contct/read/matrix_files.hpp"
#include "contct/read/model_tables.hpp"

namespace contct::read {
namespace {

constexpr std::size_t highest_degree = 20;

/// surface, face and state of a pair or a bed. `default_surface` is 0 where the surface must be named.
contact_pair read_face(const table_reader& t, int default_surface) {
  contact_pair p{};
  p.surface = default_surface;
  if (default_surface == 0 || t.has("surface"))
    p.surface = t.choice("surface", {"below", "above"}) == 0 ? face_below : face_above;
  p.face = t.real("face", any_real);
  if (p.surface * p.face < 0)
    t.refuse_key("face", fmt::format("{:g}: the face stands inside the undeformed structure", p.face),
                 p.surface < 0 ? "at most 0 for a face below" : "at least 0 for a face above");
  p.closed = p.face == 0;
  if (t.has("state")) p.closed = t.choice("state", {"separated", "contact"}) == 1;
  if (p.closed && p.face != 0)
    t.refuse_key("state", fmt::format("\"contact\" at face {:g}", p.face),
                 "\"contact\" only where face = 0: nothing touches a face elsewhere before the structure "
                 "deflects");
  return p;
}

/// Reads one file into one problem, table by table.
class problem_reader {
 public:
  problem_reader(const toml::table& document, std::string_view file)
      : folder_(std::filesystem::path(file).parent_path().string()), top_(document, "", file) {}

  problem read() {
    top_.allow_only({"title", "beam", "plate", "matrix", "calculix", "support", "contact", "bed", "step"});
    if (top_.has("title")) problem_.title = top_.text("title");
    problem_.geometry = read_model(top_, folder_);
    for (const char* name : dof_names(problem_.geometry)) dof_names_.emplace_back(name);
    fixed_.assign(dofs(problem_.geometry), 0);
    if (const auto* a = std::get_if<assembled>(&problem_.geometry.kind)) index_.emplace(*a);
    if (index_ && top_.has("bed"))
      top_.refuse_key("bed", "this with a matrix",
                      "a [[contact]] at each dof: a matrix knows no lengths or areas");
    for (const table_reader& t : top_.optional_tables("support")) read_support(t);
    for (const table_reader& t : top_.optional_tables("contact")) read_contact(t);
    for (const table_reader& t : top_.optional_tables("bed")) read_bed(t);
    for (const table_reader& t : top_.tables("step")) problem_.steps.push_back(read_step(t));
    return std::move(problem_);
  }

 private:
  [[nodiscard]] int nodes() const { return contct::structure::nodes(problem_.geometry); }

  [[nodiscard]] std::size_t dof_of(int node, int dof) const { return node * dof_names_.size() + dof; }

  /// Does a support fix the node's deflection?
  [[nodiscard]] bool fixed_in_w(int node) const { return fixed_[dof_of(node, 0)] != 0; }

  void add_support(const support& s) {
    problem_.supports.push_back(s);
    if (s.fixed) fixed_[dof_of(s.node, s.dof)] = 1;
  }

  /// The dof of a matrix that a label names; `name` is its key, with an index if any.
  [[nodiscard]] int dof_at(const table_reader& t, const toml::node& node, const std::string& name) const {
    const std::optional<int> dof = index_->find(t.text_of(node, name, index_->allowed()));
    if (!dof) t.refuse(node, name, found_words(node), index_->allowed());
    return *dof;
  }

  /// The node that "node" names, or, where each dof of a matrix is a node of its own, "dof"; from 0.
  [[nodiscard]] int read_node(const table_reader& t) const {
    return index_ ? dof_at(t, t.required("dof", index_->allowed()), "dof")
                  : t.integer("node", 1, nodes()) - 1;
  }

  /// The dofs that stand as keys in a table, in their order; refuses a table with none.
  [[nodiscard]] std::vector<int> dofs_in(const table_reader& t, std::string_view found) const {
    std::vector<int> there;
    for (std::size_t dof = 0; dof < dof_names_.size(); ++dof)
      if (t.has(dof_names_[dof])) there.push_back(static_cast<int>(dof));
    if (there.empty()) t.refuse(found, fmt::format("at least one of {}", fmt::join(dof_names_, ", ")));
    return there;
  }

  /// The nodes that "node" or "nodes" names; from 0.
  [[nodiscard]] std::vector<int> read_nodes(const table_reader& t) const {
    if (!t.has("nodes")) return {read_node(t)};
    t.refuse_beside({"node"}, "nodes", "either node or nodes");
    return t.numbers("nodes", nodes());
  }

  /// The dofs of a matrix that "dof" or "dofs" names.
  [[nodiscard]] std::vector<int> read_dofs(const table_reader& t) const {
    if (!t.has("dofs")) return {read_node(t)};
    t.refuse_beside({"dof"}, "dofs", "either dof or dofs");
    std::vector<int> dofs;
    for (const toml::node& entry : t.array("dofs", "a list of labels", 1))
      dofs.push_back(dof_at(t, entry, indexed("dofs", dofs.size())));
    return dofs;
  }

  void read_support(const table_reader& t) {
    if (index_) return read_support_on_matrix(t);
    t.allow_only({"node", "nodes", "fix", "spring"});
    const std::vector<int> at = read_nodes(t);
    if (!t.has("fix") && !t.has("spring")) t.refuse("neither fix nor spring", "at least one of them");
    if (t.has("fix"))
      for (const int dof : read_fix(t))
        for (const int node : at) add_support({node, dof, true});
    if (t.has("spring")) read_springs(t.table("spring"), at);
  }

  void read_support_on_matrix(const table_reader& t) {
    t.allow_only({"dof", "dofs", "fix", "spring"});
    const bool fixed = t.has("fix");
    if (fixed == t.has("spring"))
      t.refuse(fixed ? "both fix and spring" : "neither fix nor spring", "one of them");
    if (fixed && t.required("fix", "true").value_exact<bool>() != true) t.refuse_key("fix", "true");
    const double spring = fixed ? 0.0 : t.real("spring", positive_real);
    for (const int dof : read_dofs(t)) add_support({dof, 0, fixed, spring});
  }

  [[nodiscard]] std::vector<int> read_fix(const table_reader& t) const {
    const std::string allowed =
        fmt::format("an array of \"{}\", each at most once", fmt::join(dof_names_, "\", \""));
    std::vector<int> fixed;
    for (const toml::node& entry : t.array("fix", allowed, 1)) {
      const std::string key = indexed("fix", fixed.size());
      const auto name = std::find(dof_names_.begin(), dof_names_.end(), t.text_of(entry, key, allowed));
      const auto dof = static_cast<int>(name - dof_names_.begin());
      if (name == dof_names_.end() || std::count(fixed.begin(), fixed.end(), dof) != 0)
        t.refuse(entry, key, found_words(entry), allowed);
      fixed.push_back(dof);
    }
    return fixed;
  }

  void read_springs(const table_reader& t, const std::vector<int>& at) {
    t.allow_only(dof_names_);
    for (const int dof : dofs_in(t, "an empty table")) {
      const double stiffness = t.real(dof_names_[dof], positive_real);
      for (const int node : at) add_support({node, dof, false, stiffness});
    }
  }

  void read_contact(const table_reader& t) {
    t.allow_only({index_ ? "dof" : "node", "surface", "face", "stiffness", "state"});
    const int node = read_node(t);
    contact_pair pair = read_face(t, 0);
    pair.node = node;
    pair.stiffness = t.real("stiffness", positive_real);
    problem_.pairs.push_back(pair);
    if (fixed_in_w(node))
      problem_.warnings.push_back(
          fmt::format("{}: {} is fixed{}; the pair cannot change the answer, but the listing may toggle it",
                      t.place(), place_words(problem_.geometry, node), index_ ? "" : " in w"));
  }

  /// A pair at every node that is free to deflect, each with its tributary length or area.
  void read_bed(const table_reader& t) {
    t.allow_only({"modulus", "surface", "face", "state", "nodes"});
    const double modulus = t.real("modulus", positive_real);
    contact_pair p = read_face(t, face_below);
    if (shares_.empty()) shares_ = tributary_shares(problem_.geometry);
    const std::size_t before = problem_.pairs.size();
    for (const int node : t.has("nodes") ? t.numbers("nodes", nodes()) : all_nodes()) {
      if (fixed_in_w(node)) continue;
      p.node = node;
      p.stiffness = modulus * shares_[node];
      if (!std::isnormal(p.stiffness))
        t.refuse(fmt::format("a stiffness of {:g} at node {}", p.stiffness, node + 1),
                 "modulus times tributary length, or area, within the range of double precision");
      problem_.pairs.push_back(p);
    }
    if (problem_.pairs.size() == before)
      t.refuse("only nodes that are fixed in w", "at least one node that can deflect");
  }

  [[nodiscard]] std::vector<int> all_nodes() const {
    std::vector<int> numbers(nodes());
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
  }

  [[nodiscard]] load read_step(const table_reader& t) const {
    if (index_) return read_step_on_matrix(t);
    t.allow_only({"uniform", "point"});
    load l;
    if (t.has("uniform")) read_uniform(t, l);
    if (t.has("point")) read_points(t, l);
    if (l.distributed.empty() && l.points.empty())
      t.refuse("a step without loads", "uniform, point or both; uniform = 0 takes all load off");
    const resultant r = resultant_of(problem_.geometry, l);
    if (!std::isfinite(r.force) ||
        !std::all_of(r.moments.begin(), r.moments.end(), [](double m) { return std::isfinite(m); })) {
      t.refuse("loads whose sum or moment is not finite", "loads within the range of double precision");
    }
    return l;
  }

  [[nodiscard]] load read_step_on_matrix(const table_reader& t) const {
    t.allow_only({"point", "load"});
    if (!t.has("point") && !t.has("load"))
      t.refuse("a step without loads", "point, load or both; a load of 0 at any dof takes all load off");
    load l;
    if (t.has("load")) read_vector(t, l);
    for (const table_reader& p : t.optional_tables("point")) {
      p.allow_only({"dof", "value"});
      l.points.push_back({read_node(p), 0, p.real("value", any_real)});
    }
    if (!std::isfinite(resultant_of(problem_.geometry, l).force))
      t.refuse("loads whose sum is not finite", "loads within the range of double precision");
    return l;
  }

  void read_vector(const table_reader& t, load& l) const {
    const std::string path = beside(folder_, t.text("load"));
    const std::vector<double> values =
        parse_vector(read_input(path, "Matrix Market file", largest_matrix_file), path, nodes());
    for (std::size_t dof = 0; dof < values.size(); ++dof)
      if (values[dof] != 0.0) l.points.push_back({static_cast<int>(dof), 0, values[dof]});
  }

  void read_uniform(const table_reader& t, load& l) const {
    const toml::node& node = t.required("uniform", "");
    if (node.is_number()) {
      l.distributed.push_back({{t.real("uniform", any_real)}, {}});
      return;
    }
    if (!node.is_array()) t.refuse_key("uniform", "a number, or an array of tables");
    // Parts on the same elements become one: thousands on "all" would each be a pass over the beam.
    std::map<std::vector<int>, std::size_t> place;
    for (const table_reader& table : t.tables("uniform")) {
      distributed_load part = read_distributed(table);
      const auto [at, is_new] = place.try_emplace(part.elements, l.distributed.size());
      if (is_new) {
        l.distributed.push_back(std::move(part));
      } else {
        add_polynomial(l.distributed[at->second].polynomial, part.polynomial, 1.0);
      }
    }
  }

  [[nodiscard]] distributed_load read_distributed(const table_reader& t) const {
    t.allow_only({"value", "polynomial", "elements"});
    if (t.has("value") == t.has("polynomial"))
      t.refuse("both or neither of value and polynomial", "one of them");
    distributed_load d;
    d.polynomial = t.has("value") ? std::vector<double>{t.real("value", any_real)} : read_polynomial(t);
    const int all = elements(problem_.geometry);
    if (t.has("elements")) d.elements = t.numbers("elements", all);
    if (static_cast<int>(d.elements.size()) == all) d.elements.clear();  // each once: all of them
    return d;
  }

  [[nodiscard]] std::vector<double> read_polynomial(const table_reader& t) const {
    if (!std::holds_alternative<beam>(problem_.geometry.kind))
      t.refuse_key("polynomial", "value: only a beam's load may be a polynomial");
    std::vector<double> coefficients = t.reals("polynomial", any_real, 1);
    if (coefficients.size() > highest_degree + 1)
      t.refuse_key("polynomial", fmt::format("at most {} coefficients", highest_degree + 1));
    return coefficients;
  }

  void read_points(const table_reader& t, load& l) const {
    std::vector<std::string_view> keys = {"node"};
    keys.insert(keys.end(), dof_names_.begin(), dof_names_.end());
    const std::string without = fmt::format("a point load without {}", fmt::join(dof_names_, " or "));
    for (const table_reader& p : t.tables("point")) {
      p.allow_only(keys);
      const int node = read_node(p);
      for (const int dof : dofs_in(p, without))
        l.points.push_back({node, dof, p.real(dof_names_[dof], any_real)});
    }
  }

  std::string folder_;  // of the file
  table_reader top_;
  problem problem_;
  std::optional<dof_index> index_;           // where the structure is a matrix
  std::vector<std::string_view> dof_names_;  // of a node
  std::vector<char> fixed_;                  // [dofs]
  std::vector<double> shares_;               // tributary shares [nodes], once a bed has asked for them
};

}  // namespace

problem parse_problem(std::string_view text, std::string_view file) {
  const toml::table document = parse_toml(text, file);
  return problem_reader(document, file).read();
}

problem read_problem(const std::string& path) {
  const std::string file = path == "-" ? "standard input" : path;
  return parse_problem(read_input(path), file);
}

}  // namespace contct::read
