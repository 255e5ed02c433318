#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "contct/results/quantities.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

/// Returns the coordinates of a node of a beam or plate for the end of a row: " 2.5" or " 2.5, 1".
std::string place_column(const model& m, int node) {
  if (std::holds_alternative<assembled>(m.kind)) return "";
  const place at = place_of_node(m, node);
  return fmt::format(" {:.6g}", at.x) +
         (std::holds_alternative<plate>(m.kind) ? fmt::format(", {:.6g}", at.y) : "");
}

class detail_printer {
 public:
  explicit detail_printer(const step_results& r)
      : r_(r),
        m_(r.what.geometry),
        where_(std::holds_alternative<beam>(m_.kind)    ? " x"
               : std::holds_alternative<plate>(m_.kind) ? " x, y"
                                                        : "") {}

  std::string print() {
    const problem& p = r_.what;
    const auto names = dof_names(m_);
    list(on::pairs, p.pairs.size(),
         fmt::format("{:>8} {:>10}  {:<8} {:<10}", "pair", node_name(m_), "surface", "state"),
         [&](std::size_t i) {
           return std::pair(fmt::format("{:>8} {:>10}  {:<8} {:<10}", i + 1, name_of(p.pairs[i].node),
                                        surface_name(p.pairs[i].surface), state_name(r_.state.isep[i])),
                            p.pairs[i].node);
         });
    list(on::supports, p.supports.size(), fmt::format("{:>19}  {:<8}", node_name(m_), "dof"),
         [&](std::size_t i) {
           return std::pair(
               fmt::format("{:>19}  {:<8}", name_of(p.supports[i].node), names[p.supports[i].dof]),
               p.supports[i].node);
         });
    list(on::nodes, static_cast<std::size_t>(nodes(m_)), fmt::format("{:>8}", node_name(m_)),
         [&](std::size_t i) {
           const int node = static_cast<int>(i);
           return std::pair(fmt::format("{:>8}", name_of(node)), node);
         });
    elements();
    return std::move(text_);
  }

 private:
  [[nodiscard]] std::string name_of(int node) const { return on_one_line(place_name(m_, node)); }

  /// A table of the numbers on a list. `begin(i)`: the first columns of entry i, and its node.
  void list(on list, std::size_t count, const std::string& heading, const auto& begin) {
    if (count == 0) return;
    const std::vector<const quantity_row*> rows = quantities_of(r_.what, list);
    std::vector<std::vector<double>> columns;
    text_ += heading;
    for (const quantity_row* row : rows) {
      if (list == on::pairs && !row->kind) continue;  // faces are input, and moved faces are printed above
      columns.push_back(row->values(r_));
      text_ += fmt::format(" {:>14}", row->key);
    }
    text_ += where_ + '\n';
    for (std::size_t i = 0; i < count; ++i) {
      const auto [words, node] = begin(i);
      text_ += words;
      for (const std::vector<double>& of : columns)
        text_ += std::isnan(of[i]) ? fmt::format(" {:>14}", "") : fmt::format(" {:>14.7g}", of[i]);
      const std::string name = on_one_line(name_of_entry(r_.what, list, i));
      text_ += place_column(m_, node) + (name.empty() ? "" : "  " + name) + '\n';
    }
  }

  void elements() {
    const std::size_t count = r_.elements.elements();
    if (count == 0) return;
    const auto places = static_cast<std::size_t>(r_.elements.places);
    text_ += fmt::format("{:>8}  {:<8} {}\n", "element", "at its",
                         places == 2 ? "left and right end" : "four corners");
    std::vector<std::pair<std::string_view, std::vector<double>>> columns;
    for (const quantity_row* row : quantities_of(r_.what, on::element_ends))
      columns.emplace_back(row->key, row->values(r_));
    for (std::size_t e = 0; e < count; ++e) {
      text_ += fmt::format("{:>8}  {:<9}", e + 1, where_.substr(1));
      for (const int corner : nodes_of_element(m_, static_cast<int>(e)))
        text_ += fmt::format(" {:>14}", place_column(m_, corner).substr(1));
      text_ += '\n';
      for (const auto& [key, values] : columns) {
        text_ += fmt::format("{:>8}  {:<9}", "", key);
        for (std::size_t k = e * places; k < (e + 1) * places; ++k)
          text_ += fmt::format(" {:>14.7g}", values[k]);
        text_ += '\n';
      }
    }
  }

  const step_results& r_;
  const model& m_;
  std::string where_;  // what place_column adds
  std::string text_;
};

}  // namespace

std::string detail_tables(const step_results& r) {
  return detail_printer(r).print();
}

}  // namespace contct
