#include "contct/read/problem_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "contct/kernel/call.hpp"
#include "contct/read/contact_face.hpp"
#include "contct/read/matrix_problem.hpp"
#include "contct/read/model_tables.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {
namespace {

constexpr std::size_t highest_degree = 20;

/// Reads one file into one problem, table by table.
class problem_reader {
 public:
  problem_reader(const toml::table& document, std::string_view file)
      : folder_(std::filesystem::path(file).parent_path().string()), top_(document, "", file) {}

  problem read() {
    top_.allow_only({"title", "beam", "plate", "matrix", "calculix", "support", "contact", "bed", "step"});
    if (top_.has("title")) problem_.title = top_.text("title");
    problem_.geometry = read_model(top_, folder_);
    if (std::holds_alternative<assembled>(problem_.geometry.kind)) {
      read_on_matrix(top_, folder_, problem_);
      return std::move(problem_);
    }
    for (const char* name : dof_names(problem_.geometry)) dof_names_.emplace_back(name);
    fixed_.assign(dofs(problem_.geometry), 0);
    for (const table_reader& t : top_.optional_tables("support")) read_support(t);
    for (const table_reader& t : top_.optional_tables("contact")) read_contact(t);
    for (const table_reader& t : top_.optional_tables("bed")) read_bed(t);
    for (const table_reader& t : top_.tables("step")) read_step(t);
    return std::move(problem_);
  }

 private:
  [[nodiscard]] int nodes() const { return contct::structure::nodes(problem_.geometry); }

  [[nodiscard]] std::size_t dof_of(int node, int dof) const { return node * dof_names_.size() + dof; }

  /// Does a support fix the node's deflection?
  [[nodiscard]] bool fixed_in_w(int node) const { return fixed_[dof_of(node, 0)] != 0; }

  /// The dofs that stand as keys in a table, in their order; refuses a table with none.
  [[nodiscard]] std::vector<int> dofs_in(const table_reader& t, std::string_view found) const {
    std::vector<int> there;
    for (std::size_t dof = 0; dof < dof_names_.size(); ++dof) {
      if (t.has(dof_names_[dof])) there.push_back(static_cast<int>(dof));
    }
    if (there.empty()) t.refuse(found, fmt::format("at least one of {}", fmt::join(dof_names_, ", ")));
    return there;
  }

  /// The nodes that "node" or "nodes" names; from 0.
  [[nodiscard]] std::vector<int> read_nodes(const table_reader& t) const {
    if (!t.has("nodes")) return {t.integer("node", 1, nodes()) - 1};
    t.refuse_beside({"node"}, "nodes", "either node or nodes");
    return t.numbers("nodes", nodes());
  }

  void read_support(const table_reader& t) {
    t.allow_only({"node", "nodes", "fix", "spring"});
    const std::vector<int> at = read_nodes(t);
    if (!t.has("fix") && !t.has("spring")) t.refuse("neither fix nor spring", "at least one of them");
    if (t.has("fix")) {
      for (const int dof : read_fix(t)) {
        for (const int node : at) {
          problem_.supports.push_back({node, dof, true});
          fixed_[dof_of(node, dof)] = 1;
        }
      }
    }
    if (t.has("spring")) read_springs(t.table("spring"), at);
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
      for (const int node : at) problem_.supports.push_back({node, dof, false, stiffness});
    }
  }

  void read_contact(const table_reader& t) {
    t.allow_only({"node", "surface", "face", "stiffness", "state"});
    const int node = t.integer("node", 1, nodes()) - 1;
    read_pair(t, node, fixed_in_w(node) ? fmt::format("node {} is fixed in w", node + 1) : "", problem_);
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

  void read_step(const table_reader& t) {
    t.allow_only({"uniform", "point"});
    load l;
    if (t.has("uniform")) read_uniform(t, l);
    if (t.has("point")) read_points(t, l);
    if (l.distributed.empty() && l.points.empty()) {
      t.refuse("a step without loads", "uniform, point or both; uniform = 0 takes all load off");
    }
    const resultant r = resultant_of(problem_.geometry, l);
    if (!std::isfinite(r.force) ||
        !std::all_of(r.moments.begin(), r.moments.end(), [](double m) { return std::isfinite(m); })) {
      t.refuse("loads whose sum or moment is not finite", "loads within the range of double precision");
    }
    problem_.steps.push_back(std::move(l));
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
        add_to(l.distributed[at->second].polynomial, part.polynomial);
      }
    }
  }

  static void add_to(std::vector<double>& sum, const std::vector<double>& polynomial) {
    sum.resize(std::max(sum.size(), polynomial.size()), 0.0);
    for (std::size_t i = 0; i < polynomial.size(); ++i) sum[i] += polynomial[i];
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
      const int node = p.integer("node", 1, nodes()) - 1;
      for (const int dof : dofs_in(p, without))
        l.points.push_back({node, dof, p.real(dof_names_[dof], any_real)});
    }
  }

  std::string folder_;  // of the file
  table_reader top_;
  problem problem_;
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
