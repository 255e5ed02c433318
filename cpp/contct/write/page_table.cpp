#include "contct/write/page_table.hpp"

#include <fmt/format.h>

#include <variant>

#include "contct/write/step_results.hpp"
#include "contct/write/words.hpp"

namespace contct::write {

using json = nlohmann::ordered_json;

void page_table::choose(json rows, std::size_t all, std::string how) {
  rows_ = std::move(rows);
  all_ = all;
  how_ = std::move(how);
}

void page_table::put_into(json& tables, std::vector<std::string>& omissions) const {
  if (all_ == 0) return;
  std::string title = title_;
  if (rows_.size() < all_) {
    const std::string cut = fmt::format("{} {} of {}", how_, rows_.size(), all_);
    title += fmt::format(" ({})", cut);
    omissions.push_back(fmt::format("{}: the table has the {} rows.", title_, cut));
  }
  tables.push_back({{"title", title}, {"head", head_}, {"rows", rows_}});
}

std::string in_unit(const unit_labels& u, int force, int length) {
  const std::string words = unit_words(u, force, length);
  return words.empty() ? "" : fmt::format(" [{}]", words);
}

bool is_length(const model& m, int dof) {
  return dof == 0 && !std::holds_alternative<assembled>(m.kind);
}
std::string force_unit(const problem& p, int dof) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return "";
  return in_unit(p.units, 1, is_length(p.geometry, dof) ? 0 : 1);
}

std::vector<std::string> place_head(const problem& p) {
  if (std::holds_alternative<assembled>(p.geometry.kind)) return {"Dof"};
  std::vector<std::string> head = {"Node", "x" + in_unit(p.units, 0, 1)};
  if (std::holds_alternative<plate>(p.geometry.kind)) head.push_back("y" + in_unit(p.units, 0, 1));
  return head;
}

json place_cells(const problem& p, int node) {
  json cells = {place_name(p.geometry, node)};
  const place at = place_of_node(p.geometry, node);
  if (!std::holds_alternative<assembled>(p.geometry.kind)) cells.push_back(at.x);
  if (std::holds_alternative<plate>(p.geometry.kind)) cells.push_back(at.y);
  return cells;
}

std::vector<std::string> joined_heads(std::vector<std::string> head, const std::vector<std::string>& more) {
  head.insert(head.end(), more.begin(), more.end());
  return head;
}

json joined_cells(json row, const json& more) {
  row.insert(row.end(), more.begin(), more.end());
  return row;
}

std::string step_words(const problem& p, int step) {
  const std::string& name = p.steps[step - 1].name;
  return name.empty() ? std::to_string(step) : fmt::format("{}, {}", step, on_one_line(name));
}

}  // namespace contct::write
