#include "contct/read/node_reader.hpp"

#include <fmt/format.h>

#include <unordered_set>

#include "contct/text/strings.hpp"

namespace contct {
namespace {

constexpr const char* point_words = "[x, y], or a list of such points";

/// The allowed values of a key that names several nodes.
std::string_view list_words(std::string_view key) {
  if (key == "at") return point_words;
  return key == "x" ? "a number, or a list of numbers" : "a list of labels";
}

std::vector<coordinate_row> axes_of(const model& m) {
  constexpr std::string_view remedy = "grid lines are set by x and y, or elements, in [plate]";
  if (const auto* b = std::get_if<beam>(&m.kind)) return {nodes_along(*b)};
  if (const auto* p = std::get_if<plate>(&m.kind))
    return {{p->x, p->x_runs, "grid line along x", remedy}, {p->y, p->y_runs, "grid line along y", remedy}};
  return {};
}

}  // namespace

node_reader::node_reader(const model& m)
    : structure_(m), axes_(axes_of(m)), matrix_(std::get_if<assembled>(&m.kind)) {
  if (on_matrix()) {
    for (const std::string& label : matrix_->labels) dofs_.emplace(label, static_cast<int>(dofs_.size()));
    keys_ = {"dof", "dofs"};
  }
  if (std::holds_alternative<beam>(m.kind)) keys_ = {"node", "nodes", "x"};
  if (std::holds_alternative<plate>(m.kind)) keys_ = {"node", "nodes", "at"};
  for (const char* name : contct::dof_names(m)) dof_names_.emplace_back(name);
}

std::vector<std::string_view> node_reader::keys_with(std::vector<std::string_view> others) const {
  others.insert(others.begin(), keys_.begin(), keys_.end());
  return others;
}

std::string_view node_reader::key_in(const toml_value& t) const {
  std::string_view found;
  for (const std::string_view key : keys_) {
    if (!t.has(key)) continue;
    if (!found.empty()) t.refuse_beside({found}, key, fmt::format("either {} or {}", found, key));
    found = key;
  }
  return found.empty() ? keys_.front() : found;
}

int node_reader::node_at(const toml_value& named) const {
  if (axes_.empty()) return dof_at(named);
  if (axes_.size() == 1) return axes_[0].index_of(named);
  const std::vector<toml_value> point = named.entries(point_words, 2, 2);
  const int i = axes_[0].index_of(point[0]);
  return std::get<plate>(structure_.kind).node_at(i, axes_[1].index_of(point[1]));
}

std::string node_reader::labels_allowed() const {
  const assembled& a = *matrix_;
  return a.labels.empty()
             ? fmt::format(R"(a label, "1" to "{}")", a.dofs())
             : fmt::format("a label of {}, such as {}", a.labels_from, in_quotes(a.labels.front()));
}

int node_reader::dof_at(const toml_value& named) const {
  const std::string label = named.text(labels_allowed());
  if (const auto at = dofs_.find(label); at != dofs_.end()) return at->second;
  // "01" and "+1" are not labels: each dof has one label.
  const int number = label.starts_with('0') ? 0 : number_in<int>(label).value_or(0);
  const bool is_dof = !dofs_.empty() && label.size() > 2 && label[label.size() - 2] == '.' &&
                      label.find_first_not_of("0123456789.") == std::string::npos;
  constexpr const char* no_row =
      ", which has no row: a dof that is fixed or depends on others (*EQUATION, *MPC) has none";
  if (!dofs_.empty() || number < 1 || number > matrix_->dofs())
    named.refuse(in_quotes(label) + (is_dof ? no_row : did_you_mean(label, matrix_->labels)),
                 labels_allowed());
  return number - 1;
}

std::vector<int> node_reader::read(const toml_value& t) const {
  const std::string_view key = key_in(t);
  const toml_value named = t[key];
  const int count = nodes(structure_);
  if (key == "nodes") return named.numbers(count);
  const std::string allowed = on_matrix()
                                  ? labels_allowed()
                                  : fmt::format("a whole number from 1 to {}; or {} or {} instead of node",
                                                count, keys_[1], keys_[2]);
  const toml::array* const point = named.required(allowed).as_array();
  if (key == "node") return {named.integer(1, count) - 1};
  if (key == "at" && point != nullptr && !point->empty() && point->front().is_number())
    return {node_at(named)};
  std::vector<int> list;
  std::unordered_set<int> seen;
  for (const toml_value& entry : named.each(list_words(key))) {
    list.push_back(node_at(entry));
    if (!seen.insert(list.back()).second)
      entry.refuse(place_words(structure_, list.back()) + ", a second time", "each place once");
  }
  return list;
}

std::vector<int> node_reader::labelled(const toml_value& named, std::size_t count) const {
  std::vector<int> list;
  for (const toml_value& entry : named.each(list_words("dofs"))) list.push_back(dof_at(entry));
  if (list.size() != 1 && list.size() != count)
    named.refuse(fmt::format("{} labels", list.size()), fmt::format("1, or {}: one for each pair", count));
  list.resize(count, list.front());
  return list;
}

std::vector<int> node_reader::dofs_in(const toml_value& t, std::string_view found) const {
  std::vector<int> there;
  for (std::size_t dof = 0; dof < dof_names_.size(); ++dof)
    if (t.has(dof_names_[dof])) there.push_back(static_cast<int>(dof));
  if (there.empty()) t.refuse(found, fmt::format("at least one of {}", fmt::join(dof_names_, ", ")));
  return there;
}

void node_reader::refuse_hinge(const toml_value& named, int node, int dof) const {
  const auto* const b = std::get_if<beam>(&structure_.kind);
  if (b == nullptr || dof == 0 || !b->has_hinge(node)) return;
  named.refuse(
      fmt::format("theta at node {}, where a hinge has one slope on its left and another on its right",
                  node + 1),
      "w at this node, and theta at a neighbouring node");
}

}  // namespace contct
