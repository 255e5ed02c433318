// The numbers of a state at the terminal: the largest ones, and tables of all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/results/quantities.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {

std::string face_words(const problem& p, std::size_t pair) {
  return fmt::format("{} {}", entry_words(p, on::pairs, pair), surface_name(p.pairs[pair].surface));
}

const value_range* bending(const problem& p, const std::vector<value_range>& ranges) {
  const value_range* most = nullptr;
  for (const value_range& r : ranges) {
    if (row_named(p, r.name).kind == quantity::moment &&
        (most == nullptr || std::abs(r.largest().value) > (1 + 1e-9) * std::abs(most->largest().value)))
      most = &r;
  }
  return most;
}

std::vector<std::string> largest_lines(const step_results& r, int width, bool all) {
  const problem& p = r.what;
  std::vector<std::string> lines;
  const auto add = [&](std::string_view name, double value, const std::string& unit, const std::string& at) {
    const std::string with_unit = fmt::format("{:.6g}{}", value + 0.0, unit);  // never -0
    std::string line = fmt::format("{:<14}{:<18}{}", name, with_unit, at);
    line.erase(line.find_last_not_of(' ') + 1);
    if (static_cast<int>(line.size()) > width) line = fmt::format("{} {}, {}", name, with_unit, at);
    lines.push_back(std::move(line));
  };
  const auto add_range = [&](std::string_view name, const value_range& v) {
    const placed_value& first = v.largest();
    const placed_value& other = &first == &v.least ? v.most : v.least;
    const double size = std::abs(first.value);
    add(name, first.value, unit_words(p, row_named(p, v.name).in, first.node),
        size == 0.0 ? "" : place_words(p.geometry, first));
    // If there is only rounding beside the largest value, there is no second extreme.
    if (all && std::abs(other.value) > tie_of(0.0, size) &&
        std::abs(other.value - first.value) > tie_of(size, size))
      add("and", other.value, unit_words(p, row_named(p, v.name).in, other.node),
          place_words(p.geometry, other));
  };
  const auto add_force = [&](std::string_view name, double force, int node, const std::string& at) {
    add(name, force, unit_words(p, unit::force, node), force == 0.0 ? "" : at);
  };
  const bool of_matrix = std::holds_alternative<assembled>(p.geometry.kind);
  const std::vector<value_range>& ranges = r.ranges();
  if (!ranges.empty()) add_range(of_matrix ? "u" : "w", ranges.front());
  for (const value_range& v : ranges)  // of a plate mx, my and mxy
    if (row_named(p, v.name).kind == quantity::moment) add_range(v.name, v);
  for (const value_range& v : ranges) {
    const quantity_row& row = row_named(p, v.name);
    const bool of_beam = std::holds_alternative<beam>(p.geometry.kind);
    if ((all && row.kind == quantity::shear) || (of_beam && row.in == unit::stress)) add_range(v.name, v);
    if (!of_beam && row.in == unit::stress && &v == &ranges.back())
      add("von Mises", v.most.value, unit_words(p, row.in), place_words(p.geometry, v.most));
  }
  if (const auto pair = r.hardest_pair())
    add_force("contact force", r.pairs[*pair].force, p.pairs[*pair].node,
              fmt::format("pair {}, {}", *pair + 1, face_words(p, *pair)));
  std::string_view name = "reaction";
  for (const std::size_t i : r.hardest_supports())
    add_force(std::exchange(name, "and"), r.reactions[i], p.supports[i].node,
              entry_words(p, on::supports, i));
  constexpr std::size_t most_faces = 4;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < r.pairs.size() && all; ++i)
    if (r.pairs[i].face != p.pairs[i].face && ++moved <= most_faces)
      add("moved face", r.pairs[i].face, unit_words(p, unit::length, p.pairs[i].node),
          fmt::format("pair {}, {}", i + 1, face_words(p, i)));
  if (moved > most_faces) lines.push_back(fmt::format("{} more moved faces in --json", moved - most_faces));
  return lines;
}

