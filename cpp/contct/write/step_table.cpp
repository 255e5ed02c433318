#include "contct/write/step_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/write/words.hpp"

namespace contct::write {
namespace {

/// The quantity whose extremes stand for the bending of the structure.
const value_range* bending(const std::vector<value_range>& ranges) {
  const value_range* most = nullptr;
  for (const value_range& r : ranges) {
    const bool is_moment = r.name == "moment" || r.name == "mx" || r.name == "my" || r.name == "mxy";
    if (is_moment &&
        (most == nullptr || std::abs(r.largest().value) > (1 + 1e-9) * std::abs(most->largest().value)))
      most = &r;
  }
  return most;
}

std::string pair_place(const problem& p, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  return fmt::format("pair {}, {} {}", pair + 1, place_words(p.geometry, at.node), surface_name(at.surface));
}

}  // namespace

std::vector<std::string> largest_lines(const problem& p, const step_results& r, int width,
                                       sizes_so_far& sizes) {
  std::vector<std::string> lines;
  const auto add = [&](std::string_view name, double value, std::string_view quantity,
                       const std::string& at) {
    double& size = sizes[std::string(name)];
    size = std::max(size, std::abs(value));
    const bool is_none = is_rounding(value, size);
    const std::string with_unit = fmt::format("{:.6g}", is_none ? 0.0 : value) + unit_words(p, quantity);
    std::string line = fmt::format("{:<14}{:<18}{}", name, with_unit, is_none ? "" : at);
    line.erase(line.find_last_not_of(' ') + 1);
    if (static_cast<int>(line.size()) > width) line = fmt::format("{} {}, {}", name, with_unit, at);
    lines.push_back(std::move(line));
  };
  if (!r.ranges.empty()) {
    const placed_value& w = r.ranges.front().largest();
    add(std::holds_alternative<assembled>(p.geometry.kind) ? "u" : "w", w.value, "w",
        place_words(p.geometry, w));
  }
  if (const value_range* const m = bending(r.ranges))
    add(m->name, m->largest().value, m->name, place_words(p.geometry, m->largest()));
  if (const auto pair = r.hardest_pair())
    add("contact force", r.pairs[*pair].force, "force", pair_place(p, *pair));
  if (const auto i = r.hardest_support(p))
    add("reaction", r.reactions[*i], "force", place_words(p.geometry, p.supports[*i].node));
  return lines;
}

std::string detail_tables(const problem& p, const step_state& s, const step_results& r) {
  std::string text;
  const auto line = [&text]<class... A>(fmt::format_string<A...> words, A&&... all) {
    text += fmt::format(words, std::forward<A>(all)...) + '\n';
  };
  const std::string_view node = node_name(p.geometry);
  if (!r.pairs.empty())
    line("{:>8} {:>10}  {:<8} {:<10} {:>14} {:>14}", "pair", node, "surface", "state", "gap", "force");
  for (std::size_t i = 0; i < r.pairs.size(); ++i)
    line("{:>8} {:>10}  {:<8} {:<10} {:>14.7g} {:>14.7g}", i + 1,
         on_one_line(place_name(p.geometry, p.pairs[i].node)), surface_name(p.pairs[i].surface),
         state_name(s.isep[i]), r.pairs[i].gap, r.pairs[i].force);
  if (!r.reactions.empty()) line("{:>19}  {:<8} {:>25}", node, "dof", "reaction");
  for (std::size_t i = 0; i < r.reactions.size(); ++i)
    line("{:>19}  {:<8} {:>25.7g}", on_one_line(place_name(p.geometry, p.supports[i].node)),
         dof_names(p.geometry)[p.supports[i].dof], r.reactions[i]);
  if (r.elements.elements() == 0) return text;
  line("{:>8}  {:<8} {}", "element", "at its",
       r.elements.places == 2 ? "left and right end" : "four corners");
  for (std::size_t e = 0; e < r.elements.elements(); ++e) {
    for (std::size_t name = 0; name < r.elements.names.size(); ++name) {
      std::string row =
          fmt::format("{:>8}  {:<8}", name == 0 ? std::to_string(e + 1) : "", r.elements.names[name]);
      for (const double value : r.elements.at(e, name)) row += fmt::format(" {:>14.7g}", value);
      text += row + '\n';
    }
  }
  return text;
}

}  // namespace contct::write
