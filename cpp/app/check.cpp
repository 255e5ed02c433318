// contct check: describes a problem without solving it.
#include <algorithm>
#include <cmath>
#include <span>

#include "app/problem_runs.hpp"
#include "contct/results/quantities.hpp"
#include "contct/structure/placed_loads.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

std::string structure_words(const problem& p) {
  const std::string length = p.units.length.empty() ? "" : " " + on_one_line(p.units.length);
  if (const auto* b = std::get_if<beam>(&p.geometry.kind))
    return fmt::format("beam from x = {} to {}{}", b->x.front(), b->x.back(), length);
  if (const auto* flat = std::get_if<plate>(&p.geometry.kind))
    return fmt::format("plate from x = {} to {}, y = {} to {}{}", flat->x.front(), flat->x.back(),
                       flat->y.front(), flat->y.back(), length);
  return "matrix " + on_one_line(std::get<assembled>(p.geometry.kind).name);
}

std::string mesh_words(const problem& p) {
  const int of_elements = elements(p.geometry);
  return counted(nodes(p.geometry), node_name(p.geometry)) +
         (of_elements == 0 ? "" : ", " + counted(of_elements, "element"));
}

std::string support_words(const problem& p) {
  const auto fixed = static_cast<std::size_t>(std::ranges::count(p.supports, true, &support::fixed));
  return fmt::format("{} fixed, {}", counted(fixed, "dof"), counted(p.supports.size() - fixed, "spring"));
}

std::string pair_words(const problem& p) {
  const auto closed = std::ranges::count(p.pairs, true, &contact_pair::closed);
  return fmt::format("{}, {} in contact before any load", p.pairs.size(), closed);
}

std::string bed_words(const problem& p, const bed& b) {
  const contact_pair& first = p.pairs[b.first_pair];
  std::string words = fmt::format("modulus {}, {}, pairs {} to {}", b.modulus, surface_name(first.surface),
                                  b.first_pair + 1, b.first_pair + b.share.size());
  if (const auto* const on = std::get_if<beam>(&p.geometry.kind))
    for (const auto& [from, to] : intervals_of(b, *on))
      words += fmt::format(", from {:.6g} to {:.6g}", from, to);
  return words;
}

constexpr std::size_t most_combinations_told = 20;

std::string load_words(const load& l) {
  const auto spread = [&l](load_kind kind) {
    return static_cast<std::size_t>(std::ranges::count_if(
        l.placed, [kind](const placed_load& p) { return p.what == kind && !p.is_at_point(); }));
  };
  const auto at_points = std::ranges::count_if(l.placed, &placed_load::is_at_point);
  const std::vector<std::pair<std::size_t, const char*>> parts = {
      {l.distributed.size() + spread(load_kind::force), "distributed load"},
      {l.points.size() + static_cast<std::size_t>(at_points), "point load"},
      {spread(load_kind::moment), "spread moment"},
      {spread(load_kind::curvature), "imposed curvature"},
      {l.settlements.size(), "settlement"},
      {l.moves.size(), "moved face"}};
  std::vector<std::string> words;
  if (!l.name.empty()) words.push_back(in_quotes(l.name));
  if (l.from_zero) words.emplace_back("from zero load");
  for (const auto& [count, what] : parts)
    if (count > 0) words.push_back(counted(count, what));
  return words.empty() ? "no load" : joined(words, ", ");
}

/// The ends of rising coordinates, and the places where their spacing changes: "node 1 at 0, node 5 at 2".
std::string coordinate_words(std::span<const double> x, std::string_view what) {
  const double rounding = 1e-9 * (x.back() - x.front());
  std::vector<std::string> words;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (i == 0 || i + 1 == x.size() || std::abs(x[i + 1] - 2 * x[i] + x[i - 1]) > rounding)
      words.push_back(fmt::format("{} {} at {:.6g}", what, i + 1, x[i]));
  return joined(words, ", ") + (words.size() < x.size() ? "; equal distances between" : "");
}

/// The description of the problem, as names and texts.
std::vector<std::pair<std::string, std::string>> facts_of(const problem& p) {
  std::vector<std::pair<std::string, std::string>> facts;
  if (!p.title.empty()) facts.emplace_back("title", on_one_line(p.title));
  facts.emplace_back("structure", structure_words(p));
  facts.emplace_back("mesh", mesh_words(p));
  if (const auto* b = std::get_if<beam>(&p.geometry.kind))
    facts.emplace_back("x", coordinate_words(b->x, "node"));
  if (const auto* flat = std::get_if<plate>(&p.geometry.kind)) {
    facts.emplace_back("x", coordinate_words(flat->x, "column"));
    facts.emplace_back("y", coordinate_words(flat->y, "row"));
  }
  facts.emplace_back("supports", support_words(p));
  facts.emplace_back("pairs", pair_words(p));
  for (std::size_t i = 0; i < p.beds.size(); ++i)
    facts.emplace_back(fmt::format("bed {}", i + 1), name_before(p, on::beds, i) + bed_words(p, p.beds[i]));
  for (std::size_t i = 0; i < p.steps.size(); ++i) {
    if (starts_from_zero(p) && i == most_combinations_told)
      facts.emplace_back("..", counted(p.steps.size() - i - 1, "more combination"));
    if (!starts_from_zero(p) || i < most_combinations_told || i + 1 == p.steps.size())
      facts.emplace_back(fmt::format("step {}", i + 1), load_words(p.steps[i]));
  }
  facts.emplace_back(
      "units", p.units.length.empty() ? "none given" : on_one_line(p.units.length + ", " + p.units.force));
  facts.emplace_back("warnings", p.warnings.empty() ? "none" : std::to_string(p.warnings.size()));
  return facts;
}

}  // namespace

exit_status run_command(const check_options& options) {
  const problem p = read_with_warnings(options, {});
  if (!options.quiet) {
    const terminal screen = look_at_terminal();
    for (const auto& [what, words] : facts_of(p)) {
      std::string before = fmt::format("{:<11}", what);
      for (const std::string& line : wrap({words}, screen.width - 11)) {
        print_text(before + line + "\n");
        before.assign(11, ' ');
      }
    }
  }
  flush_standard_output();
  return exit_status::solved;
}

}  // namespace contct