std::vector<std::string> watch_lines(const step_results& r) {
  std::vector<std::string> lines;
  std::size_t next = 0;  // the first part without a line
  for (const watched_range& w : watched_in(r)) {
    const std::string name = w.part < next ? "" : on_one_line(r.what.watches[w.part].name) + ":";
    next = w.part + 1;
    const auto add = [&](std::string_view begin, std::string_view what, const placed_value& v) {
      lines.push_back(fmt::format("{:<13} {} {:.6g}{} at {}", begin, what, v.value + 0.0,
                                  unit_words(r.what, w.row->in, v.node), place_words(r.what.geometry, v)));
    };
    add(name, key_in_list(*w.row), w.least);
    if (w.most.value != w.least.value) add("", "to", w.most);
  }
  return lines;
}

std::vector<std::string> sum_lines(const step_results& r) {
  const problem& p = r.what;
  std::vector<std::string> lines;
  const auto number = [&p](double x, unit in) { return fmt::format("{:.6g}{}", x + 0.0, unit_words(p, in)); };
  std::vector<std::string> sums;
  for (const quantity_row* row : quantities_of(p, on::structure))
    sums.push_back(fmt::format("{} {}", key_in_list(*row), number(row->values(r)[0], row->in)));
  if (!sums.empty()) lines.push_back(fmt::format("{:<14}{}", "sums", joined(sums, ", ")));
  for (std::size_t i = 0; const bed_reading& b : beds_in(r))
    lines.push_back(fmt::format("{:<13} force {}, pressure {:.6g} to {}, largest at {}; {} in contact",
                                numbered_words(p, on::beds, i++), number(b.force, unit::force),
                                b.pressure.least.value, number(b.pressure.most.value, unit::pressure),
                                place_words(p.geometry, b.pressure.most), number(b.contact, unit::extent)));
  for (std::size_t i = 0; i < list_of(on::hinges).count(p); ++i) {
    std::vector<std::string> of_hinge;
    for (const quantity_row* row : quantities_of(p, on::hinges))
      of_hinge.push_back(fmt::format("{} {}", key_in_list(*row), number(row->values(r)[i], row->in)));
    lines.push_back(fmt::format("{:<14}{} at {}", fmt::format("hinge {}", i + 1), joined(of_hinge, ", "),
                                place_words(p.geometry, list_of(on::hinges).node(p, i))));
  }
  return lines;
}

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
           return fmt::format("{:>8} {:>10}  {:<8} {:<10}", i + 1, name_of(p.pairs[i].node),
                              surface_name(p.pairs[i].surface), state_name(r_.state.isep[i]));
         });
    list(on::supports, p.supports.size(), fmt::format("{:>19}  {:<8}", node_name(m_), "dof"),
         [&](std::size_t i) {
           return fmt::format("{:>19}  {:<8}", name_of(p.supports[i].node), names[p.supports[i].dof]);
         });
    list(on::nodes, static_cast<std::size_t>(nodes(m_)), fmt::format("{:>8}", node_name(m_)),
         [&](std::size_t i) { return fmt::format("{:>8}", name_of(static_cast<int>(i))); });
    elements();
    return std::move(text_);
  }

 private:
  [[nodiscard]] std::string name_of(int node) const { return on_one_line(place_name(m_, node)); }

  /// A table of the numbers on a list. `begin(i)`: the first columns of entry i.
  void list(on list, std::size_t count, const std::string& heading, const auto& begin) {
    if (count == 0) return;
    std::vector<quantity_column> columns = columns_of(r_, list);
    // Faces are input, and moved faces are printed above.
    if (list == on::pairs) std::erase_if(columns, [](const quantity_column& c) { return !c.row->kind; });
    text_ += heading;
    for (const auto& [row, values] : columns) text_ += fmt::format(" {:>14}", row->key);
    text_ += where_ + '\n';
    for (std::size_t i = 0; i < count; ++i) {
      text_ += begin(i);
      for (const auto& [row, values] : columns)
        text_ += std::isnan(values[i]) ? fmt::format(" {:>14}", "") : fmt::format(" {:>14.7g}", values[i]);
      const int node = list == on::nodes ? static_cast<int>(i) : list_of(list).node(r_.what, i);
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
    const std::vector<quantity_column> columns = columns_of(r_, on::element_ends);
    for (std::size_t e = 0; e < count; ++e) {
      text_ += fmt::format("{:>8}  {:<9}", e + 1, where_.substr(1));
      for (const int corner : nodes_of_element(m_, static_cast<int>(e)))
        text_ += fmt::format(" {:>14}", place_column(m_, corner).substr(1));
      text_ += '\n';
      for (const auto& [row, values] : columns) {
        text_ += fmt::format("{:>8}  {:<9}", "", row->key);
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
