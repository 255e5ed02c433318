// A table of a run's page, and the cells and headings that several tables have.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::write {

/// At most so many rows in a table.
inline constexpr std::size_t most_rows = 40;

/// A table that grows by rows, of which it keeps the first. A cell is a number, a text, null, or a list of
/// [number, where it is]; behind the place stands true where the number is no more than rounding.
class page_table {
 public:
  using json = nlohmann::ordered_json;

  page_table(std::string title, std::vector<std::string> head)
      : title_(std::move(title)), head_(std::move(head)) {}

  void add(json row) {
    if (all_++ < most_rows) rows_.push_back(std::move(row));
  }
  /// These rows of `all`, chosen by the caller as `how` says.
  void choose(json rows, std::size_t all, std::string how);

  /// As { "title", "head", "rows" }, or nothing where there are no rows. A cut is said in the title and in
  /// `omissions`.
  void put_into(json& tables, std::vector<std::string>& omissions) const;

 private:
  std::string title_, how_ = "first";
  std::vector<std::string> head_;
  json rows_ = json::array();
  std::size_t all_ = 0;
};

/// " [kN/m]", behind a heading: the powers of force and of length. Empty without units.
[[nodiscard]] std::string in_unit(const unit_labels& u, int force, int length);

/// What acts at a dof, or what it moves by, has the power of length of its name: rotations count as none.
[[nodiscard]] bool is_length(const model& m, int dof);
[[nodiscard]] std::string force_unit(const problem& p, int dof);

/// "Node", "x" and "y", as far as the structure has them, and the cells below them.
[[nodiscard]] std::vector<std::string> place_head(const problem& p);
[[nodiscard]] nlohmann::ordered_json place_cells(const problem& p, int node);

[[nodiscard]] std::vector<std::string> joined_heads(std::vector<std::string> head,
                                                    const std::vector<std::string>& more);
[[nodiscard]] nlohmann::ordered_json joined_cells(nlohmann::ordered_json row,
                                                  const nlohmann::ordered_json& more);

/// "1", "1, dead load". `step` counts from 1.
[[nodiscard]] std::string step_words(const problem& p, int step);

}  // namespace contct::write
